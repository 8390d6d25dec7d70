#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>

#include "gpu/devices.h"

namespace whittle::gpu {
namespace {

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return lower;
}

std::string described(std::span<const DeviceInfo> devices) {
  std::string text;
  for (size_t i = 0; i < devices.size(); ++i) {
    text += text.empty() ? "" : ", ";
    text += std::to_string(i) + " (" + devices[i].name + ")";
  }
  return text.empty() ? "none" : text;
}

}  // namespace

const char* name_of(DeviceType type) {
  switch (type) {
    case DeviceType::kDiscrete:
      return "discrete";
    case DeviceType::kIntegrated:
      return "integrated";
    case DeviceType::kVirtual:
      return "virtual";
    case DeviceType::kSoftware:
      return "software";
    default:
      return "other";
  }
}

Result<size_t> choose_device(std::span<const DeviceInfo> devices, std::string_view wanted) {
  size_t chosen = devices.size();
  size_t number = 0;
  const char* end = wanted.data() + wanted.size();
  const auto [stop, problem] = std::from_chars(wanted.data(), end, number);
  if (wanted.empty()) {
    for (chosen = 0; chosen < devices.size() && !devices[chosen].shortcoming.empty();) ++chosen;
    // If none can be used, the best one says why.
    if (chosen == devices.size()) chosen = 0;
  } else if (problem == std::errc() && stop == end) {
    chosen = number;
  } else {
    const std::string part = lower_case(wanted);
    for (chosen = 0; chosen < devices.size(); ++chosen)
      if (lower_case(devices[chosen].name).find(part) != std::string::npos) break;
  }
  if (chosen >= devices.size()) {
    return Error{ErrorKind::kUsage, "no Vulkan device '" + std::string(wanted) +
                                        "'; there are: " + described(devices)};
  }
  if (!devices[chosen].shortcoming.empty()) {
    return Error{ErrorKind::kMachine,
                 devices[chosen].name + " cannot be used: " + devices[chosen].shortcoming};
  }
  return chosen;
}

bool has_graphics_hardware() {
  std::error_code ignored;
  // What the kernel's drivers make: Direct Rendering, NVIDIA's own, and Windows' in its subsystem.
  for (const char* file : {"/dev/nvidiactl", "/dev/dxg"})
    if (std::filesystem::exists(file, ignored)) return true;
  for (const auto& entry : std::filesystem::directory_iterator("/dev/dri", ignored))
    if (entry.path().filename().string().starts_with("renderD")) return true;
  return false;
}

}  // namespace whittle::gpu
