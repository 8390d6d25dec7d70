// What a build without Vulkan has in place of devices.cpp.
#include "gpu/devices.h"

namespace whittle::gpu {

Result<std::vector<DeviceInfo>> list_devices() {
  return Error{ErrorKind::kMachine, "this whittle was built without Vulkan (WHITTLE_VULKAN=OFF)"};
}

}  // namespace whittle::gpu
