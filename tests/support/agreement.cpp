#include "support/agreement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

#include <fmt/format.h>

#include "model/instances.h"

namespace whittle {

namespace {

/// Sine of the angle between ray and surface below which a surface that is a tolerance off may be
/// met or missed.
constexpr double kLimb = 0.02;

constexpr int kLooks = 5;  ///< the centre, then the four displaced ones

/// What the oracle sees at one pixel, and from where.
struct Looks {
  std::array<Ray, kLooks> rays;
  std::array<Hit, kLooks> hits;
};

Vec3 point_of(const Ray& ray, const Hit& hit) {
  return ray.origin + ray.direction * double(hit.distance);
}

/// Sine of the angle between two normals; 1 if they point apart.
double normal_difference(Vec3f a, Vec3f b) {
  const Vec3 u = to_double(a), v = to_double(b);
  return dot(u, v) > 0 ? length(cross(u, v)) : 1;
}

/// The distance at which `ray` meets the plane that touches the surface at the hit of another ray.
double predicted_distance(const Ray& hit_ray, const Hit& hit, const Ray& ray) {
  const Vec3 n = to_double(hit.normal);
  return dot(n, point_of(hit_ray, hit) - ray.origin) / dot(n, ray.direction);
}

/// A pixel is certain if its answers lie on one smooth surface of one primitive.
bool is_certain(const Looks& looks, Vec3 eye) {
  const Hit& center = looks.hits[0];
  for (int i = 1; i < kLooks; ++i) {
    const Hit& hit = looks.hits[size_t(i)];
    if (hit.id != center.id) return false;
    if (!center.hit()) continue;
    const double expected = predicted_distance(looks.rays[0], center, looks.rays[size_t(i)]);
    const double scale = length(point_of(looks.rays[0], center) - eye);
    if (!(std::fabs(double(hit.distance) - expected) <= kDistanceAgreement * scale)) return false;
    if (normal_difference(hit.normal, center.normal) > kCertainNormals) return false;
  }
  return true;
}

/// Do some looks miss what that answer is a part of?
bool some_miss(const Looks& looks, const Hit& answer) {
  return std::any_of(looks.hits.begin(), looks.hits.end(),
                     [&](const Hit& other) { return other.id != answer.id; });
}

/// Does the hit's own ray only touch surfaces that turn away beside that answer? Which of them it
/// meets there, or none, is a matter of rounding, and where it does the other looks cannot tell.
/// `touch`: sine of the angle between ray and surface below which it only touches.
bool touches(const Hit& hit, const Looks& looks, const Hit& answer, const Ray& answer_ray,
             double touch) {
  const double to_silhouette = std::fabs(dot(to_double(answer.normal), answer_ray.direction));
  return some_miss(looks, answer) && hit.hit() && answer.hit() &&
         std::fabs(dot(to_double(hit.normal), looks.rays[0].direction)) <= touch &&
         normal_difference(hit.normal, answer.normal) <= kNormalAgreement + 1.5 * to_silhouette;
}

/// Is `hit` the oracle's answer number `i`, allowing for what the agreement.h constants say, and
/// for a surface that is `across` off?
bool matches(const Hit& hit, const Looks& looks, int i, Vec3 eye, double across,
             const AcceptsId& accepts) {
  const Hit& answer = looks.hits[size_t(i)];
  const Ray& ray = looks.rays[size_t(i)];
  // A surface that may be a little off is met a little beyond its limb.
  if (touches(hit, looks, answer, ray, across > 0 ? kLimb : kNormalAgreement)) return true;
  if (hit.hit() != answer.hit() || !accepts(ray, answer, hit.id)) return false;
  if (!hit.hit()) return !std::isfinite(hit.distance);

  if (std::fabs(length(to_double(hit.normal)) - 1) > kNormalAgreement) return false;
  // At a corner that other looks miss, any facet that meets there may be seen, and none of the
  // looks need see it. The corner is where the facet beside it, gone on, meets the hit's ray.
  const double at_corner = predicted_distance(ray, answer, looks.rays[0]);
  if (hit.id == answer.id && some_miss(looks, answer) &&
      std::fabs(double(hit.distance) - at_corner) <=
          kDistanceAgreement * length(point_of(ray, answer) - eye))
    return true;

  double normal_spread = 0;
  for (const Hit& other : looks.hits)
    if (other.id == answer.id)
      normal_spread = std::max(normal_spread, normal_difference(other.normal, answer.normal));
  if (!(normal_difference(hit.normal, answer.normal) <= kNormalAgreement + normal_spread))
    return false;

  double nearest = double(answer.distance), farthest = nearest;
  const double steepness = dot(to_double(answer.normal), ray.direction);
  for (const Ray& other : looks.rays) {
    // Where the surface turns away within the five rays, its distance says nothing any more.
    if (steepness * dot(to_double(answer.normal), other.direction) <= 0) return true;
    const double expected = predicted_distance(ray, answer, other);
    nearest = std::min(nearest, expected);
    farthest = std::max(farthest, expected);
  }
  const double slack = kDistanceAgreement * length(point_of(ray, answer) - eye) +
                       (kOriginRounding * length(ray.origin) + across) / std::fabs(steepness);
  return double(hit.distance) >= nearest - slack && double(hit.distance) <= farthest + slack;
}

std::vector<size_t> all_pixels(const Frame& frame) {
  std::vector<size_t> pixels(frame.hits.size());
  std::iota(pixels.begin(), pixels.end(), size_t(0));
  return pixels;
}

/// The ray through a pixel's centre.
Ray center_ray(const Camera& camera, size_t pixel) {
  return camera.ray(int(pixel) % camera.width + 0.5, int(pixel) / camera.width + 0.5);
}

/// Calls `visit(pixel index, looks)` for the given pixels.
template <class Visit>
void look_at_pixels(Tracer& oracle, const Camera& camera, const Frame& frame,
                    std::span<const size_t> pixels, const Visit& visit) {
  static constexpr double kOffsets[kLooks][2] = {{0, 0},
                                                 {-kDisplacement, -kDisplacement},
                                                 {kDisplacement, -kDisplacement},
                                                 {-kDisplacement, kDisplacement},
                                                 {kDisplacement, kDisplacement}};
  constexpr size_t kExtra = kLooks - 1;
  std::vector<PixelPosition> positions;
  for (const size_t pixel : pixels) {
    const int x = int(pixel) % camera.width, y = int(pixel) / camera.width;
    for (int i = 1; i < kLooks; ++i)
      positions.push_back({float(x + 0.5 + kOffsets[i][0]), float(y + 0.5 + kOffsets[i][1])});
  }
  std::vector<Hit> hits(positions.size());
  oracle.probe(camera, positions, hits);
  for (size_t n = 0; n < pixels.size(); ++n) {
    Looks looks;
    looks.rays[0] = center_ray(camera, pixels[n]);
    looks.hits[0] = frame.hits[pixels[n]];
    for (size_t i = 0; i < kExtra; ++i) {
      const PixelPosition& p = positions[n * kExtra + i];
      looks.rays[i + 1] = camera.ray(double(p.x), double(p.y));
      looks.hits[i + 1] = hits[n * kExtra + i];
    }
    visit(pixels[n], looks);
  }
}

/// What the oracle sees at the pixel's centre, and with the eye moved by `step` in four directions.
Looks look_from_beside(Tracer& oracle, const Camera& camera, size_t pixel, const Hit& center,
                       double step) {
  Looks looks;
  looks.rays[0] = center_ray(camera, pixel);
  looks.hits[0] = center;
  const PixelPosition position = {float(int(pixel) % camera.width) + 0.5f,
                                  float(int(pixel) / camera.width) + 0.5f};
  for (size_t i = 1; i < kLooks; ++i) {
    Camera beside = camera;
    beside.eye += camera.right * (i & 1 ? step : -step) + camera.up * (i & 2 ? step : -step);
    looks.rays[i] = center_ray(beside, pixel);
    oracle.probe(beside, {&position, 1}, {&looks.hits[i], 1});
  }
  return looks;
}

std::string describe(const Hit& hit) {
  if (!hit.hit()) return "nothing";
  return fmt::format("id {} at {:.9g}, normal ({:.6g}, {:.6g}, {:.6g})", hit.id, hit.distance,
                     hit.normal.x, hit.normal.y, hit.normal.z);
}

std::string describe_difference(const Model& model, const Camera& camera, size_t pixel,
                                const Looks& looks, bool certain, const char* subject,
                                const Hit& hit) {
  const Ray& ray = looks.rays[0];
  std::string text = fmt::format(
      "{}: pixel ({}, {}), {}: from ({:.17g}, {:.17g}, {:.17g}) along ({:.17g}, {:.17g}, {:.17g})\n"
      "  {} sees {}\n  oracle sees {}\n",
      model.file, int(pixel) % camera.width, int(pixel) / camera.width,
      certain ? "certain" : "ambiguous", ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x,
      ray.direction.y, ray.direction.z, subject, describe(hit), describe(looks.hits[0]));
  if (!certain)
    for (int i = 1; i < kLooks; ++i)
      text += fmt::format("  or, close by, {}\n", describe(looks.hits[size_t(i)]));
  return text;
}

Camera look_at(Vec3 target, Vec3 from_direction, double distance, int width, int height) {
  Camera camera;
  camera.forward = normalize(-from_direction);
  camera.right = normalize(cross(camera.forward, {0, 0, 1}));
  camera.up = cross(camera.right, camera.forward);
  camera.eye = target - camera.forward * distance;
  camera.width = width;
  camera.height = height;
  return camera;
}

}  // namespace

AgreementReport& operator+=(AgreementReport& sum, const AgreementReport& one) {
  sum.pixels += one.pixels;
  sum.hits += one.hits;
  sum.ambiguous += one.ambiguous;
  sum.unexplained += one.unexplained;
  sum.ambiguous_unmatched += one.ambiguous_unmatched;
  if (sum.first_difference.empty()) sum.first_difference = one.first_difference;
  return sum;
}

namespace {

const AcceptsId kSameId = [](const Ray&, const Hit& hit, uint32_t id) { return hit.id == id; };

/// What the report says before any pixel is compared; `unexplained` if the pictures cannot be.
AgreementReport first_report(const Frame& seen, const Frame& expected) {
  AgreementReport report;
  report.pixels = int(expected.hits.size());
  for (const Hit& hit : expected.hits) report.hits += hit.hit();
  if (seen.hits.size() != expected.hits.size()) {
    report.unexplained = report.pixels;
    report.first_difference = "the picture has another size";
  }
  return report;
}

/// Compares the given pixels and adds what it finds to the report.
void check_pixels(const Model& model, const char* subject, const Frame& seen, Tracer& oracle,
                  const Frame& expected, std::span<const size_t> pixels, const Camera& camera,
                  double across, const AcceptsId& accepts, AgreementReport& report) {
  look_at_pixels(oracle, camera, expected, pixels, [&](size_t pixel, const Looks& looks) {
    const Hit& hit = seen.hits[pixel];
    const auto matches_one = [&](const Looks& from, int count) {
      for (int i = 0; i < count; ++i)
        if (matches(hit, from, i, camera.eye, across, accepts)) return true;
      return false;
    };
    bool certain = is_certain(looks, camera.eye);
    bool matched = matches_one(looks, certain ? 1 : kLooks);
    if (certain && !matched) {
      // Near and far within rounding: surfaces that cross there may part between the two.
      const double rounding = kOriginRounding * length(looks.rays[0].origin);
      for (const double step : {rounding / 4, rounding}) {
        const Looks beside = look_from_beside(oracle, camera, pixel, looks.hits[0], step);
        certain = certain && is_certain(beside, camera.eye);
        matched = matched || matches_one(beside, kLooks);
      }
    }
    report.ambiguous += !certain;
    if (matched) return;
    ++(certain ? report.unexplained : report.ambiguous_unmatched);
    // A certain pixel tells more than an ambiguous one seen before it.
    if (report.first_difference.empty() || (certain && report.unexplained == 1))
      report.first_difference =
          describe_difference(model, camera, pixel, looks, certain, subject, hit);
  });
}

/// Compares those pixels of which a first glance cannot say that they are right.
AgreementReport check_different(const Model& model, const char* subject, const Frame& seen,
                                Tracer& oracle, const Frame& expected, const Camera& camera,
                                double across, const AcceptsId& accepts) {
  AgreementReport report = first_report(seen, expected);
  if (report.unexplained > 0) return report;
  std::vector<size_t> different;
  for (size_t pixel = 0; pixel < expected.hits.size(); ++pixel) {
    // The other looks can only forgive more.
    Looks one;
    one.rays.fill(center_ray(camera, pixel));
    one.hits.fill(expected.hits[pixel]);
    if (!matches(seen.hits[pixel], one, 0, camera.eye, 0, accepts)) different.push_back(pixel);
  }
  check_pixels(model, subject, seen, oracle, expected, different, camera, across, accepts, report);
  return report;
}

}  // namespace

AgreementReport check_agreement(const Model& model, Tracer& subject, Tracer& oracle,
                                const Camera& camera) {
  const Frame expected = oracle.render(camera), seen = subject.render(camera);
  AgreementReport report = first_report(seen, expected);
  if (report.unexplained > 0) return report;
  check_pixels(model, subject.name(), seen, oracle, expected, all_pixels(expected), camera, 0,
               kSameId, report);
  return report;
}

AgreementReport find_differences(const Model& model, Tracer& subject, Tracer& oracle,
                                 const Camera& camera, const AcceptsId& accepts) {
  const Frame expected = oracle.render(camera), seen = subject.render(camera);
  return check_different(model, subject.name(), seen, oracle, expected, camera, 0,
                         accepts ? accepts : kSameId);
}

AgreementReport check_pictures(const Model& model, const Frame& seen, Tracer& oracle,
                               const Frame& expected, const Camera& camera,
                               const AcceptsId& accepts) {
  return check_different(model, "the subject", seen, oracle, expected, camera,
                         tolerance(bounds(model)), accepts);
}

std::vector<uint8_t> ambiguous_pixels(Tracer& oracle, const Camera& camera, const Frame& frame) {
  std::vector<uint8_t> ambiguous(frame.hits.size());
  look_at_pixels(oracle, camera, frame, all_pixels(frame), [&](size_t pixel, const Looks& looks) {
    ambiguous[pixel] = !is_certain(looks, camera.eye);
  });
  return ambiguous;
}

std::vector<Camera> cameras_for(const Model& model, int width, int height) {
  const Bounds b = bounds(model);
  const Vec3 center = b.box.is_empty() ? Vec3{} : b.box.center();
  const double radius = b.box.diagonal() > 0 ? 0.5 * b.box.diagonal() : 1;
  // OpenSCAD's field of view, 22.5 degrees.
  const double half_fov = std::atan(1.0) / 4;

  Camera front =
      look_at(center, {0.57, -0.74, 0.43}, 1.02 * radius / std::sin(half_fov), width, height);
  front.half_height = std::tan(half_fov);

  Camera back = look_at(center, {-0.61, 0.53, -0.37}, 3 * radius, width, height);
  back.orthographic = true;
  back.half_height = 1.02 * radius;
  back.ortho_reach = 100 * radius;

  Camera inside = look_at(center + Vec3{0.083, -0.047, 0.061} * radius, {-0.33, -0.71, -0.21}, 0,
                          width, height);
  inside.half_height = 1;
  return {front, back, inside};
}

Camera camera_along(Vec3 eye, Vec3 direction) {
  const Vec3 d = normalize(direction);
  const Vec3 helper = std::fabs(d.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{0, 1, 0};
  Camera camera;
  camera.eye = eye;
  camera.forward = d;
  camera.right = normalize(cross(d, helper));
  camera.up = cross(camera.right, d);
  camera.half_height = 1e-3;
  camera.width = camera.height = 1;
  return camera;
}

Hit trace_one(Tracer& tracer, Vec3 eye, Vec3 direction) {
  return tracer.render(camera_along(eye, direction)).at(0, 0);
}

}  // namespace whittle
