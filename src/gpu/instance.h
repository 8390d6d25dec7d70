// The Vulkan instance and the physical devices that it shows: what listing and opening share.
#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "gpu/devices.h"
#include "gpu/vulkan.h"

namespace whittle::gpu {

/// One physical device, with what is asked of it before it is opened.
struct Candidate {
  VkPhysicalDevice physical;
  VkPhysicalDeviceProperties properties;
  uint32_t queue_family, timestamp_bits;  ///< of the queue that can draw and compute
  DeviceInfo info;
};

/// Makes an instance for Vulkan 1.3. `next` goes to its create info; with `validate` it has the
/// validation layer. The caller destroys it.
Result<VkInstance> make_instance(bool validate, const void* next);

/// The devices of an instance, best first.
Result<std::vector<Candidate>> find_candidates(VkInstance instance);

}  // namespace whittle::gpu
