// The vulkan-raster backend: the cells are drawn as boxes, and each fragment solves its cell.
//
// Based on: Romeiro, Velho, de Figueiredo 2008, sections 2.3 and 3. What we changed: cells carry
// numbers of half-spaces, whose parameters are uploaded once; boxes are drawn by few indirect
// calls; the depth of a fragment is its cell's rank from front to back, so cells in front hide
// those behind before a fragment runs (docs/decisions/0020-depth-is-rank.md); fragments only say
// which cell is seen, and the facts are made once a pixel; with floats they prove it, or say that
// they cannot (docs/decisions/0021-double-in-shaders.md). How it works: docs/vulkan.md.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "subdivide/cells.h"
#include "trace/tracer.h"
#include "trace/vulkan/raster_settings.h"

namespace whittle {

class RasterTracer : public Tracer {
 public:
  /// Does all that render() does, but for drawing and finding facts: what the paper calls the time
  /// to traverse and set up. Precondition: render() was called.
  virtual void set_up(const Camera& camera) = 0;
  virtual RasterStats stats() const = 0;
};

/// A device with the backend's shaders on it, for any number of tracers, used from one thread at a
/// time.
class RasterDevice;

/// A kUsage error if there is no such device; a kMachine error if there is no Vulkan, or the device
/// cannot do it.
Result<std::shared_ptr<RasterDevice>> open_raster_device(const RasterSettings& settings = {});
/// Its name and driver, and what its shaders compute with.
std::string describe(const RasterDevice& device);
/// Whether it is the CPU that does its work.
bool is_software(const RasterDevice& device);
/// How far beyond its cell a leaf must be right for the device, SubdivideSettings::margin: floats
/// are less sure of where a cell ends. With less all is right, too, but nearly all is in doubt.
double cell_margin(const RasterDevice& device);
/// All that the validation layer has complained about.
std::vector<std::string> validation_messages(const RasterDevice& device);

/// Makes a tracer for the same scene and cells that computes in doubles.
using MakeTracer = std::function<std::unique_ptr<Tracer>()>;

/// If cells are open, the first picture refines those that it needs, on that many threads (0: all),
/// while others are drawn; later pictures refine first what they may see. `scene` must outlive the
/// tracer. A kMachine error if the device has no room for the cells.
///
/// The tracer made by `second_look` answers what the device is not asked: rays that are no
/// camera's, and pixels at which shaders that compute in floats cannot prove what they see
/// (docs/numerics.md). It is made when it is first needed.
Result<std::unique_ptr<RasterTracer>> make_raster_tracer(std::shared_ptr<RasterDevice> device,
                                                         const Scene& scene, const CellTree& cells,
                                                         const MakeTracer& second_look,
                                                         int threads = 0);

}  // namespace whittle
