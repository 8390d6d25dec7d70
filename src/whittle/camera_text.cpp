#include "whittle/camera_text.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace whittle {
namespace {

Error camera_error(std::string message) {
  return {ErrorKind::kUsage, std::move(message)};
}

}  // namespace

Result<ViewOptions> parse_camera(std::string_view text, ViewOptions base) {
  std::array<double, 7> v{};
  size_t count = 0;
  const std::string quoted = " (--camera=" + std::string(text) + ")";
  for (std::string_view rest = text;; ++count) {
    const size_t comma = rest.find(',');
    std::string_view word = rest.substr(0, comma);
    while (!word.empty() && (word.front() == ' ' || word.front() == '\t')) word.remove_prefix(1);
    while (!word.empty() && (word.back() == ' ' || word.back() == '\t')) word.remove_suffix(1);
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
    double value = 0;
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (code != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
      return camera_error("Camera setup requires numbers as parameters" + quoted);
    }
    if (count < v.size()) v[count] = value;
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  ++count;
  if (count == 7) {
    base.target = Vec3{v[0], v[1], v[2]};
    base.rotation_degrees = Vec3{v[3], v[4], v[5]};
    base.distance = v[6];
    base.eye = base.center = std::nullopt;
    return base;
  }
  if (count == 6) {
    base.eye = Vec3{v[0], v[1], v[2]};
    base.center = Vec3{v[3], v[4], v[5]};
    base.target = base.rotation_degrees = std::nullopt;
    base.distance = std::nullopt;
    return base;
  }
  return camera_error(
      "Camera setup requires either 7 numbers for Gimbal Camera or 6 numbers for Vector Camera" +
      quoted);
}

std::string camera_text(const ViewOptions& options) {
  const auto list = [](Vec3 v) { return fmt::format("{},{},{}", v.x, v.y, v.z); };
  if (options.eye || options.center) {
    const Vec3 center = options.center.value_or(Vec3{});
    return list(options.eye.value_or(center + Vec3{0, 0, kDefaultDistance})) + ',' + list(center);
  }
  return list(options.target.value_or(Vec3{})) + ',' +
         list(options.named ? rotation_of(*options.named)
                            : options.rotation_degrees.value_or(kDefaultRotationDegrees)) +
         fmt::format(",{}", options.distance.value_or(kDefaultDistance));
}

}  // namespace whittle
