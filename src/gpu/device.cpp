#include "gpu/device.h"

#include <mutex>

#include "gpu/instance.h"

namespace whittle::gpu {

struct Device::Log {
  mutable std::mutex mutex;
  std::vector<std::string> messages;

  static VkBool32 VKAPI_PTR add(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                VkDebugUtilsMessageTypeFlagsEXT,
                                const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    Log& log = *static_cast<Log*>(user);
    const std::lock_guard lock(log.mutex);
    log.messages.emplace_back(data->pMessage);
    return VK_FALSE;
  }
};

Device::Device() : log_(std::make_unique<Log>()) {}

Device::~Device() {
  if (device_ != VK_NULL_HANDLE) vkDestroyDevice(device_, nullptr);
  if (messenger_ != VK_NULL_HANDLE) vkDestroyDebugUtilsMessengerEXT(instance_, messenger_, nullptr);
  if (instance_ != VK_NULL_HANDLE) vkDestroyInstance(instance_, nullptr);
}

std::vector<std::string> Device::messages() const {
  const std::lock_guard lock(log_->mutex);
  return log_->messages;
}

Result<std::unique_ptr<Device>> Device::open(const DeviceOptions& options) {
  std::unique_ptr<Device> device(new Device);

  VkDebugUtilsMessengerCreateInfoEXT messenger{};
  messenger.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
  messenger.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                              VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
  messenger.pfnUserCallback = Log::add;
  messenger.pUserData = device->log_.get();
  const VkValidationFeatureEnableEXT enabled[] = {
      VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
  VkValidationFeaturesEXT validation{};
  validation.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
  validation.pNext = &messenger;  // for what happens before and after the messenger itself
  validation.enabledValidationFeatureCount = 1;
  validation.pEnabledValidationFeatures = enabled;
  Result<VkInstance> instance =
      make_instance(options.validate, options.validate ? &validation : nullptr);
  if (!instance) return instance.error();
  device->instance_ = *instance;
  if (options.validate) {
    const VkResult result =
        vkCreateDebugUtilsMessengerEXT(*instance, &messenger, nullptr, &device->messenger_);
    if (result != VK_SUCCESS) return error_of(result, "listen to the validation layer", "Vulkan");
  }

  const Result<std::vector<Candidate>> candidates = find_candidates(*instance);
  if (!candidates) return candidates.error();
  std::vector<DeviceInfo> infos;
  for (const Candidate& c : *candidates) infos.push_back(c.info);
  const Result<size_t> chosen = choose_device(infos, options.wanted);
  if (!chosen) return chosen.error();
  const Candidate& candidate = (*candidates)[*chosen];
  device->info_ = candidate.info;
  device->physical_ = candidate.physical;
  device->properties_ = candidate.properties;
  device->queue_family_ = candidate.queue_family;
  device->timestamp_bits_ = candidate.timestamp_bits;
  vkGetPhysicalDeviceMemoryProperties(candidate.physical, &device->memory_);

  const float priority = 1;
  VkDeviceQueueCreateInfo queue{};
  queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue.queueFamilyIndex = candidate.queue_family;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  VkPhysicalDeviceVulkan13Features features13{};
  features13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
  features13.dynamicRendering = VK_TRUE;
  features13.synchronization2 = VK_TRUE;
  features13.maintenance4 = VK_TRUE;  // what glslc writes of a workgroup's size needs it
  VkPhysicalDeviceFeatures features{};
  features.shaderFloat64 = candidate.info.float64;
  VkDeviceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.pNext = &features13;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.pEnabledFeatures = &features;
  const VkResult result = vkCreateDevice(candidate.physical, &info, nullptr, &device->device_);
  if (result != VK_SUCCESS) return device->error(result, "open the device");
  vkGetDeviceQueue(device->device_, candidate.queue_family, 0, &device->queue_);
  return device;
}

}  // namespace whittle::gpu
