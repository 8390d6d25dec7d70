#include "numbers/accuracy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "agreement/cpu_subject.h"
#include "model/instances.h"
#include "support/read_text.h"
#include "trace/oracle/oracle.h"

namespace whittle {
namespace {

constexpr int kLooks = 9;  ///< the centre, then eight places around it
using Looks = std::array<Known, kLooks>;

Camera facing(Vec3 eye, Vec3 target, int width, int height) {
  Camera camera;
  camera.eye = eye;
  camera.forward = normalize(target - eye);
  const bool steep = std::fabs(camera.forward.z) == 1;
  camera.right = steep ? Vec3{1, 0, 0} : normalize(cross(camera.forward, {0, 0, 1}));
  camera.up = cross(camera.right, camera.forward);
  camera.width = width;
  camera.height = height;
  return camera;
}

/// The largest length that takes part in the arithmetic of a picture.
Exact largest_length(const Box& box, const Camera& camera) {
  const Vec3 all = max(max(abs(box.lo), abs(box.hi)), abs(camera.eye));
  return max_component(all);
}

Exact sine_between(ExactVec a, ExactVec b) {
  return dot(a, b) > 0 ? length(cross(a, b)) : 1;
}

bool same_surface(const Known& a, const Known& b) {
  return a.id == b.id && (a.id == 0 || dot(a.normal, b.normal) > Exact(0.9));
}

/// Is `hit` answer number `i`, give or take what the others near it say?
bool matches(const Hit& hit, const Looks& looks, size_t i, const ExactRay& ray, Exact reach) {
  const Known& known = looks[i];
  if (hit.id != known.id) return false;
  if (known.id == 0) return !std::isfinite(hit.distance);
  Exact along = 0, turned = 0;
  for (const Known& other : looks) {
    if (!same_surface(other, known)) continue;
    along = std::max(along, std::fabs(other.distance - known.distance));
    turned = std::max(turned, sine_between(other.normal, known.normal));
  }
  const Exact steepness = std::fabs(dot(known.normal, ray.direction));
  const Exact slack =
      2 * along + kDistance * std::fabs(known.distance) + kSideways * reach / steepness;
  const ExactVec normal = {hit.normal.x, hit.normal.y, hit.normal.z};
  return std::fabs(Exact(hit.distance) - known.distance) <= slack &&
         std::fabs(length(normal) - 1) <= kNormal &&
         sine_between(normal, known.normal) <= 2 * turned + kNormal;
}

std::string describe(const Known& known) {
  if (known.id == 0) return "nothing";
  return fmt::format("id {} at {:.12g}, normal ({:.9g}, {:.9g}, {:.9g})", known.id,
                     double(known.distance), double(known.normal.x), double(known.normal.y),
                     double(known.normal.z));
}

Known known_of(const Hit& hit) {
  return {hit.id, hit.distance, {hit.normal.x, hit.normal.y, hit.normal.z}};
}

}  // namespace

Camera look(Vec3 eye, Vec3 target, double fov_degrees, int width, int height) {
  Camera camera = facing(eye, target, width, height);
  camera.half_height = std::tan(fov_degrees * (std::atan(1.0) / 90));
  return camera;
}

Camera look_parallel(Vec3 eye, Vec3 target, double tall, int width, int height) {
  Camera camera = facing(eye, target, width, height);
  camera.orthographic = true;
  camera.half_height = tall / 2;
  camera.ortho_reach = 100 * length(target - eye);
  return camera;
}

PictureCounts expect_known(const std::string& text, const Camera& camera, const Answer& answer) {
  const Model model = model_of(text);
  const Exact reach = largest_length(bounds(model).box, camera);
  const size_t pixels = size_t(camera.width) * size_t(camera.height);
  PictureCounts counts;
  counts.pixels = int(pixels);

  std::vector<Looks> known(pixels);
  std::vector<uint8_t> undecided(pixels, 0);
  for (size_t p = 0; p < pixels; ++p) {
    const Exact x = Exact(p % size_t(camera.width)) + 0.5L;
    const Exact y = Exact(p / size_t(camera.width)) + 0.5L;
    const ExactRay center = exact_ray(camera, x, y);
    known[p][0] = answer(center);
    // How large a pixel is where something is seen; the eye's own rounding counts everywhere.
    const Exact away = camera.orthographic ? 1
                       : known[p][0].id != 0
                           ? std::max(known[p][0].distance, Exact(1e-30L))
                           : length(exact(camera.eye - bounds(model).box.center()));
    const Exact shift = kPixels + kSideways * reach / (away * camera.units_per_pixel());
    for (size_t i = 1; i < kLooks; ++i) {
      // Beside the axes and the diagonals, where edges run.
      const Exact angle = (Exact(i) + 0.3L) * std::acos(-1.0L) / 4;
      known[p][i] =
          answer(exact_ray(camera, x + shift * std::cos(angle), y + shift * std::sin(angle)));
      undecided[p] |= !same_surface(known[p][i], known[p][0]);
    }
    counts.hits += known[p][0].id != 0;
    counts.undecided += undecided[p];
  }

  // Nothing can agree to within what doubles of the model's own size do not resolve.
  Exact nearest = kExactInfinity;
  for (const Looks& looks : known) nearest = std::min(nearest, looks[0].distance);
  const bool comparable = kSideways * reach <= Exact(kDistanceAgreement) * nearest;
  const auto oracle = make_oracle_tracer(model);
  for (const uint32_t leaf_size : {1u, 2u, 6u, 16u}) {
    SubdivideSettings settings;
    settings.leaf_size = leaf_size;
    CpuSubject cpu(model, settings);
    const Frame frame = cpu.tracer->render(camera, {});
    int wrong = 0;
    std::string first;
    for (size_t p = 0; p < pixels; ++p) {
      const int column = int(p) % camera.width, row = int(p) / camera.width;
      const ExactRay ray = exact_ray(camera, column + 0.5L, row + 0.5L);
      bool matched = false;
      for (size_t i = 0; i < (undecided[p] ? size_t(kLooks) : 1); ++i)
        matched = matched || matches(frame.hits[p], known[p], i, ray, reach);
      if (matched) continue;
      if (wrong++ == 0)
        first = fmt::format("pixel ({}, {}){}: {}, but seen is {}", column, row,
                            undecided[p] ? " on an edge" : "", describe(known[p][0]),
                            describe(known_of(frame.hits[p])));
    }
    EXPECT_EQ(wrong, 0) << "leaf size " << leaf_size << ": " << first;
    EXPECT_EQ(cpu.tracer->stats().disagreements, 0u) << "leaf size " << leaf_size;
    if (!comparable || leaf_size != 6) continue;
    const AgreementReport report = check_agreement(model, *cpu.tracer, *oracle, camera);
    EXPECT_EQ(report.unexplained, 0) << report.first_difference;
    EXPECT_EQ(report.ambiguous_unmatched, 0) << report.first_difference;
  }
  return counts;
}

}  // namespace whittle
