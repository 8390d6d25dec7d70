#include "whittle/renderer.h"

#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <utility>
#include <vector>

#include "base/workers.h"
#include "image/antialias.h"
#include "image/cut_faces.h"
#include "lower/lower.h"
#include "model/instances.h"
#include "subdivide/solid_bounds.h"
#include "trace/oracle/oracle.h"
#include "trace/pixel_threshold.h"

namespace whittle {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace

Status check_picture_size(int64_t width, int64_t height) {
  if (width >= 1 && height >= 1 && width <= kMostSide && height <= kMostSide &&
      width * height <= kMostPixels) {
    return Done{};
  }
  return Error{ErrorKind::kUsage,
               fmt::format("a picture of {} x {} pixels is not possible: each side is 1 to {}, "
                           "and all together at most {} pixels",
                           width, height, kMostSide, kMostPixels)};
}

struct Renderer::State {
  const Model& model;
  RendererSettings settings;
  Workers workers;
  std::vector<Appearance> looks;
  StageTimes times;
  // In the order in which they are made from one another.
  Scene scene;
  std::optional<CutFaces> cut_faces;  ///< made when a style first asks
  std::optional<CellTree> cells;
  std::unique_ptr<Tracer> tracer;
  CpuTracer* cpu = nullptr;  ///< the tracer, if it is that one

  State(const Model& model_, const RendererSettings& settings_)
      : model(model_), settings(settings_), workers(settings_.threads) {}
};

Renderer::Renderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

Result<Renderer> Renderer::make(const Model& model, const RendererSettings& settings) {
  auto state = std::make_unique<State>(model, settings);
  if (settings.backend == Backend::kAuto) state->settings.backend = Backend::kCpu;
  const auto start = Clock::now();
  state->looks = appearances(model);
  Result<Scene> scene = lower(model);
  if (!scene) return scene.error();
  state->scene = std::move(*scene);
  state->times.lower = milliseconds_since(start);
  return Renderer(std::move(state));
}

Camera Renderer::camera(const ViewOptions& options) {
  State& s = *state_;
  const FileView& file = s.model.view;
  const auto start = Clock::now();
  Box framed;
  if (frames_the_solid(options, file)) {
    const SolidBounds solid = solid_bounds(s.scene, s.settings.threads);
    framed = solid.bounded ? solid.box : bounds(s.model).box;
  }
  s.times.frame = milliseconds_since(start);
  return make_camera(options, file, framed);
}

void Renderer::prepare(const Camera& camera) {
  State& s = *state_;
  s.tracer.reset();
  s.cpu = nullptr;
  if (s.settings.backend == Backend::kOracle) {
    s.tracer = make_oracle_tracer(s.model, s.settings.threads);
    return;
  }
  const auto start = Clock::now();
  s.cells.reset();
  SubdivideSettings settings = s.settings.subdivide;
  settings.rays = double(camera.width) * double(camera.height);
  if (s.settings.pixel_threshold > 0) {
    settings.is_small = [camera, pixels = s.settings.pixel_threshold](const Box& box) {
      return is_below_pixels(camera, box, pixels);
    };
  }
  s.cells = open_cells(s.scene, settings);
  s.settings.eager ? refine_all(*s.cells, s.workers) : refine_top(*s.cells, s.workers);
  std::unique_ptr<CpuTracer> cpu = make_cpu_tracer(s.scene, *s.cells, s.settings.threads);
  s.cpu = cpu.get();
  s.tracer = std::move(cpu);
  s.times.subdivide = milliseconds_since(start);
}

Frame Renderer::trace(const Camera& camera, const Progress& progress) {
  const auto start = Clock::now();
  Frame frame = tracer().render(camera, progress);
  state_->times.trace = milliseconds_since(start);
  return frame;
}

Picture Renderer::shade(const Frame& frame, const Camera& camera, const ShadeSettings& settings,
                        int antialias) {
  State& s = *state_;
  const auto start = Clock::now();
  ShadeSettings look = settings;
  if (look.style == Style::kOpenscad) {
    if (!s.cut_faces) s.cut_faces.emplace(s.scene);
    look.cut_faces = &*s.cut_faces;
    look.lone_primitive = lone_primitive(s.model);
  }
  Picture picture = shade_antialiased(tracer(), camera, frame, s.looks, look, antialias, s.workers);
  s.times.shade = milliseconds_since(start);
  return picture;
}

Tracer& Renderer::tracer() {
  WHITTLE_CHECK(state_->tracer);
  return *state_->tracer;
}

Backend Renderer::backend() const {
  return state_->settings.backend;
}

const Scene* Renderer::scene() const {
  return state_->settings.backend == Backend::kOracle ? nullptr : &state_->scene;
}

const CellTree* Renderer::cells() const {
  return state_->cells ? &*state_->cells : nullptr;
}

TraceStats Renderer::trace_stats() const {
  return state_->cpu ? state_->cpu->stats() : TraceStats{};
}

const StageTimes& Renderer::times() const {
  return state_->times;
}

}  // namespace whittle
