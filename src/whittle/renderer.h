// The stages in a row: from a model to its picture. The program, its benchmark and the public API
// all go this one way.
#pragma once

#include <memory>
#include <span>
#include <stop_token>
#include <string>

#include "base/result.h"
#include "image/picture.h"
#include "image/shade.h"
#include "lower/scene.h"
#include "model/model.h"
#include "subdivide/subdivide.h"
#include "trace/cpu/cpu.h"
#include "trace/tracer.h"
#include "trace/turntable.h"
#include "trace/view.h"
#include "trace/vulkan/raster.h"
#include "whittle/choices.h"

namespace whittle {

/// Pictures have sides of 1 to kMostSide pixels, and at most kMostPixels in all.
inline constexpr int kMostSide = 65535;
inline constexpr int64_t kMostPixels = int64_t(1) << 28;
/// Rays a side of an edge pixel, and threads, that can be asked for.
inline constexpr int kMostAntialias = 16;
inline constexpr int kMostThreads = 1024;

/// A kUsage error if a picture of that size is not made.
Status check_picture_size(int64_t width, int64_t height);

/// A kUsage error if shadows are asked for in a style that has none.
Status check_shadows(const ShadeSettings& settings);

/// Rays a side of an edge pixel where nobody says: what looks right. The styles that show what
/// others show (the paper, OpenSCAD) have no antialiasing, as those have none.
constexpr int default_antialias(Style style, Quality quality = Quality::kGood) {
  if (style == Style::kPlain) return 4;
  if (style != Style::kStudio) return 1;
  return quality == Quality::kDraft ? 2 : quality == Quality::kGood ? 3 : 6;
}

/// Whether the solid itself is framed; else OpenSCAD's ball around it.
constexpr bool frames_tightly(Style style) {
  return style == Style::kStudio;
}

struct RendererSettings {
  Backend backend = Backend::kAuto;
  std::string device{};  ///< of a vulkan backend: number or part of a name; empty: the best
  ShaderCases shaders = RasterSettings{}.shaders;  ///< of vulkan-raster
  bool culling = RasterSettings{}.culling;
  int threads = 0;              ///< 0: all
  SubdivideSettings subdivide;  ///< `rays` and `is_small` are set from the camera and below
  double pixel_threshold = 0;   ///< cells whose edges are all shorter are small; 0: none is
  /// What pictures show beside the solid (model/layers.h). Facts are the solid's alone.
  bool ghosts = false;
  bool thrown_together = false;
  bool part_colors = false;    ///< cuts have the colour of what was cut (model/part_looks.h)
  bool frames_bounds = false;  ///< bounds() are framed, as in OpenSCAD's preview, and not the solid
};

/// When cells are refined. The pictures do not depend on it.
enum class Refine {
  kWhereRaysCome,  ///< and when
  kAll,            ///< before there are rays
};

/// Milliseconds that each stage took when it was last run. A moved threshold is a part of
/// `subdivide`.
struct StageTimes {
  double lower = 0, frame = 0, subdivide = 0, trace = 0, shade = 0;
  double send = 0;  ///< cells that were there, to the device
};

/// One model and what is made of it. The steps are called in their order; each can be repeated, and
/// makes its result anew. The model must outlive the renderer.
///
/// What prepare() makes serves pictures from any camera; for one that looks closely at a part,
/// prepare(), trace() and shade() make finer cells first (docs/decisions/0033-long-parts.md). With
/// a pixel threshold the cells depend on the camera: where it has moved, trace() and shade() first
/// refine the cells that are no longer small and leave out those that became it
/// (subdivide/threshold.h). The pictures are those of a renderer made afresh.
class Renderer {
 public:
  /// Fails if the model cannot be lowered, or the chosen backend has no device to work on. kAuto
  /// takes a graphics card where there is one, and the CPU elsewhere
  /// (docs/decisions/0022-auto-and-devices.md).
  static Result<Renderer> make(const Model& model, const RendererSettings& settings);
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;
  ~Renderer();

  /// The camera for these options and the model's $vp*, framing the solid (solid_bounds) where
  /// view-all is on. Of a solid that has no end, what bounds() says is framed. One that is cut open
  /// is framed as if it were whole. `view` is told the same in OpenSCAD's words.
  Camera camera(const ViewOptions& options, GimbalView* view = nullptr);
  /// The same for a camera that then goes round the point looked at. Where view-all is on, the
  /// solid fits the picture all the way round.
  Turntable turntable(const ViewOptions& options, GimbalView* view = nullptr);
  /// What is framed where view-all is on: the solid's box, in world coordinates.
  Box framed_box();

  /// Makes the cells, as far as they are not left to the rays, and the tracer. The camera says how
  /// many rays there will be, and with a pixel threshold which cells are small. The oracle has no
  /// cells.
  /// Fails if the device refuses; with kAuto the CPU goes on in its place, here and below.
  Status prepare(const Camera& camera, Refine refine = Refine::kWhereRaysCome);
  /// Gives back what prepare() made; it may be called again.
  void discard();
  /// Precondition of all below: prepare() was called.
  /// Once a stop is requested, these two return soon, and what they return is of no use. Where
  /// parts are see-through, shade() looks at each by itself; then only where it is whole and opaque
  /// is the solid seen as in `frame`.
  Result<Frame> trace(const Camera& camera, const RenderControl& control = {});
  Result<Picture> shade(const Frame& frame, const Camera& camera, const ShadeSettings& settings,
                        int antialias, const std::stop_token& stop = {});
  /// A picture of all walls at once (image/xray.h). Facts are those that trace() finds.
  Result<Picture> xray(const Camera& camera, const ShadeSettings& settings, int antialias,
                       const std::stop_token& stop = {});
  /// Facts for any rays; hits.size() == rays.size().
  Status cast(std::span<const Ray> rays, std::span<Hit> hits);
  /// All crossings of any rays (Tracer::cast_through).
  Status cast_through(std::span<const Ray> rays, RayCrossings& found);

  Tracer& tracer() const;
  /// The tracer, if it is of that kind; else null.
  CpuTracer* cpu_tracer() const;
  RasterTracer* raster_tracer() const;
  /// The backend that is used; never kAuto.
  Backend backend() const;
  /// What of the pictures is not as the model says, as people read it; empty if all is.
  std::string picture_note();
  /// What the backend works on, as people read it; for kAuto also why it is not what was tried
  /// first. Empty where there is nothing to say.
  const std::string& backend_note() const;
  /// Null with the oracle, which does not use it.
  const Scene* scene() const;
  const CellTree* cells() const;
  const StageTimes& times() const;

 private:
  struct State;
  explicit Renderer(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace whittle
