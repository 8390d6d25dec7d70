// Sessions of the public API: what pictures of one solid have in common is made once.
#include <algorithm>
#include <cmath>
#include <utility>

#include "image/colorscheme.h"
#include "trace/pixel_rect.h"
#include "whittle/api.h"
#include "whittle/renderer.h"

namespace whittle {
namespace {

std::optional<Vec3> finite(const std::optional<Point>& p, const char* name) {
  if (!p) return std::nullopt;
  if (!is_finite(to_vec3(*p))) refuse(std::string(name) + " must be three finite numbers");
  return to_vec3(*p);
}

ViewOptions view_of(const RenderOptions& o, Style style) {
  value_of(check_picture_size(o.width, o.height));
  if (o.distance && !(*o.distance >= 0 && std::isfinite(*o.distance))) {
    refuse("distance must be a finite number that is not negative");
  }
  if (o.fov_degrees && !(*o.fov_degrees > 0 && *o.fov_degrees < 180)) {
    refuse("fov_degrees must lie between 0 and 180");
  }
  return {.target = finite(o.target, "target"),
          .rotation_degrees = finite(o.rotation_degrees, "rotation_degrees"),
          .distance = o.distance,
          .eye = finite(o.eye, "eye"),
          .center = finite(o.center, "center"),
          .view_all = o.view_all,
          .auto_center = o.auto_center,
          .tight = frames_tightly(o.style.value_or(style)),
          .orthographic = o.orthographic,
          .fov_degrees = o.fov_degrees,
          .width = o.width,
          .height = o.height};
}

ShadeSettings shading_of(const RenderOptions& o, Style style) {
  ShadeSettings shading;
  shading.style = o.style.value_or(style);
  shading.light = finite(o.light, "light");
  shading.background = o.background;
  shading.shadows = o.shadows;
  shading.quality = o.quality;
  shading.ground = o.ground;
  if (!o.color_scheme.empty()) {
    shading.scheme = find_color_scheme(o.color_scheme);
    if (shading.scheme == nullptr) {
      refuse("unknown colour scheme '" + o.color_scheme + "'; there are: " + color_scheme_names());
    }
  }
  value_of(check_shadows(shading));
  return shading;
}

RendererSettings settings_of(const SessionOptions& o) {
  RendererSettings settings;
  settings.backend = o.backend;
  settings.device = o.device;
  settings.shaders = o.shaders;
  settings.threads = threads_of(o.threads);
  settings.subdivide.memory = o.cell_memory;
  return settings;
}

Part part_of(const Frame& frame, const PixelRect& rect) {
  Part part{rect.x0, rect.y0, rect.width(), rect.height(), {}, {}};
  for (int y = rect.y0; y < rect.y1; ++y) {
    for (int x = rect.x0; x < rect.x1; ++x) {
      part.id.push_back(frame.at(x, y).id);
      part.distance.push_back(frame.at(x, y).distance);
    }
  }
  return part;
}

RenderControl control_of(const Control& control) {
  RenderControl inner{.stop = control.stop, .progress = control.progress, .part_seen = {}};
  if (control.part) {
    inner.part_seen = [&control](const Frame& frame, const PixelRect& rect) {
      control.part(part_of(frame, rect));
    };
  }
  return inner;
}

Rendering rendering_of(const Frame& frame, const Picture& picture) {
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
  return made;
}

Seen seen_by(const Ray& ray, const Hit& hit) {
  if (!hit.hit()) return {};
  const auto distance = double(hit.distance);
  return {hit.id, distance, to_point(ray.origin + ray.direction * distance),
          to_point(to_double(hit.normal))};
}

}  // namespace

struct Session::State {
  std::shared_ptr<const Solid::State> solid;
  Renderer renderer;
  bool is_prepared = false;

  State(std::shared_ptr<const Solid::State> solid_, const SessionOptions& options)
      : solid(std::move(solid_)),
        renderer(value_of(Renderer::make(solid->model, settings_of(options)))) {}

  /// The cells are made for the first camera, and grow with the others.
  void prepare(const Camera& camera) {
    if (is_prepared) return;
    value_of(renderer.prepare(camera));
    is_prepared = true;
  }
};

Session::Session(const Solid& solid, const SessionOptions& options)
    : state_(std::make_unique<State>(solid.state_, options)) {}
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;
Session::~Session() = default;

Rendering Session::render(const RenderOptions& options) {
  return *render(options, {});
}

std::optional<Rendering> Session::render(const RenderOptions& options, const Control& control) {
  State& s = *state_;
  if (options.antialias < 0 || options.antialias > kMostAntialias) {
    refuse("antialias must be 0 to " + std::to_string(kMostAntialias));
  }
  const ShadeSettings shading = shading_of(options, s.solid->style);
  const Camera camera = s.renderer.camera(view_of(options, s.solid->style));
  const auto stopped = [&] { return control.stop.stop_requested(); };
  if (stopped()) return std::nullopt;
  s.prepare(camera);
  const Frame frame = value_of(s.renderer.trace(camera, control_of(control)));
  if (stopped()) return std::nullopt;
  const int antialias =
      options.antialias > 0 ? options.antialias : default_antialias(shading.style, shading.quality);
  const Picture picture =
      value_of(s.renderer.shade(frame, camera, shading, antialias, control.stop));
  if (stopped()) return std::nullopt;
  Rendering made = rendering_of(frame, picture);
  made.backend = s.renderer.backend();
  made.transparent = !options.background;
  return made;
}

Seen Session::pick(const RenderOptions& options, double x, double y) {
  if (!std::isfinite(x) || !std::isfinite(y)) refuse("a position must be two finite numbers");
  State& s = *state_;
  const Camera camera = s.renderer.camera(view_of(options, s.solid->style));
  s.prepare(camera);
  const Ray ray = camera.ray(x, y);
  Hit hit;
  value_of(s.renderer.cast({&ray, 1}, {&hit, 1}));
  return seen_by(ray, hit);
}

std::vector<Seen> Session::cast(std::span<const WorldRay> rays) {
  State& s = *state_;
  std::vector<Ray> inner;
  inner.reserve(rays.size());
  for (const WorldRay& ray : rays) {
    const Vec3 way = normalize(to_vec3(ray.direction));
    if (way == Vec3{} || !is_finite(way) || !is_finite(to_vec3(ray.from)))
      refuse("a ray must have a finite start and a direction");
    inner.push_back({to_vec3(ray.from), way, 0});
  }
  s.prepare(s.renderer.camera({}));
  std::vector<Hit> hits(inner.size());
  value_of(s.renderer.cast(inner, hits));
  std::vector<Seen> seen(inner.size());
  std::ranges::transform(inner, hits, seen.begin(), seen_by);
  return seen;
}

}  // namespace whittle
