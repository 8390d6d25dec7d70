#include "image/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/result.h"

namespace whittle {
namespace {

struct HitDifference {
  bool hit = false, id = false, distance = false, normal = false;
  double distance_error = 0, relative_error = 0, degrees = 0;
  bool any() const { return hit || id || distance || normal; }
};

double angle_degrees(Vec3f a, Vec3f b) {
  const Vec3 u{a.x, a.y, a.z}, v{b.x, b.y, b.z};
  // acos of the dot product would see nothing below 1e-8 radians.
  return std::atan2(length(cross(u, v)), dot(u, v)) * (180 / std::acos(-1.0));
}

HitDifference difference(const Hit& a, const Hit& b, const CompareSettings& settings) {
  HitDifference d;
  d.hit = a.hit() != b.hit();
  if (!a.hit() || !b.hit()) return d;
  d.id = a.id != b.id;
  const double ta = a.distance, tb = b.distance;
  d.distance_error = std::fabs(ta - tb);
  const double scale = std::max({std::fabs(ta), std::fabs(tb), settings.distance_floor});
  d.relative_error = d.distance_error == 0 ? 0 : d.distance_error / scale;
  d.distance = !(d.relative_error <= settings.distance_relative);
  d.degrees = angle_degrees(a.normal, b.normal);
  d.normal = !(d.degrees <= settings.normal_degrees);
  return d;
}

bool is_ignored(std::span<const uint8_t> mask, size_t i) {
  return !mask.empty() && mask[i] != 0;
}

std::string describe_hit(const Hit& h) {
  if (!h.hit()) return "nothing";
  return fmt::format("id {} at {:.9g}, normal ({:.6g}, {:.6g}, {:.6g})", h.id, h.distance,
                     h.normal.x, h.normal.y, h.normal.z);
}

}  // namespace

Comparison compare(const Frame& a, const Frame& b, const CompareSettings& settings,
                   std::span<const uint8_t> ignore_mask) {
  Comparison c{.width_a = a.width,
               .height_a = a.height,
               .width_b = b.width,
               .height_b = b.height,
               .first = {}};
  if (!c.same_size()) return c;
  WHITTLE_CHECK(ignore_mask.empty() || ignore_mask.size() == a.hits.size());
  for (size_t i = 0; i < a.hits.size(); ++i) {
    if (is_ignored(ignore_mask, i)) {
      ++c.ignored;
      continue;
    }
    ++c.pixels;
    const HitDifference d = difference(a.hits[i], b.hits[i], settings);
    c.hit_differs += d.hit;
    c.id_differs += d.id;
    c.distance_differs += d.distance;
    c.normal_differs += d.normal;
    c.max_distance_error = std::max(c.max_distance_error, d.distance_error);
    c.max_relative_distance_error = std::max(c.max_relative_distance_error, d.relative_error);
    c.max_normal_degrees = std::max(c.max_normal_degrees, d.degrees);
    if (d.any() && c.differing++ == 0) {
      c.first = {int(i % size_t(a.width)), int(i / size_t(a.width)), a.hits[i], b.hits[i]};
    }
  }
  return c;
}

std::string describe(const Comparison& c) {
  if (!c.same_size()) {
    return fmt::format("the frames differ in size: {}x{} and {}x{}", c.width_a, c.height_a,
                       c.width_b, c.height_b);
  }
  const std::string ignored = c.ignored ? fmt::format(", {} ignored", c.ignored) : "";
  const std::string errors =
      fmt::format("largest distance error {:.3g} (relative {:.3g}), largest normal angle {:.3g}°",
                  c.max_distance_error, c.max_relative_distance_error, c.max_normal_degrees);
  if (c.equal()) return fmt::format("equal: {} pixels{}; {}", c.pixels, ignored, errors);
  std::string text = fmt::format(
      "{} of {} pixels differ{}: hit {}, id {}, distance {}, normal {}\n{}", c.differing, c.pixels,
      ignored, c.hit_differs, c.id_differs, c.distance_differs, c.normal_differs, errors);
  text += fmt::format("\nfirst at pixel ({}, {}):\n  a: {}\n  b: {}", c.first.x, c.first.y,
                      describe_hit(c.first.a), describe_hit(c.first.b));
  return text;
}

Picture difference_picture(const Frame& a, const Frame& b, const CompareSettings& settings,
                           std::span<const uint8_t> ignore_mask) {
  if (a.width != b.width || a.height != b.height) return {};
  WHITTLE_CHECK(ignore_mask.empty() || ignore_mask.size() == a.hits.size());
  Picture picture(a.width, a.height);
  for (size_t i = 0; i < a.hits.size(); ++i) {
    const HitDifference d = difference(a.hits[i], b.hits[i], settings);
    const Rgb8 color = is_ignored(ignore_mask, i) ? Rgb8{255, 246, 190}
                       : d.hit                    ? Rgb8{214, 30, 40}
                       : d.id                     ? Rgb8{245, 140, 20}
                       : d.distance               ? Rgb8{150, 50, 200}
                       : d.normal                 ? Rgb8{30, 90, 220}
                       : a.hits[i].hit()          ? Rgb8{205, 205, 205}
                                                  : Rgb8{255, 255, 255};
    uint8_t* p = &picture.rgba[4 * i];
    p[0] = color.r, p[1] = color.g, p[2] = color.b, p[3] = 255;
  }
  return picture;
}

}  // namespace whittle
