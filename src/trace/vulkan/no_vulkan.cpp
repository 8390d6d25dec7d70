// What a build without Vulkan has in place of the backend.
#include "gpu/devices.h"
#include "subdivide/subdivide.h"
#include "trace/vulkan/raster.h"

namespace whittle {

class RasterDevice {};

Result<std::shared_ptr<RasterDevice>> open_raster_device(const RasterSettings&) {
  return gpu::list_devices().error();
}

std::string describe(const RasterDevice&) {
  return {};
}

bool is_software(const RasterDevice&) {
  return true;
}

double cell_margin(const RasterDevice&) {
  return kCellMargin;
}

std::vector<std::string> validation_messages(const RasterDevice&) {
  return {};
}

Result<std::unique_ptr<RasterTracer>> make_raster_tracer(std::shared_ptr<RasterDevice>,
                                                         const Scene&, const CellTree&,
                                                         const MakeTracer&, int) {
  return gpu::list_devices().error();
}

}  // namespace whittle
