#include "viewer/orbit_view.h"

#include <algorithm>
#include <cmath>

namespace whittle {
namespace {

constexpr double kDegreesPerPixel = 0.7;
constexpr double kZoomPerNotch = 0.9;
constexpr double kNearest = 1e-9, kFarthest = 1e12;
constexpr int kDigits = 6;

double wrapped(double degrees) {
  const double rest = std::fmod(degrees, 360);
  return rest < 0 ? rest + 360 : rest;
}

/// To a multiple of 10^exponent. Quotients of whole numbers are what a text of few digits means.
double rounded_to(double value, int exponent) {
  const double power = std::pow(10.0, std::abs(exponent));
  const double result =
      exponent < 0 ? std::round(value * power) / power : std::round(value / power) * power;
  return std::isfinite(result) ? result + 0.0 : value;
}

Vec3 rounded_to(Vec3 v, int exponent) {
  return {rounded_to(v.x, exponent), rounded_to(v.y, exponent), rounded_to(v.z, exponent)};
}

}  // namespace

ViewOptions view_options(const OrbitView& view, PictureSize size) {
  ViewOptions options;
  options.target = view.target;
  options.rotation_degrees = view.rotation_degrees;
  options.distance = view.distance;
  options.fov_degrees = view.fov_degrees;
  options.orthographic = view.orthographic;
  options.width = size.width;
  options.height = size.height;
  return options;
}

ViewOptions framing_options(const OrbitView& view, PictureSize size, bool tight) {
  ViewOptions options = view_options(view, size);
  options.view_all = options.auto_center = true;
  options.tight = tight;
  return options;
}

OrbitView orbit_view(const GimbalView& view, bool orthographic) {
  return {view.target, view.rotation_degrees, view.distance, view.fov_degrees, orthographic};
}

Camera camera_of(const OrbitView& view, PictureSize size) {
  return make_camera(view_options(view, size), {}, {});
}

OrbitView rounded(const OrbitView& view) {
  constexpr int kDegreesExponent = -2;
  OrbitView result = view;
  const Vec3 degrees = rounded_to(view.rotation_degrees, kDegreesExponent);
  result.rotation_degrees = {wrapped(degrees.x), wrapped(degrees.y), wrapped(degrees.z)};
  if (!(view.distance > 0)) return result;
  const int exponent = int(std::floor(std::log10(view.distance))) - (kDigits - 1);
  result.distance = rounded_to(view.distance, exponent);
  result.target = rounded_to(view.target, exponent);
  return result;
}

OrbitView orbited(OrbitView view, double right, double down) {
  return turned(view, -kDegreesPerPixel * right, kDegreesPerPixel * down);
}

OrbitView turned(OrbitView view, double about_z, double to_top) {
  Vec3& degrees = view.rotation_degrees;
  degrees = {wrapped(degrees.x - to_top), degrees.y, wrapped(degrees.z + about_z)};
  return view;
}

OrbitView panned(OrbitView view, PictureSize size, double right, double down, double depth) {
  const Camera camera = camera_of(view, size);
  const double pixel = camera.units_per_pixel() * (view.orthographic ? 1 : depth);
  view.target += camera.up * (down * pixel) - camera.right * (right * pixel);
  return view;
}

OrbitView zoomed(OrbitView view, double factor, Vec3 about) {
  const double distance = std::clamp(view.distance * factor, kNearest, kFarthest);
  if (!(view.distance > 0)) return view;
  view.target = about + (view.target - about) * (distance / view.distance);
  view.distance = distance;
  return view;
}

OrbitView pivoted(OrbitView view, Vec3 point) {
  view.target = point;
  return view;
}

OrbitView rotated_to(OrbitView view, Vec3 rotation_degrees) {
  view.rotation_degrees = rotation_degrees;
  return view;
}

double wheel_factor(double notches) {
  return std::pow(kZoomPerNotch, notches);
}

Vec3 point_on_target_plane(const OrbitView& view, PictureSize size, double x, double y) {
  const Camera camera = camera_of(view, size);
  const Ray ray = camera.ray(x, y);
  const double t =
      dot(camera.forward, view.target - ray.origin) / dot(camera.forward, ray.direction);
  return ray.origin + ray.direction * t;
}

}  // namespace whittle
