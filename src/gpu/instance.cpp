#include "gpu/instance.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <mutex>

#include "gpu/device.h"

namespace whittle::gpu {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

Error machine_error(std::string message) {
  return {ErrorKind::kMachine, std::move(message)};
}

/// Finds the loader, once.
Status find_loader() {
  static std::once_flag once;
  static VkResult result;
  std::call_once(once, [] { result = volkInitialize(); });
  if (result == VK_SUCCESS) return Done{};
  return machine_error("there is no Vulkan here: libvulkan.so.1 (Debian: libvulkan1) is missing");
}

bool has_layer(const char* name) {
  uint32_t count = 0;
  vkEnumerateInstanceLayerProperties(&count, nullptr);
  std::vector<VkLayerProperties> layers(count);
  vkEnumerateInstanceLayerProperties(&count, layers.data());
  layers.resize(count);
  return std::ranges::any_of(
      layers, [&](const VkLayerProperties& l) { return std::strcmp(l.layerName, name) == 0; });
}

DeviceType type_of(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return DeviceType::kDiscrete;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return DeviceType::kIntegrated;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return DeviceType::kVirtual;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return DeviceType::kSoftware;
    default:
      return DeviceType::kOther;
  }
}

std::string version_text(uint32_t version) {
  return std::to_string(VK_API_VERSION_MAJOR(version)) + "." +
         std::to_string(VK_API_VERSION_MINOR(version)) + "." +
         std::to_string(VK_API_VERSION_PATCH(version));
}

/// Looks for a queue that can do everything.
bool find_queue(Candidate& candidate) {
  uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(candidate.physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(candidate.physical, &count, families.data());
  for (uint32_t i = 0; i < count; ++i) {
    constexpr VkQueueFlags kWanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    if ((families[i].queueFlags & kWanted) != kWanted) continue;
    candidate.queue_family = i;
    candidate.timestamp_bits = families[i].timestampValidBits;
    return true;
  }
  return false;
}

Candidate describe(VkPhysicalDevice physical) {
  Candidate c{};
  c.physical = physical;
  vkGetPhysicalDeviceProperties(physical, &c.properties);
  c.info.name = c.properties.deviceName;
  c.info.type = type_of(c.properties.deviceType);
  c.info.api_major = VK_API_VERSION_MAJOR(c.properties.apiVersion);
  c.info.api_minor = VK_API_VERSION_MINOR(c.properties.apiVersion);
  c.info.driver = version_text(c.properties.driverVersion);
  VkPhysicalDeviceFeatures features;
  vkGetPhysicalDeviceFeatures(physical, &features);
  c.info.float64 = features.shaderFloat64 != 0;
  if (c.properties.apiVersion < VK_API_VERSION_1_3) {
    c.info.shortcoming =
        "Vulkan 1.3 is needed, and it has " + version_text(c.properties.apiVersion);
    return c;
  }
  VkPhysicalDeviceDriverProperties driver{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES, nullptr, {}, {}, {}, {}};
  VkPhysicalDeviceProperties2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &driver, {}};
  vkGetPhysicalDeviceProperties2(physical, &all);
  c.info.driver = std::string(driver.driverName) + " " + driver.driverInfo;
  if (!find_queue(c)) c.info.shortcoming = "no queue of it can both draw and compute";
  return c;
}

}  // namespace

Error error_of(VkResult result, const char* doing, const std::string& device) {
  std::string why;
  switch (result) {
    case VK_ERROR_DEVICE_LOST:
      return machine_error(device + ": the device was lost");
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
    case VK_ERROR_OUT_OF_HOST_MEMORY:
    case VK_ERROR_OUT_OF_POOL_MEMORY:
      return machine_error(device + ": out of memory");
    case VK_ERROR_INITIALIZATION_FAILED:
      why = "the driver could not start";
      break;
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      why = "no driver for it";
      break;
    case VK_TIMEOUT:
      why = "it took too long";
      break;
    default:
      why = "VkResult " + std::to_string(int(result));
  }
  return machine_error(device + ": cannot " + doing + ": " + why);
}

Result<VkInstance> make_instance(bool validate, const void* next) {
  if (Status found = find_loader(); !found) return found.error();
  if (validate && !has_layer(kValidationLayer)) {
    return machine_error(std::string("the Vulkan layer ") + kValidationLayer +
                         " (Debian: vulkan-validationlayers) is missing");
  }
  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.pApplicationName = "whittle";
  application.apiVersion = VK_API_VERSION_1_3;
  const char* const extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME};
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pNext = next;
  info.pApplicationInfo = &application;
  if (validate) {
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &kValidationLayer;
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = extensions;
  }
  VkInstance instance = VK_NULL_HANDLE;
  const VkResult result = vkCreateInstance(&info, nullptr, &instance);
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER) {
    return machine_error(
        "there is no Vulkan driver here (Debian's mesa-vulkan-drivers has one that needs no GPU)");
  }
  if (result != VK_SUCCESS) return error_of(result, "start", "Vulkan");
  // The loader's functions find the right driver by their first argument, so they serve all
  // instances and devices.
  static std::once_flag once;
  std::call_once(once, [&] { volkLoadInstance(instance); });
  return instance;
}

Result<std::vector<Candidate>> find_candidates(VkInstance instance) {
  uint32_t count = 0;
  VkResult result = vkEnumeratePhysicalDevices(instance, &count, nullptr);
  std::vector<VkPhysicalDevice> devices(count);
  if (result == VK_SUCCESS && count > 0)
    result = vkEnumeratePhysicalDevices(instance, &count, devices.data());
  if (result < VK_SUCCESS) return error_of(result, "list the devices", "Vulkan");
  devices.resize(count);
  if (devices.empty()) return machine_error("there is no Vulkan device here");
  std::vector<Candidate> candidates;
  for (const VkPhysicalDevice device : devices) candidates.push_back(describe(device));
  std::ranges::stable_sort(candidates, {}, [](const Candidate& c) { return c.info.type; });
  return candidates;
}

Result<std::vector<DeviceInfo>> list_devices() {
  const Result<VkInstance> instance = make_instance(false, nullptr);
  if (!instance) return instance.error();
  const Result<std::vector<Candidate>> candidates = find_candidates(*instance);
  vkDestroyInstance(*instance, nullptr);
  if (!candidates) return candidates.error();
  std::vector<DeviceInfo> devices;
  for (const Candidate& c : *candidates) devices.push_back(c.info);
  return devices;
}

}  // namespace whittle::gpu
