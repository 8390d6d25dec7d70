// The Vulkan devices of this machine, as users see and choose them. Nothing of Vulkan is in this
// header, and a build without Vulkan has it too.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace whittle::gpu {

/// From what is usually the fastest to what is the slowest.
enum class DeviceType { kDiscrete, kIntegrated, kVirtual, kOther, kSoftware };

struct DeviceInfo {
  std::string name;
  DeviceType type = DeviceType::kOther;
  std::string driver;  ///< its name and version
  uint32_t api_major = 0, api_minor = 0;
  bool float64 = false;     ///< shaders can compute in double precision
  std::string shortcoming;  ///< why it cannot be used; empty if it can
};

const char* name_of(DeviceType type);

/// The devices, the usually fastest first. A kMachine error if there is no Vulkan here: built
/// without it, no loader, no driver, or no device.
Result<std::vector<DeviceInfo>> list_devices();

/// The number of the device that `wanted` names: its number in the list, or a part of its name in
/// any case; empty: the first that can be used. A kUsage error if it names none, and a kMachine
/// error if it cannot be used.
Result<size_t> choose_device(std::span<const DeviceInfo> devices, std::string_view wanted);

/// Whether the system has a graphics device at all, told by its device files, without waking any
/// driver. Where it has none, Vulkan could only be computed by the CPU.
bool has_graphics_hardware();

}  // namespace whittle::gpu
