#include "whittle/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "base/timing.h"
#include "base/workers.h"
#include "gpu/devices.h"
#include "image/antialias.h"
#include "image/cap_owners.h"
#include "image/cut_faces.h"
#include "image/draw_outlines.h"
#include "image/studio.h"
#include "image/xray.h"
#include "lower/lower.h"
#include "model/instances.h"
#include "model/section.h"
#include "subdivide/solid_bounds.h"
#include "subdivide/threshold.h"
#include "trace/closeness.h"
#include "trace/drawing_tracer.h"
#include "trace/oracle/oracle.h"
#include "trace/pixel_threshold.h"
#include "trace/section_tracer.h"

namespace whittle {
namespace {

/// A point that touches the eye needs no endless number of them.
constexpr double kMostRays = 1e24;

/// How the statements look, and behind them the caps of what is cut open: each in the colour of the
/// statement whose material it is; what has no colour is told apart as cut.
std::vector<Appearance> looks_of(const Model& model) {
  std::vector<Appearance> looks = appearances(model);
  if (!model.cut) return looks;
  const Cut& cut = *model.cut;
  looks.resize(size_t(cut.last_plane) + cut.first_plane);
  for (uint32_t id = 1; id < cut.first_plane; ++id)
    looks[cut.cap_of(id)] = {.color = looks[id].color, .cut = true};
  return looks;
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

Status check_shadows(const ShadeSettings& settings) {
  if (!settings.shadows || settings.style != Style::kOpenscad) return Done{};
  return Error{ErrorKind::kUsage, "style openscad has no shadows, as OpenSCAD has none"};
}

struct Renderer::State {
  const Model& model;
  RendererSettings settings;
  Workers workers;
  std::vector<Appearance> looks;
  StageTimes times;
  std::optional<Box> framed;   ///< made when a camera first asks
  bool has_end = true;         ///< what is framed is the solid's own box
  std::optional<Scene> whole;  ///< of a model that is cut open what it was before; made as `framed`
  std::optional<CapOwners> cap_owners;  ///< of a model that is cut open
  std::optional<Box> left;              ///< the box of what is left of it; made when a style asks
  // In the order in which they are made from one another.
  Scene scene;
  std::optional<CutFaces> cut_faces;  ///< made when a style first asks
  std::optional<CellTree> cells;
  Camera cells_camera;    ///< which cells are small for it, if there is a pixel threshold
  double cells_rays = 0;  ///< for how many rays they were made
  std::optional<Camera> looked_from;  ///< the last camera that was asked how closely it looks
  std::unique_ptr<Tracer> scout;      ///< made when a camera may look more closely
  std::variant<std::monostate, std::unique_ptr<Tracer>, std::unique_ptr<CpuTracer>,
               std::unique_ptr<RasterTracer>>
      backend;                             ///< of plain tracers there is the oracle's
  Tracer* tracer = nullptr;                ///< the backend's; null: there is none
  std::unique_ptr<DrawingTracer> drawing;  ///< over the tracer, if the model is one
  std::unique_ptr<SectionTracer> section;  ///< over the tracer, if the model is cut open
  Refine refine = Refine::kWhereRaysCome;
  bool is_auto = false;  ///< nobody chose the backend
  std::shared_ptr<RasterDevice> device;
  std::string backend_note;

  State(const Model& model_, const RendererSettings& settings_)
      : model(model_), settings(settings_), workers(settings_.threads) {}

  Status choose_backend();
  /// What is framed where view-all is on.
  const Box& framed_box();
  const Box& left_box();
  /// What framed_box() is the box of: the scene, or what it was before it was cut.
  const Scene& framed_scene();
  /// For as many rays as the camera has, or more if it looks closely at a part.
  Status make_tracer(const Camera& camera);
  Status make_tracer(const Camera& camera, double rays);
  Status make_backend(const Camera& camera, double rays);
  template <class T>
  void use(std::unique_ptr<T> made) {
    tracer = made.get();
    backend = std::move(made);
  }
  /// What pictures are made with.
  Tracer& seen();
  /// With a pixel threshold: makes the cells what they are for another camera. And makes finer ones
  /// for one that looks more closely.
  Status look_from(const Camera& camera);
  Status move_threshold_to(const Camera& camera);
  Status look_closely(const Camera& camera);
  /// Gives back what make_tracer() made.
  void discard();
  /// After a refusal: true if the CPU goes on, else the refusal stands.
  bool falls_back(const Error& refusal, const Camera& camera);
};

Status Renderer::State::choose_backend() {
  is_auto = settings.backend == Backend::kAuto;
  if (is_auto)
    settings.backend = gpu::has_graphics_hardware() ? Backend::kVulkanRaster : Backend::kCpu;
  if (settings.backend != Backend::kVulkanRaster) return Done{};
  Result<std::shared_ptr<RasterDevice>> opened = open_raster_device(
      {.device = settings.device, .shaders = settings.shaders, .culling = settings.culling});
  if (opened && !(is_auto && is_software(**opened))) {
    device = *std::move(opened);
    backend_note = describe(*device);
    return Done{};
  }
  if (!is_auto) return opened.error();
  settings.backend = Backend::kCpu;
  if (!opened) backend_note = opened.error().message;
  return Done{};
}

bool Renderer::State::falls_back(const Error& refusal, const Camera& camera) {
  if (!is_auto || settings.backend != Backend::kVulkanRaster) return false;
  settings.backend = Backend::kCpu;
  backend_note = refusal.message;
  discard();
  device.reset();
  return bool(make_tracer(camera));
}

Renderer::Renderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

Result<Renderer> Renderer::make(const Model& model, const RendererSettings& settings) {
  auto state = std::make_unique<State>(model, settings);
  if (Status chosen = state->choose_backend(); !chosen) return chosen.error();
  const Stopwatch watch;
  state->looks = looks_of(model);
  Result<Scene> scene = lower(model, &state->workers);
  if (!scene) return scene.error();
  state->scene = std::move(*scene);
  if (model.cut) state->cap_owners.emplace(state->scene);
  state->times.lower = watch.milliseconds();
  return Renderer(std::move(state));
}

const Box& Renderer::State::framed_box() {
  if (!framed) {
    const SolidBounds solid = solid_bounds(framed_scene(), settings.threads);
    has_end = solid.bounded;
    framed = seen_box(model, has_end ? solid.box : bounds(model).box);
  }
  return *framed;
}

const Scene& Renderer::State::framed_scene() {
  if (!model.cut) return scene;
  if (!whole) {
    // It has fewer faces than what was lowered already.
    Result<Scene> lowered = lower(uncut(model), &workers);
    WHITTLE_CHECK(lowered);
    whole = *std::move(lowered);
  }
  return *whole;
}

const Box& Renderer::State::left_box() {
  if (!left) left = solid_bounds(scene, settings.threads).box;
  return *left;
}

Camera Renderer::camera(const ViewOptions& options, GimbalView* view) {
  State& s = *state_;
  const FileView& file = s.model.view;
  const Stopwatch watch;
  const bool frames = frames_the_solid(options, file);
  const Box framed = frames ? s.framed_box() : Box{};
  // How far a solid without end reaches nobody knows, and what a drawing shows has no height.
  const Reach reach = [&](const Directions& directions) {
    if (!s.has_end || s.model.drawing) return box_reach(framed, directions);
    std::array<double, 4> found;
    std::ranges::copy(solid_reach(s.framed_scene(), framed, directions, s.settings.threads),
                      found.begin());
    return found;
  };
  const FramedView framing = frame_view(options, file, framed, reach);
  s.times.frame = watch.milliseconds();
  if (view) *view = framing.view;
  return framing.camera;
}

Tracer& Renderer::State::seen() {
  WHITTLE_CHECK(tracer);
  if (drawing) return *drawing;
  return section ? static_cast<Tracer&>(*section) : *tracer;
}

void Renderer::State::discard() {
  drawing.reset();
  section.reset();
  tracer = nullptr;
  backend = {};
  scout.reset();
  looked_from.reset();
  cells.reset();
}

Status Renderer::State::make_tracer(const Camera& camera) {
  const Status made = make_tracer(camera, double(camera.width) * double(camera.height));
  return made ? look_closely(camera) : made;
}

Status Renderer::State::make_tracer(const Camera& camera, double rays) {
  const Status made = make_backend(camera, rays);
  if (made && model.drawing)
    drawing = std::make_unique<DrawingTracer>(*tracer, bounds(model).box, workers);
  if (made && model.cut) {
    const auto owner = [this](Vec3 point, Vec3 outward) {
      return cap_owners->owner(point, outward);
    };
    section = std::make_unique<SectionTracer>(*tracer, *model.cut, owner, workers);
  }
  return made;
}

Status Renderer::State::make_backend(const Camera& camera, double rays) {
  discard();
  if (settings.backend == Backend::kOracle) {
    use(make_oracle_tracer(model, settings.threads));
    return Done{};
  }
  const Stopwatch watch;
  SubdivideSettings subdivision = settings.subdivide;
  subdivision.rays = cells_rays = rays;
  if (settings.pixel_threshold > 0)
    subdivision.is_small = PixelThreshold(camera, settings.pixel_threshold);
  const bool is_raster = settings.backend == Backend::kVulkanRaster;
  if (is_raster) subdivision.margin = cell_margin(*device);
  cells = open_cells(scene, subdivision, &workers);
  cells_camera = camera;
  if (refine == Refine::kAll)
    refine_all(*cells, workers);
  else if (!is_raster)
    refine_top(*cells, workers);
  times.subdivide = watch.milliseconds();
  times.send = 0;
  if (is_raster) {
    const Stopwatch sending;
    const MakeTracer second_look = [this] {
      return make_cpu_tracer(scene, *cells, settings.threads);
    };
    Result<std::unique_ptr<RasterTracer>> made =
        make_raster_tracer(device, scene, *cells, second_look, settings.threads);
    if (!made) return made.error();
    use(*std::move(made));
    times.send = sending.milliseconds();
  } else {
    use(make_cpu_tracer(scene, *cells, settings.threads));
  }
  return Done{};
}

Status Renderer::State::look_from(const Camera& camera) {
  const Status moved = move_threshold_to(camera);
  return moved ? look_closely(camera) : moved;
}

/// Cells that were made for a whole model are too large for a small part of it that fills the
/// picture: leaves in which few rays were expected have long formulas.
Status Renderer::State::look_closely(const Camera& camera) {
  // For fewer times as many rays leaves are hardly faster (decision 0014) than what is there.
  constexpr double kMany = 4;
  if (!cells || settings.subdivide.leaf_size != kAutoLeafSize) return Done{};
  const Box region{scene.region.lo + scene.origin, scene.region.hi + scene.origin};
  if (rays_at_most(camera, region) <= kMany * cells_rays || looked_from == camera) return Done{};
  if (!scout) scout = make_cpu_tracer(scene, *cells, 1);
  looked_from = camera;
  const double wanted = rays_at_nearest_hit(*scout, camera, region);
  if (!(wanted > kMany * cells_rays)) return Done{};
  double rays = cells_rays;
  // Not once more for every step of a camera that comes nearer.
  while (rays < wanted && rays < kMostRays) rays *= kMany;
  const Status made = make_tracer(camera, rays);
  looked_from = camera;
  return made;
}

Status Renderer::State::move_threshold_to(const Camera& camera) {
  if (!(settings.pixel_threshold > 0) || !cells || camera == cells_camera) return Done{};
  // What pays off follows from how many rays there are.
  const bool as_many_rays =
      camera.width == cells_camera.width && camera.height == cells_camera.height;
  if (settings.subdivide.leaf_size == kAutoLeafSize && !as_many_rays) return make_tracer(camera);
  const Stopwatch watch;
  const MovedThreshold moved =
      move_threshold(*cells, PixelThreshold(camera, settings.pixel_threshold), workers);
  cells_camera = camera;
  if (moved.is_crowded) return make_tracer(camera);
  if (refine == Refine::kAll) refine_all(*cells, workers);
  times.subdivide = watch.milliseconds();
  return Done{};
}

Status Renderer::prepare(const Camera& camera, Refine refine) {
  state_->refine = refine;
  Status made = state_->make_tracer(camera);
  if (made || state_->falls_back(made.error(), camera)) return Done{};
  return made;
}

void Renderer::discard() {
  state_->discard();
}

Result<Frame> Renderer::trace(const Camera& camera, const RenderControl& control) {
  if (const Status looks = state_->look_from(camera);
      !looks && !state_->falls_back(looks.error(), camera))
    return looks.error();
  const Stopwatch watch;
  Frame frame = state_->seen().render(camera, control);
  if (const Status status = tracer().status(); !status) {
    if (!state_->falls_back(status.error(), camera)) return status.error();
    frame = state_->seen().render(camera, control);
  }
  state_->times.trace = watch.milliseconds();
  return frame;
}

Result<Picture> Renderer::shade(const Frame& frame, const Camera& camera,
                                const ShadeSettings& settings, int antialias,
                                const std::stop_token& stop) {
  State& s = *state_;
  if (const Status looks = s.look_from(camera); !looks && !s.falls_back(looks.error(), camera))
    return looks.error();
  const Stopwatch watch;
  ShadeSettings look = settings;
  if (look.style == Style::kOpenscad) {
    if (!s.cut_faces) s.cut_faces.emplace(s.scene);
    look.cut_faces = &*s.cut_faces;
    look.lone_primitive = lone_primitive(s.model);
  }
  look.is_drawing = s.model.drawing.has_value();
  look.cut = s.model.cut;
  // On a plane there are none.
  if (look.shadows && !s.model.drawing) look.casters = view_region(bounds(s.model));
  if (look.style == Style::kStudio && !s.model.drawing) {
    look.solid = s.framed_box();
    // What is cut away casts no shadow, and need not be stood on.
    if (s.model.cut && s.has_end) look.solid = s.left_box();
    // What is framed of a solid without end does not say how far down it reaches.
    look.ground = look.ground && s.has_end;
  }
  const auto shaded = [&] {
    if (look.style == Style::kStudio)
      return shade_studio(s.seen(), camera, frame, s.looks, look, antialias, s.workers, stop);
    return shade_antialiased(s.seen(), camera, frame, s.looks, look, antialias, s.workers, stop);
  };
  Picture picture = shaded();
  if (const Status status = tracer().status(); !status) {
    if (!s.falls_back(status.error(), camera)) return status.error();
    picture = shaded();
  }
  if (look.is_drawing && look.style == Style::kOpenscad) {
    const Rgb8 color = effective_scheme(look).outline;
    draw_outlines(*s.model.drawing, camera, color, std::max(antialias, 1), picture);
  }
  s.times.shade = watch.milliseconds();
  return picture;
}

Result<Picture> Renderer::xray(const Camera& camera, const ShadeSettings& settings, int antialias,
                               const std::stop_token& stop) {
  State& s = *state_;
  if (const Status looks = s.look_from(camera); !looks && !s.falls_back(looks.error(), camera))
    return looks.error();
  const Stopwatch watch;
  ShadeSettings look = settings;
  look.is_drawing = s.model.drawing.has_value();
  const auto drawn = [&] {
    return xray_picture(s.seen(), camera, s.looks, look, antialias, s.workers, stop);
  };
  Picture picture = drawn();
  if (const Status status = tracer().status(); !status) {
    if (!s.falls_back(status.error(), camera)) return status.error();
    picture = drawn();
  }
  s.times.shade = watch.milliseconds();
  return picture;
}

Status Renderer::cast(std::span<const Ray> rays, std::span<Hit> hits) {
  state_->seen().cast(rays, hits);
  return tracer().status();
}

Status Renderer::cast_through(std::span<const Ray> rays, RayCrossings& found) {
  state_->seen().cast_through(rays, found);
  return tracer().status();
}

Tracer& Renderer::tracer() const {
  WHITTLE_CHECK(state_->tracer);
  return *state_->tracer;
}

CpuTracer* Renderer::cpu_tracer() const {
  const auto* cpu = std::get_if<std::unique_ptr<CpuTracer>>(&state_->backend);
  return cpu != nullptr ? cpu->get() : nullptr;
}

RasterTracer* Renderer::raster_tracer() const {
  const auto* raster = std::get_if<std::unique_ptr<RasterTracer>>(&state_->backend);
  return raster != nullptr ? raster->get() : nullptr;
}

Backend Renderer::backend() const {
  return state_->settings.backend;
}

const std::string& Renderer::backend_note() const {
  return state_->backend_note;
}

const Scene* Renderer::scene() const {
  return state_->settings.backend == Backend::kOracle ? nullptr : &state_->scene;
}

const CellTree* Renderer::cells() const {
  return state_->cells ? &*state_->cells : nullptr;
}

const StageTimes& Renderer::times() const {
  return state_->times;
}

}  // namespace whittle
