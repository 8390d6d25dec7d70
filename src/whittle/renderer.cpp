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
#include "model/part_looks.h"
#include "model/section.h"
#include "subdivide/solid_bounds.h"
#include "subdivide/threshold.h"
#include "trace/closeness.h"
#include "trace/drawing_tracer.h"
#include "trace/oracle/oracle.h"
#include "trace/pixel_threshold.h"
#include "trace/section_tracer.h"
#include "whittle/see_through.h"

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
  bool has_unknown_parts = false;  ///< cuts of parts of several colours
  StageTimes times;
  std::optional<Box> solid;  ///< made when a camera first asks
  bool has_end = true;       ///< that is the solid's own box
  // What is seen of it if parts are see-through; made when a picture first asks.
  std::shared_ptr<const Layers> layers;
  std::unique_ptr<SeeThrough> see_through;
  std::optional<Scene> whole;  ///< of a model that is cut open what it was before; made as `solid`
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
  /// The solid's box before it was cut open, or of one without end bounds().
  const Box& solid_box();
  /// What is shown beside the solid; empty if nothing is.
  Box box_beside();
  const Layers& all_layers();
  /// What is framed where view-all is on: the solid, and what is shown beside it.
  Box framed_box();
  /// How far that reaches.
  Reach framed_reach();
  const Box& left_box();
  /// What solid_box() is the box of: the scene, or what it was before it was cut.
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
  Status look_through(const Camera& camera, const ShadeSettings& look, SeeThrough::Sight& sight);
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
  if (settings.part_colors) state->has_unknown_parts = !set_part_looks(model, state->looks);
  Result<Scene> scene = lower(model, &state->workers);
  if (!scene) return scene.error();
  state->scene = std::move(*scene);
  if (model.cut) state->cap_owners.emplace(state->scene);
  state->times.lower = watch.milliseconds();
  return Renderer(std::move(state));
}

const Box& Renderer::State::solid_box() {
  if (!solid) {
    const SolidBounds found = solid_bounds(framed_scene(), settings.threads);
    has_end = found.bounded;
    solid = seen_box(model, has_end ? found.box : bounds(model).box);
  }
  return *solid;
}

const Layers& Renderer::State::all_layers() {
  if (!layers) {
    layers = std::make_shared<const Layers>(
        layers_of(model, looks, {settings.ghosts, settings.thrown_together}));
  }
  return *layers;
}

Box Renderer::State::box_beside() {
  Box box;
  const auto add = [&](const Model& more) {
    if (const Bounds found = bounds(more); found.bounded) box = unite(box, found.box);
  };
  if (settings.frames_bounds && !model.drawing) add(model);
  if (settings.thrown_together) add(all_layers().opaque);
  if (settings.ghosts || settings.thrown_together)
    for (const Layer& layer : all_layers().see_through)
      if (layer.kind != LayerKind::kPart || settings.thrown_together) add(layer.model);
  return box;
}

Box Renderer::State::framed_box() {
  return unite(solid_box(), box_beside());
}

Reach Renderer::State::framed_reach() {
  const Box beside = box_beside(), framed = unite(solid_box(), beside);
  // How far a solid without end reaches nobody knows, and what a drawing shows has no height.
  const bool is_known = has_end && !model.drawing;
  return [this, beside, framed, is_known](const Directions& directions) {
    if (!is_known) return box_reach(framed, directions);
    std::array<double, 4> found;
    std::ranges::copy(solid_reach(framed_scene(), *solid, directions, settings.threads),
                      found.begin());
    if (!beside.is_empty()) {
      const std::array<double, 4> more = box_reach(beside, directions);
      for (size_t i = 0; i < found.size(); ++i) found[i] = std::max(found[i], more[i]);
    }
    return found;
  };
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
  const FramedView framing = frame_view(options, file, framed, frames ? s.framed_reach() : Reach());
  s.times.frame = watch.milliseconds();
  if (view) *view = framing.view;
  return framing.camera;
}

Turntable Renderer::turntable(const ViewOptions& options, GimbalView* view) {
  State& s = *state_;
  const FileView& file = s.model.view;
  const Stopwatch watch;
  const bool frames = frames_the_solid(options, file);
  const Box framed = frames ? s.framed_box() : Box{};
  // What stands where without the solid.
  const Vec3 looked_at = frame_view(options, file, Box{}, Reach()).view.target;
  const bool fits = frames && !framed.is_empty() && framed.is_finite();
  const Vec3 axis = fits && centers_the_solid(options, file) ? framed.center() : looked_at;
  const Reach reach = fits ? swept_reach(s.framed_reach(), axis) : Reach();
  const FramedView framing = frame_view(options, file, framed, reach);
  s.times.frame = watch.milliseconds();
  if (view) *view = framing.view;
  return {framing.camera, axis};
}

Box Renderer::framed_box() {
  return state_->framed_box();
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

/// Sees what is see-through by itself, if there is any. What --render shows knows no colours.
Status Renderer::State::look_through(const Camera& camera, const ShadeSettings& look,
                                     SeeThrough::Sight& sight) {
  const bool has_colors = look.style != Style::kOpenscad || look.is_preview;
  if (!has_colors && !settings.ghosts && !settings.thrown_together) return Done{};
  if (!see_through) {
    if (model.cut || all_layers().is_plain()) return Done{};
    Result<std::unique_ptr<SeeThrough>> made = SeeThrough::make(model, layers, looks, settings);
    if (!made) return made.error();
    see_through = *std::move(made);
  }
  Result<SeeThrough::Sight> found =
      see_through->look_from(camera, look, *sight.opaque, *sight.frame);
  if (!found) return found.error();
  sight = *std::move(found);
  return Done{};
}

Result<Picture> Renderer::shade(const Frame& frame, const Camera& camera,
                                const ShadeSettings& settings, int antialias,
                                const std::stop_token& stop) {
  State& s = *state_;
  if (const Status looks = s.look_from(camera); !looks && !s.falls_back(looks.error(), camera))
    return looks.error();
  const Stopwatch watch;
  ShadeSettings look = settings;
  if (look.style == Style::kOpenscad && !look.is_preview) {
    if (!s.cut_faces) s.cut_faces.emplace(s.scene);
    look.cut_faces = &*s.cut_faces;
    look.lone_primitive = lone_primitive(s.model);
  }
  look.is_drawing = s.model.drawing.has_value();
  look.cut = s.model.cut;
  // On a plane there are none.
  if (look.shadows && !s.model.drawing) look.casters = view_region(bounds(s.model));
  if (look.style == Style::kStudio && !s.model.drawing) {
    look.solid = s.solid_box();
    // What is cut away casts no shadow, and need not be stood on.
    if (s.model.cut && s.has_end) look.solid = s.left_box();
    // What is framed of a solid without end does not say how far down it reaches.
    look.ground = look.ground && s.has_end;
  }
  SeeThrough::Sight sight{.opaque = &s.seen(), .frame = &frame, .veil = nullptr};
  if (Status found = s.look_through(camera, look, sight); !found) return found.error();
  const auto shaded = [&] {
    const auto shade_in_style = look.style == Style::kStudio ? shade_studio : shade_antialiased;
    return shade_in_style(*sight.opaque, camera, *sight.frame, s.looks, look, antialias, s.workers,
                          stop, sight.veil.get());
  };
  Picture picture = shaded();
  if (const Status status = tracer().status(); !status) {
    if (!s.falls_back(status.error(), camera)) return status.error();
    if (sight.frame == &frame) sight.opaque = &s.seen();
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

std::string Renderer::picture_note() {
  State& s = *state_;
  if (s.has_unknown_parts)
    return "--cut-color part: where parts of several colours were cut, the cut has the cutter's";
  const auto is_see_through = [](const Appearance& look) { return opacity(look) < 1; };
  if (s.model.drawing && std::ranges::any_of(s.looks, is_see_through))
    return "what is flat is drawn opaque, whatever the alpha of its colours";
  if (s.model.cut && std::ranges::any_of(s.looks, is_see_through))
    return "what is cut open is drawn opaque, whatever the alpha of its colours";
  if (s.model.drawing || s.model.cut || !s.all_layers().has_many_colors) return {};
  return fmt::format("of more than {} see-through colours, no walls are drawn between the others",
                     kMostSeeThroughColors);
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
