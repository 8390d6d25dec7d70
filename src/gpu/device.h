// A Vulkan device that is open for work: instance, logical device, one queue for all of it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "gpu/devices.h"
#include "gpu/vulkan.h"

namespace whittle::gpu {

struct DeviceOptions {
  std::string wanted;  ///< as for choose_device()
  /// Load the validation layer, with synchronisation validation, and keep what it says. A kMachine
  /// error if the layer is not installed.
  bool validate = false;
};

/// Vulkan's answer to a call, as an Error: one line that names the device. `doing` says what for,
/// as in "make a buffer".
Error error_of(VkResult result, const char* doing, const std::string& device);

/// Neither movable nor copyable: what is made on it refers to it, and must end before it.
class Device {
 public:
  static Result<std::unique_ptr<Device>> open(const DeviceOptions& options);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const DeviceInfo& info() const { return info_; }
  const VkPhysicalDeviceLimits& limits() const { return properties_.limits; }
  const VkPhysicalDeviceMemoryProperties& memory() const { return memory_; }
  /// Significant bits of a timestamp; 0: the queue has none.
  uint32_t timestamp_bits() const { return timestamp_bits_; }

  VkDevice handle() const { return device_; }
  VkPhysicalDevice physical() const { return physical_; }
  VkQueue queue() const { return queue_; }
  uint32_t queue_family() const { return queue_family_; }

  /// All that the validation layer has complained about so far.
  std::vector<std::string> messages() const;

  Error error(VkResult result, const char* doing) const {
    return error_of(result, doing, info_.name);
  }

 private:
  struct Log;
  Device();

  std::unique_ptr<Log> log_;
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  uint32_t queue_family_ = 0, timestamp_bits_ = 0;
  VkPhysicalDeviceProperties properties_{};
  VkPhysicalDeviceMemoryProperties memory_{};
  DeviceInfo info_;
};

}  // namespace whittle::gpu
