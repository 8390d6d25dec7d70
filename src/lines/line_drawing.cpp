#include "lines/line_drawing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "base/timing.h"
#include "boundary/evaluate_solid.h"
#include "lines/chain_lines.h"
#include "lines/facet_curves.h"
#include "lines/smooth_parts.h"
#include "lines/solid_edges.h"
#include "lines/split_lines.h"
#include "lines/true_normals.h"
#include "lines/visible_parts.h"
#include "lower/lower.h"
#include "model/instances.h"
#include "subdivide/subdivide.h"
#include "trace/cpu/cpu.h"

namespace whittle {
namespace {

/// Lengths in the drawing that nobody sees, its units; coordinates are written in such steps.
constexpr double kStepToScale = 1e-3, kStepOfPicture = 1e-2;
/// Around a drawing to scale, millimetres.
constexpr double kMargin = 2;

/// The camera's half behind the eye's plane reaches beyond all of the solid.
Camera seeing_all(Camera camera, const Box& box) {
  if (camera.orthographic)
    camera.ortho_reach =
        std::max(camera.ortho_reach, length(box.center() - camera.eye) + length(box.size()));
  return camera;
}

/// Whether the eye of a perspective camera is in the solid. What it then sees looks away from it.
bool is_inside(const Camera& camera, Tracer& tracer) {
  if (camera.orthographic) return false;
  const Ray ray{camera.eye, camera.forward, 0};
  Hit hit;
  tracer.cast(std::span(&ray, 1), std::span(&hit, 1));
  return hit.hit() && dot(to_double(hit.normal), ray.direction) > 0;
}

bool has_curves(const Model& model) {
  return std::ranges::any_of(model.primitives, [](const Primitive& primitive) {
    return wall(primitive.shape).has_value();
  });
}

/// A scene, for rays.
class TracedScene {
 public:
  TracedScene(const Scene& scene, const Workers& workers, int threads)
      : cells_(open_cells(scene, {}, &workers)), tracer_(make_cpu_tracer(scene, cells_, threads)) {}

  Tracer& tracer() { return *tracer_; }

 private:
  CellTree cells_;
  std::unique_ptr<CpuTracer> tracer_;
};

/// One drawing on its way from edges to paths.
class Drafter {
 public:
  Drafter(std::vector<SolidEdge> edges, const ViewProjection& projection,
          const LineSettings& settings, const Workers& workers)
      : edges_(std::move(edges)),
        projection_(projection),
        settings_(settings),
        workers_(workers),
        step_(projection.is_to_scale() ? kStepToScale : kStepOfPicture) {}

  double step() const { return step_; }

  Status split() {
    std::vector<DrawnLine> covering;
    for (uint32_t i = 0; i < edges_.size(); ++i) {
      const SolidEdge& edge = edges_[i];
      std::optional<DrawnLine> line = projection_.draw(edge.from, edge.to);
      if (line && !(is_in_reach(line->a) && is_in_reach(line->b)))
        return Error{ErrorKind::kInput, "the solid is too large for a line drawing of this scale"};
      if (!line || !(length(line->b - line->a) > 0)) continue;
      line->edge = i;
      if (edge.may_cover) covering.push_back(*line);
      if (edge.may_be_seen || settings_.hidden) lines_.push_back(*line);
    }
    Result<std::vector<LinePart>> parts =
        split_lines(lines_, covering, projection_, step_ / 10, workers_);
    if (!parts) return parts.error();
    parts_ = *std::move(parts);
    return Done{};
  }

  /// The tracers: of the solid with facets, and of the true one if it has none of its own.
  void look(Tracer& facetted, Tracer* smooth, const Progress& progress) {
    visible_ = visible_parts(parts_, lines_, edges_, projection_, facetted, progress);
    smooth_.assign(parts_.size(), false);
    const auto mark = [&](Doubt doubt, Tracer& tracer) {
      mark_smooth_parts(doubt, parts_, lines_, edges_, visible_, projection_, tracer, smooth_);
    };
    mark(Doubt::kFold, facetted);
    if (smooth != nullptr) mark(Doubt::kMade, *smooth);
  }

  /// What is drawn: silhouettes first, for they stay where lines lie on one another.
  Result<std::vector<KindLine>> lines() const {
    std::vector<KindLine> all;
    for (size_t i = 0; i < parts_.size();) {
      // Parts of one line that are seen alike are one.
      size_t end = i + 1;
      while (end < parts_.size() && parts_[end].line == parts_[i].line &&
             visible_[end] == visible_[i] && smooth_[end] == smooth_[i])
        ++end;
      const DrawnLine& line = lines_[parts_[i].line];
      const double from = parts_[i].from, to = parts_[end - 1].to;
      const LineKind kind = !visible_[i]                   ? LineKind::kHidden
                            : edges_[line.edge].is_contour ? LineKind::kSilhouette
                                                           : LineKind::kEdge;
      if (!smooth_[i] && (kind != LineKind::kHidden || settings_.hidden))
        all.push_back({{from == 0 ? line.a : line.at(from), to == 1 ? line.b : line.at(to)}, kind});
      i = end;
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const KindLine& a, const KindLine& b) { return a.kind < b.kind; });
    return single_lines(all, 1.5 * projection_.fineness(), step_ / 2, workers_);
  }

  size_t edge_count() const { return edges_.size(); }
  size_t part_count() const { return parts_.size(); }

 private:
  bool is_in_reach(Vec2 p) const {
    return std::fabs(p.x) <= kMostSteps * step_ && std::fabs(p.y) <= kMostSteps * step_;
  }

  std::vector<SolidEdge> edges_;
  const ViewProjection& projection_;
  const LineSettings& settings_;
  const Workers& workers_;
  double step_;
  std::vector<DrawnLine> lines_;
  std::vector<LinePart> parts_;
  std::vector<bool> visible_, smooth_;
};

/// The sheet that holds the paths of a drawing to scale.
void fit_sheet(LineDrawing& drawing) {
  constexpr double kMost = std::numeric_limits<double>::max();
  Vec2 lo{kMost, kMost}, hi{-kMost, -kMost};
  for (const DrawnPath& path : drawing.paths) {
    for (const Vec2 p : path.points) {
      lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)};
      hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
    }
  }
  if (drawing.paths.empty()) lo = hi = {};
  drawing.corner = {lo.x - kMargin, lo.y - kMargin};
  drawing.size = {hi.x - lo.x + 2 * kMargin, hi.y - lo.y + 2 * kMargin};
}

}  // namespace

Result<LineDrawing> draw_lines(const Model& model, const Camera& given,
                               const LineSettings& settings, int threads, LineStats* stats,
                               const LineStage& stage, const Progress& progress) {
  LineStats ignored;
  LineStats& s = stats != nullptr ? *stats : ignored;
  s = {};
  Stopwatch watch;
  const auto lap = [&watch](double& time) {
    time += watch.milliseconds();
    watch = Stopwatch();
  };
  const auto enter = [&stage](const char* name) {
    if (stage) stage(name);
  };
  const Workers workers(threads);
  const Box box = bounds(model).box;
  const Camera camera = seeing_all(given, box);
  const ViewProjection projection(camera, settings.scale, length(box.size()));
  enter("evaluating");
  const Result<Model> facetted = facet_curves(model, projection, settings.most_facets);
  if (!facetted) return facetted.error();
  const Result<Scene> scene = lower(*facetted, &workers);
  if (!scene) return scene.error();
  const Result<SolidMesh> mesh = evaluate_solid(*scene, workers);
  if (!mesh) return mesh.error();
  s.facets = mesh->triangles.size();
  lap(s.solid_ms);

  TracedScene traced(*scene, workers, threads);
  const TrueNormals normals(model, *facetted, *scene);
  Drafter drafter(
      solid_edges(*mesh, normals, projection, is_inside(camera, traced.tracer()), workers),
      projection, settings, workers);
  s.edges = drafter.edge_count();
  lap(s.edges_ms);
  const auto named = [&model](const Error& error) {
    return Error{error.kind, model.file + ": error: " + error.message};
  };
  if (Status done = drafter.split(); !done) return named(done.error());
  s.parts = drafter.part_count();
  lap(s.split_ms);
  enter("looking");
  if (has_curves(model)) {
    const Result<Scene> true_scene = lower(model, &workers);
    if (!true_scene) return true_scene.error();
    TracedScene smooth(*true_scene, workers, threads);
    drafter.look(traced.tracer(), &smooth.tracer(), progress);
  } else {
    drafter.look(traced.tracer(), nullptr, progress);
  }
  lap(s.look_ms);

  enter("drawing");
  const Result<std::vector<KindLine>> lines = drafter.lines();
  if (!lines) return named(lines.error());
  LineDrawing drawing{.is_to_scale = projection.is_to_scale(),
                      .corner = {},
                      .size = {double(camera.width), double(camera.height)},
                      .paths = chain_lines(*lines, drafter.step())};
  if (drawing.is_to_scale) fit_sheet(drawing);
  s.paths = drawing.paths.size();
  for (const DrawnPath& path : drawing.paths) s.points += path.points.size();
  lap(s.join_ms);
  return drawing;
}

}  // namespace whittle
