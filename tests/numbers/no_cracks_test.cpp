// Closed solids at 2048 x 2048 (half as much at other leaf sizes than the usual): no background
// inside their outline, nothing far seen through something near. Where the outline is, and how near
// the surface must be, is known on paper for every ray.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include <fmt/format.h>

#include "agreement/cpu_subject.h"
#include "base/workers.h"
#include "generate/generate.h"
#include "numbers/accuracy.h"
#include "support/read_text.h"

namespace whittle {
namespace {

/// What a ray must see: something no nearer than `low` and no farther than `high`, or nothing.
struct Bound {
  double low = kInfinity, high = kInfinity;
  bool may_hit = false, must_hit = false;
};
Bound exactly(double t) {
  const bool hits = t < kInfinity;
  return {t, t, hits, hits};
}

/// t of the way in, or infinity.
double into_ball(const Ray& ray, double r) {
  const double nearest = -dot(ray.origin, ray.direction);
  const Vec3 p = ray.origin + ray.direction * nearest;
  const double left = r * r - dot(p, p);
  return left > 0 ? nearest - std::sqrt(left) : kInfinity;
}
double into_box(const Ray& ray, Vec3 low, Vec3 high) {
  double t0 = -kInfinity, t1 = kInfinity;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (low[axis] - ray.origin[axis]) / ray.direction[axis];
    const double b = (high[axis] - ray.origin[axis]) / ray.direction[axis];
    t0 = std::max(t0, std::min(a, b)), t1 = std::min(t1, std::max(a, b));
  }
  return t0 < t1 ? t0 : kInfinity;
}
/// About the z axis, from z = 0 to `height`.
double into_cylinder(const Ray& ray, double r, double height) {
  double t0 = -ray.origin.z / ray.direction.z, t1 = (height - ray.origin.z) / ray.direction.z;
  if (t1 < t0) std::swap(t0, t1);
  const auto product = [](Vec3 p, Vec3 q) { return p.x * q.x + p.y * q.y; };
  const double a = product(ray.direction, ray.direction);
  const double nearest = -product(ray.origin, ray.direction) / a;
  const Vec3 p = ray.origin + ray.direction * nearest;
  const double left = (r * r - product(p, p)) / a;
  if (!(left > 0)) return kInfinity;
  t0 = std::max(t0, nearest - std::sqrt(left)), t1 = std::min(t1, nearest + std::sqrt(left));
  return t0 < t1 ? t0 : kInfinity;
}

bool allows(const Bound& bound, const Hit& hit) {
  if (!hit.hit()) return !bound.must_hit;
  const double t = double(hit.distance), slack = 1e-6 * std::fabs(t);
  return bound.may_hit && t >= bound.low - slack && t <= bound.high + slack;
}

/// Every pixel must show what `bound_of` its ray allows, or, on an outline, that of a ray a
/// thousandth of a pixel aside.
template <class BoundOf>
void expect_no_cracks(const std::string& text, Camera camera, const BoundOf& bound_of) {
  const Model model = model_of(text);
  const Workers workers(0);
  for (const uint32_t leaf_size : {1u, 6u, 16u}) {
    camera.width = camera.height = leaf_size == 6 ? 2048 : 1024;
    SubdivideSettings settings;
    settings.leaf_size = leaf_size;
    CpuSubject cpu(model, settings);
    const Frame frame = cpu.tracer->render(camera, {});
    std::atomic<int> hits = 0, faults = 0;
    std::atomic<size_t> fault = 0;
    const auto see_row = [&](size_t y) {
      int hits_here = 0;
      for (int x = 0; x < camera.width; ++x) {
        const Hit& hit = frame.at(x, int(y));
        hits_here += hit.hit();
        const double px = x + 0.5, py = double(y) + 0.5;
        bool allowed = allows(bound_of(camera.ray(px, py)), hit);
        for (int i = 0; i < 8 && !allowed; ++i) {
          const double dx = std::cos(0.3 + i * 0.7854) * 1e-3,
                       dy = std::sin(0.3 + i * 0.7854) * 1e-3;
          allowed = allows(bound_of(camera.ray(px + dx, py + dy)), hit);
        }
        if (allowed) continue;
        ++faults;
        fault = y * size_t(camera.width) + size_t(x);
      }
      hits += hits_here;
    };
    workers.for_parts(size_t(camera.height), 16, [&](size_t first, size_t last, size_t) {
      for (size_t y = first; y < last; ++y) see_row(y);
    });
    const int x = int(fault % size_t(camera.width)), y = int(fault / size_t(camera.width));
    const Bound bound = bound_of(camera.ray(x + 0.5, y + 0.5));
    EXPECT_EQ(faults, 0) << fmt::format(
        "leaf size {}: such as pixel ({}, {}): id {} at {:.9g}, may be from {:.9g} to {:.9g}",
        leaf_size, x, y, frame.at(x, y).id, frame.at(x, y).distance, bound.low, bound.high);
    EXPECT_GT(hits, camera.width * camera.height / 8);
    EXPECT_EQ(cpu.tracer->stats().disagreements, 0u);
  }
}

/// A turn that is square to nothing, exact as the text is read.
constexpr const char* kTurn =
    "multmatrix([[0.36, 0.48, -0.8, 0], [-0.8, 0.6, 0, 0], [0.48, 0.64, 0.6, 0], [0, 0, 0, 1]])";
Ray turned_back(const Ray& ray) {
  const auto back = [](Vec3 v) {
    return Vec3{0.36 * v.x - 0.8 * v.y + 0.48 * v.z, 0.48 * v.x + 0.6 * v.y + 0.64 * v.z,
                -0.8 * v.x + 0.6 * v.z};
  };
  return {back(ray.origin), back(ray.direction), ray.t_min};
}

TEST(NoCracks, ABall) {
  const auto bound = [](const Ray& ray) { return exactly(into_ball(ray, 10)); };
  expect_no_cracks("sphere(10);", look({23, -31, 17}, {0, 0, 0}, 30), bound);
  // Square to the cells, through the planes between them.
  expect_no_cracks("sphere(10);", look_parallel({0, -50, 0}, {0, 0, 0}, 21), bound);
}

TEST(NoCracks, ATurnedBox) {
  expect_no_cracks(fmt::format("{} cube([10, 12, 14], center = true);", kTurn),
                   look({23, -31, 17}, {0, 0, 0}, 30), [](const Ray& ray) {
                     return exactly(into_box(turned_back(ray), {-5, -6, -7}, {5, 6, 7}));
                   });
}

TEST(NoCracks, AMengerSponge) {
  constexpr int kSide = 27;
  const auto is_hole = [](int x, int y, int z) {
    for (; x > 0 || y > 0 || z > 0; x /= 3, y /= 3, z /= 3)
      if ((x % 3 == 1) + (y % 3 == 1) + (z % 3 == 1) > 1) return true;
    return false;
  };
  // From little cube to little cube, until one is not a hole.
  const auto bound = [&](const Ray& ray) {
    double t = into_box(ray, {0, 0, 0}, {kSide, kSide, kSide});
    if (t == kInfinity) return Bound{};
    const Vec3 d = ray.direction;
    std::array<int, 3> at;
    Vec3 next;
    for (int axis = 0; axis < 3; ++axis) {
      at[size_t(axis)] = std::clamp(int(ray.origin[axis] + d[axis] * (t + 1e-9)), 0, kSide - 1);
      next[axis] = (at[size_t(axis)] + (d[axis] > 0) - ray.origin[axis]) / d[axis];
    }
    while (is_hole(at[0], at[1], at[2])) {
      const int axis = next.x < next.y && next.x < next.z ? 0 : next.y < next.z ? 1 : 2;
      at[size_t(axis)] += d[axis] > 0 ? 1 : -1;
      if (at[size_t(axis)] < 0 || at[size_t(axis)] >= kSide) return Bound{};
      t = next[axis];
      next[axis] += std::fabs(1 / d[axis]);
    }
    return exactly(t);
  };
  const Result<std::string> text = generate_model("menger", 3, kDefaultSeed);
  ASSERT_TRUE(text);
  expect_no_cracks(*text, look({61, -45, 50}, {13.5, 13.5, 13.5}, 30), bound);
  // Almost along an axis, so that all walls are seen edge on.
  expect_no_cracks(*text, look_parallel({13.6, -90, 13.7}, {13.5, 13.5, 13.5}, 28), bound);
}

TEST(NoCracks, ABallOfAThousandBalls) {
  // Middles on a ball of radius 9, no farther apart than they are thick: every ray that meets that
  // ball meets one of them, before it.
  std::string text;
  for (int i = 0; i < 1000; ++i) {
    const double z = 1 - (2 * i + 1) / 1000.0, turn = i * 2.399963229728653;
    const double r = std::sqrt(1 - z * z);
    text += fmt::format("translate([{}, {}, {}]) sphere(1.2);\n", 9 * r * std::cos(turn),
                        9 * r * std::sin(turn), 9 * z);
  }
  expect_no_cracks(text, look({23, -31, 17}, {0, 0, 0}, 28), [](const Ray& ray) {
    const double core = into_ball(ray, 9), all = into_ball(ray, 10.2000001);
    return Bound{all, core < kInfinity ? core : kInfinity, all < kInfinity, core < kInfinity};
  });
}

TEST(NoCracks, AWallOfBricksThatTouchAndOneOfBricksThatOverlap) {
  // 15 x 10 bricks, turned; where they only touch, they share the faces between them.
  for (const double size : {1.0, 1.25}) {
    SCOPED_TRACE(size);
    std::string text = std::string(kTurn) + "{\n";
    for (int y = 0; y < 10; ++y)
      for (int x = 0; x < 15; ++x)
        text += fmt::format("translate([{}, {}, 0]) cube([{}, {}, 1]);\n", 2 * x - 15, 2 * y - 10,
                            2 * size, 2 * size);
    text += "}\n";
    const double last = 2 * (size - 1);
    expect_no_cracks(text, look({-33, 4, 30}, {0, 0, 0}, 30), [&](const Ray& ray) {
      return exactly(into_box(turned_back(ray), {-15, -10, 0}, {15 + last, 10 + last, 1}));
    });
  }
}

TEST(NoCracks, CylindersEndToEnd) {
  std::string text = std::string(kTurn) + "{\n";
  for (int i = 0; i < 20; ++i)
    text += fmt::format("translate([0, 0, {}]) cylinder(h = 0.7, r = 5);\n", 0.7 * i);
  text += "}\n";
  expect_no_cracks(text, look({-33, 4, 30}, {-5, 0, 4}, 26),
                   [](const Ray& ray) { return exactly(into_cylinder(turned_back(ray), 5, 14)); });
}

TEST(NoCracks, ABallOfManyFacets) {
  // Between the ball that its vertices lie on and the ball that its facets touch.
  constexpr double kTurnOfFacet = 3.14159265358979 / 60;
  const double inner = 10 * std::cos(kTurnOfFacet) * std::cos(kTurnOfFacet) - 1e-6;
  expect_no_cracks("sphere(10, $fn = 60);", look({23, -31, 17}, {0, 0, 0}, 30),
                   [&](const Ray& ray) {
                     const double core = into_ball(ray, inner), all = into_ball(ray, 10.000001);
                     return Bound{all, core, all < kInfinity, core < kInfinity};
                   });
}

TEST(NoCracks, AHollowCheeseThatHidesItsLight) {
  // Bubbles inside a block that none of them reaches the side of: only the block is seen. Then cut
  // open by a half: the bubbles' far walls are seen, and never the ball behind the block.
  std::string bubbles;
  for (int i = 0; i < 300; ++i)
    bubbles += fmt::format("translate([{}, {}, {}]) sphere({});\n",
                           -8 + 16 * std::fmod(i * 0.7549, 1), -8 + 16 * std::fmod(i * 0.5698, 1),
                           -8 + 16 * std::fmod(i * 0.3247, 1), 0.6 + 0.01 * (i % 100));
  const std::string block = "difference() { cube(20, center = true);\n" + bubbles;
  const Camera camera = look({3, -48, 5}, {0, 0, 0}, 26);
  expect_no_cracks(block + "}", camera, [](const Ray& ray) {
    return exactly(into_box(ray, {-10, -10, -10}, {10, 10, 10}));
  });
  const auto cut_open = [](const Ray& ray) {
    // Behind the cut at y = 0 the material is 10 deep, and nothing shines through it.
    const double front = into_box(ray, {-10, 0, -10}, {10, 10, 10});
    const double back = into_box(ray, {-10, 9.6, -10}, {10, 10, 10});
    return Bound{front, back, front < kInfinity, back < kInfinity};
  };
  expect_no_cracks(block + "translate([-20, -20, -20]) cube([40, 20, 40]); }\n", camera, cut_open);
}

}  // namespace
}  // namespace whittle
