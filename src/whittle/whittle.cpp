// The public API, in terms of the stages.
#include "whittle/whittle.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include "base/result.h"
#include "host/read_file.h"
#include "image/colorscheme.h"
#include "model/instances.h"
#include "whittle/choices.h"
#include "whittle/output.h"
#include "whittle/reading.h"
#include "whittle/renderer.h"

namespace whittle {
namespace {

[[noreturn]] void fail(const Error& error) {
  throw Failure(Failure::Cause(int(error.kind)), error.message);
}

[[noreturn]] void refuse(const std::string& message) {
  fail({ErrorKind::kUsage, message});
}

template <class T>
T value_of(Result<T> result) {
  if (!result) fail(result.error());
  return *std::move(result);
}

Vec3 to_vec3(const Point& p) {
  return {p[0], p[1], p[2]};
}

std::optional<Vec3> to_vec3(const std::optional<Point>& p, const char* name) {
  if (!p) return std::nullopt;
  if (!is_finite(to_vec3(*p))) refuse(std::string(name) + " must be three finite numbers");
  return to_vec3(*p);
}

int threads_of(int threads) {
  if (threads < 0 || threads > kMostThreads) {
    refuse("threads must be 0 to " + std::to_string(kMostThreads));
  }
  return threads;
}

ReadOptions reading_of(const LoadOptions& o) {
  return {.curves = value_of(choose(curves_choices(), "kind of curves", o.curves)),
          .polish = value_of(choose(matrices_choices(), "kind of matrices", o.matrices)),
          .threads = threads_of(o.threads),
          .limits = {.bytes = o.most_bytes,
                     .depth = o.most_depth,
                     .nodes = o.most_nodes,
                     .values = o.most_values,
                     .facets = o.most_facets},
          .outlines = o.outlines,
          .solid_box = tight_box};
}

ViewOptions view_of(const RenderOptions& o) {
  if (o.distance && !(*o.distance >= 0 && std::isfinite(*o.distance))) {
    refuse("distance must be a finite number that is not negative");
  }
  if (o.fov_degrees && !(*o.fov_degrees > 0 && *o.fov_degrees < 180)) {
    refuse("fov_degrees must lie between 0 and 180");
  }
  return {.target = to_vec3(o.target, "target"),
          .rotation_degrees = to_vec3(o.rotation_degrees, "rotation_degrees"),
          .distance = o.distance,
          .eye = to_vec3(o.eye, "eye"),
          .center = to_vec3(o.center, "center"),
          .view_all = o.view_all,
          .auto_center = o.auto_center,
          .orthographic = o.orthographic,
          .fov_degrees = o.fov_degrees,
          .width = o.width,
          .height = o.height};
}

ShadeSettings shading_of(const RenderOptions& o) {
  ShadeSettings shading{.style = value_of(choose(style_choices(), "style", o.style)),
                        .scheme = nullptr,
                        .light = to_vec3(o.light, "light"),
                        .background = o.background,
                        .cut_faces = nullptr,
                        .lone_primitive = {},
                        .shadows = o.shadows,
                        .casters = {}};
  if (!o.color_scheme.empty()) {
    shading.scheme = find_color_scheme(o.color_scheme);
    if (shading.scheme == nullptr) {
      refuse("unknown colour scheme '" + o.color_scheme + "'; there are: " + color_scheme_names());
    }
  }
  return shading;
}

}  // namespace

struct Solid::State {
  Read read;
  Bounds bounds;
};

Solid::Solid(std::shared_ptr<const State> state) : state_(std::move(state)) {}

Solid Solid::load(const std::string& path, const LoadOptions& options) {
  State state{value_of(read_file(path, {.reading = reading_of(options)})), {}};
  state.bounds = whittle::bounds(state.read.model);
  return Solid(std::make_shared<const State>(std::move(state)));
}

Solid Solid::parse(std::string_view text, const std::string& name, const LoadOptions& options) {
  State state{value_of(read_csg(text, name, reading_of(options))), {}};
  state.bounds = whittle::bounds(state.read.model);
  return Solid(std::make_shared<const State>(std::move(state)));
}

const std::vector<std::string>& Solid::warnings() const {
  return state_->read.warnings;
}

bool Solid::is_complete() const {
  return !state_->read.unsupported;
}

std::uint32_t Solid::statement_count() const {
  return state_->read.model.statement_count;
}

std::optional<std::array<Point, 2>> Solid::bounds() const {
  const Bounds& b = state_->bounds;
  if (!b.bounded || b.box.is_empty()) return std::nullopt;
  const Box box = seen_box(state_->read.model, b.box);
  return std::array<Point, 2>{{{box.lo.x, box.lo.y, box.lo.z}, {box.hi.x, box.hi.y, box.hi.z}}};
}

Rendering Solid::render(const RenderOptions& options) const {
  value_of(check_picture_size(options.width, options.height));
  if (options.antialias < 0 || options.antialias > kMostAntialias) {
    refuse("antialias must be 0 to " + std::to_string(kMostAntialias));
  }
  const ShadeSettings shading = shading_of(options);
  value_of(check_shadows(shading));
  const ViewOptions view = view_of(options);
  RendererSettings settings;
  settings.backend = value_of(choose(backend_choices(), "backend", options.backend));
  settings.device = options.device;
  settings.shaders = value_of(choose(shaders_choices(), "kind of shaders", options.shaders));
  settings.threads = threads_of(options.threads);
  settings.subdivide.memory = options.cell_memory;
  Renderer renderer = value_of(Renderer::make(state_->read.model, settings));
  const Camera camera = renderer.camera(view);
  value_of(renderer.prepare(camera));
  const Frame frame = value_of(renderer.trace(camera));
  const int antialias =
      options.antialias > 0 ? options.antialias : default_antialias(shading.style);
  Picture picture = value_of(renderer.shade(frame, camera, shading, antialias));

  Rendering made;
  made.width = frame.width;
  made.height = frame.height;
  made.rgba.assign(picture.rgba.begin(), picture.rgba.end());
  made.distance.reserve(frame.hits.size());
  made.normal.reserve(3 * frame.hits.size());
  made.id.reserve(frame.hits.size());
  for (const Hit& hit : frame.hits) {
    made.distance.push_back(hit.distance);
    made.normal.insert(made.normal.end(), {hit.normal.x, hit.normal.y, hit.normal.z});
    made.id.push_back(hit.id);
  }
  made.backend = name_of(backend_choices(), renderer.backend());
  made.transparent = !options.background;
  return made;
}

void Rendering::write(const std::string& path) const {
  const FileFormat format = value_of(format_of(path));
  value_of(check_picture_size(width, height));
  const size_t pixels = size_t(width) * size_t(height);
  if (rgba.size() != 4 * pixels || distance.size() != pixels || normal.size() != 3 * pixels ||
      id.size() != pixels) {
    refuse("a rendering must have an entry for each of its pixels");
  }
  Picture picture(width, height);
  picture.rgba.assign(rgba.begin(), rgba.end());
  Frame frame(width, height);
  for (size_t i = 0; i < pixels; ++i) {
    frame.hits[i] = {distance[i], id[i], {normal[3 * i], normal[3 * i + 1], normal[3 * i + 2]}};
  }
  value_of(write_output(path, value_of(encode(format, frame, picture, transparent, path))));
}

}  // namespace whittle
