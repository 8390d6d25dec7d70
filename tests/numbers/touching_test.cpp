// Curved bodies that almost touch, and cones where they end in a point.
#include <gtest/gtest.h>

#include <cmath>

#include <fmt/format.h>

#include "numbers/accuracy.h"

namespace whittle {
namespace {

/// Two bodies of radius 1 whose surfaces pass one another by `overlap` (a gap if negative).
struct Pair {
  double overlap;
  double apart() const { return 2 - overlap; }
};
constexpr Pair kPairs[] = {{1e-1}, {1e-3}, {1e-4}, {2e-5}, {-1e-3}, {-1e-4}, {-2e-5}};

/// Half the width of the lens that they share.
double lens_radius(const Pair& pair) {
  return std::sqrt(pair.overlap * (4 - pair.overlap)) / 2;
}

TEST(Touching, TwoSpheres) {
  for (const Pair& pair : kPairs) {
    SCOPED_TRACE(pair.overlap);
    const std::string both =
        fmt::format("sphere(1); translate([{}, 0, 0]) sphere(1);", pair.apart());
    const auto bodies = [&](const ExactRay& ray) {
      return std::vector{sphere(1, ray, {0, 0, 0}, 1), sphere(2, ray, {pair.apart(), 0, 0}, 1)};
    };
    const Answer joined = [&](const ExactRay& ray) { return seen_of_union(ray, bodies(ray)); };
    const Vec3 neck = {pair.apart() / 2, 0, 0};
    const double size = std::max(std::fabs(pair.overlap), 1e-9);
    expect_known(both, look({4, -7, 3}, neck, 30), joined);
    // From the side, so near that the gap or the overlap is some pixels wide.
    expect_known(both, look_parallel({neck.x, -9, 0}, neck, 4 * size), joined);
    const double wide = 4 * std::sqrt(size);
    expect_known(both, look_parallel({neck.x, -9, 0}, neck, wide), joined);
    expect_known(
        both, look({neck.x + 0.1 * wide, -9, 0.3 * wide}, neck, wide / 9 * (45 / std::atan(1.0))),
        joined);

    const std::string rest = "difference() { " + both + " }";
    const Answer cut = [&](const ExactRay& ray) { return seen_of_difference(ray, bodies(ray)); };
    expect_known(rest, look({4, -1, 0.7}, neck, 20), cut);
  }
}

TEST(Touching, TheLensOfTwoSpheres) {
  for (const Pair& pair : kPairs) {
    SCOPED_TRACE(pair.overlap);
    const std::string lens = fmt::format(
        "intersection() {{ sphere(1); translate([{}, 0, 0]) sphere(1); }}", pair.apart());
    const Answer answer = [&](const ExactRay& ray) {
      return seen_of_intersection(
          ray, {sphere(1, ray, {0, 0, 0}, 1), sphere(2, ray, {pair.apart(), 0, 0}, 1)});
    };
    if (pair.overlap < 0) {
      // Nothing is shared, so nothing is seen.
      EXPECT_EQ(expect_known(lens, look({4, -7, 3}, {1, 0, 0}, 30), answer).hits, 0);
      continue;
    }
    const Vec3 middle = {pair.apart() / 2, 0, 0};
    const double r = lens_radius(pair);
    // Along its axis it is a disc of radius r; from the side a blade `overlap` thick.
    const PictureCounts disc =
        expect_known(lens, look_parallel({9, 0, 0}, middle, 3 * r, 48, 48), answer);
    EXPECT_NEAR(disc.hits, std::acos(-1.0) * 16 * 16, 40);
    const PictureCounts blade =
        expect_known(lens, look_parallel({middle.x, -9, 0}, middle, 2 * pair.overlap), answer);
    EXPECT_NEAR(blade.hits, 24 * 48, pair.overlap > 0.01 ? 48 : 0);
    expect_known(lens, look({middle.x + 3 * r, -2 * r, r}, middle, 60), answer);
  }
}

TEST(Touching, TwoCylinders) {
  for (const Pair& pair : kPairs) {
    SCOPED_TRACE(pair.overlap);
    const std::string both = fmt::format(
        "cylinder(h = 2, r = 1); translate([{}, 0, 0]) cylinder(h = 2, r = 1);", pair.apart());
    const auto bodies = [&](const ExactRay& ray) {
      return std::vector{cylinder(1, ray, 2, {0, 0, 0}, 1, 2),
                         cylinder(2, ray, 2, {pair.apart(), 0, 0}, 1, 2)};
    };
    const Answer joined = [&](const ExactRay& ray) { return seen_of_union(ray, bodies(ray)); };
    const Vec3 neck = {pair.apart() / 2, 0, 1};
    const double size = std::fabs(pair.overlap);
    expect_known(both, look({4, -7, 3}, neck, 30), joined);
    // From the side; and straight down, along the walls.
    expect_known(both, look_parallel({neck.x, -9, 1}, neck, 4 * size), joined);
    expect_known(both, look_parallel({neck.x, 0, 9}, neck, 4 * std::sqrt(size)), joined);
    expect_known(both, look({neck.x, 0, 9}, neck, 4 * std::sqrt(size)), joined);

    const std::string shared = "intersection() { " + both + " }";
    const Answer lens = [&](const ExactRay& ray) { return seen_of_intersection(ray, bodies(ray)); };
    const PictureCounts counts =
        expect_known(shared, look_parallel({neck.x, -9, 1}, neck, 2 * size), lens);
    EXPECT_EQ(counts.hits, pair.overlap > 0 ? 24 * 48 : 0);
    expect_known(shared, look({neck.x + 2, -3, 4}, neck, 30), lens);
  }
}

TEST(Touching, ConesAtTheirTips) {
  const Answer upright = [](const ExactRay& ray) {
    return seen_of_union(ray, {cone(1, ray, {0, 0, 0}, 1, 2)});
  };
  const std::string one = "cylinder(h = 2, r1 = 1, r2 = 0);";
  // From above, straight and aslant, whole and at the tip.
  for (const double tall : {3.0, 1e-2}) {
    SCOPED_TRACE(tall);
    expect_known(one, look_parallel({0, 0, 9}, {0, 0, 2}, tall), upright);
    expect_known(one, look_parallel({3, -5, 9}, {0, 0, 2}, tall), upright);
    expect_known(one, look_parallel({0, -5, 2}, {0, 0, 2}, tall), upright);
    // Along a line of its side: (1, 0, 0) to (0, 0, 2).
    expect_known(one, look_parallel({-2, 0, 6}, {0, 0, 2}, tall), upright);
    expect_known(one, look_parallel({4, 0, -6}, {0, 0, 2}, tall), upright);
    expect_known(one, look({0, 0, 9}, {0, 0, 2}, tall * 8), upright);
    expect_known(one, look({3, -5, 9}, {0, 0, 2}, tall * 8), upright);
  }
  // Tip to tip: ids change at the height of the tips.
  const std::string glass =
      "cylinder(h = 2, r1 = 1, r2 = 0); translate([0, 0, 2]) cylinder(h = 2, r1 = 0, r2 = 1);";
  const Answer both = [](const ExactRay& ray) {
    return seen_of_union(ray, {cone(1, ray, {0, 0, 0}, 1, 2), cone(2, ray, {0, 0, 4}, 1, -2)});
  };
  for (const double tall : {6.0, 1e-2}) {
    SCOPED_TRACE(tall);
    expect_known(glass, look_parallel({0.1, -5, 2.2}, {0, 0, 2}, tall), both);
    expect_known(glass, look_parallel({0.3, -5, 4}, {0, 0, 2}, tall), both);
    expect_known(glass, look({3, -5, 7}, {0, 0, 2}, tall * 8), both);
  }
}

// At fields of view that show no more of a cone than its tip.
TEST(Touching, ATipThatFillsThePicture) {
  for (const double fov : {1e-4, 1e-5, 1e-6, 1e-7}) {
    SCOPED_TRACE(fov);
    const Answer pointed = [](const ExactRay& ray) {
      return seen_of_union(ray, {cone(1, ray, {0, 0, 0}, 5, 10)});
    };
    const Camera camera = look({8, -6, 12}, {0, 0, 10}, fov);
    const PictureCounts counts = expect_known("cylinder(h = 10, r1 = 5, r2 = 0);", camera, pointed);
    // From the picture's middle down a triangle as wide as it is high, or almost.
    EXPECT_NEAR(counts.hits, 24 * 24 / 2, 24);
    // Turned over, so small that other arithmetic is chosen, and flat.
    const Answer standing = [](const ExactRay& ray) {
      return seen_of_union(ray, {cone(1, ray, {0, 0, 20}, 5, -10)});
    };
    expect_known("translate([0, 0, 10]) cylinder(h = 10, r1 = 0, r2 = 5);", camera, standing);
    const Answer small = [](const ExactRay& ray) {
      return seen_of_union(
          ray, {cone(1, ray, {0, 0, 9.75L}, 0.125L, 0.25L), box(2, ray, {-9, -9, -9}, {9, 9, 9})});
    };
    expect_known(
        "translate([0, 0, 9.75]) cylinder(h = 0.25, r1 = 0.125, r2 = 0); cube(18, center = true);",
        camera, small);
    const Answer flat = [](const ExactRay& ray) {
      return seen_of_union(ray, {cone(1, ray, {0, 0, 9}, 64, 1)});
    };
    expect_known("translate([0, 0, 9]) cylinder(h = 1, r1 = 64, r2 = 0);",
                 look({80, -60, 10.5}, {0, 0, 10}, fov), flat);
  }
}

TEST(Touching, AnEyeNearTwoTips) {
  const std::string glass =
      "cylinder(h = 10, r1 = 5, r2 = 0);"
      "translate([0, 0, 10]) cylinder(h = 10, r1 = 0, r2 = 5);";
  const auto bodies = [](const ExactRay& ray) {
    return std::vector{cone(1, ray, {0, 0, 0}, 5, 10), cone(2, ray, {0, 0, 20}, 5, -10)};
  };
  const Answer alone = [&](const ExactRay& ray) { return seen_of_union(ray, bodies(ray)); };
  // The cones are a hundredth of the model, too.
  const Answer in_large = [&](const ExactRay& ray) {
    auto all = bodies(ray);
    all.push_back(box(3, ray, {-1000, 0, 0}, {-999, 1, 1}));
    return seen_of_union(ray, all);
  };
  const std::string large = glass + "translate([-1000, 0, 0]) cube(1);";
  // Outside of both, inside of one, and level with the tips.
  for (const Vec3 from_tip : {Vec3{0.3, -1, 0.003}, Vec3{0.25, 0.25, 1}, Vec3{-1, 0.5, 0}}) {
    SCOPED_TRACE(testing::Message() << from_tip.x << ", " << from_tip.y << ", " << from_tip.z);
    const Vec3 tip = {0, 0, 10};
    for (const double distance : {1e-2, 1e-5, 1e-7}) {
      SCOPED_TRACE(distance);
      expect_known(glass, look(tip + from_tip * distance, tip, 100), alone);
      expect_known(large, look(tip + from_tip * distance, tip, 100), in_large);
    }
  }
}

}  // namespace
}  // namespace whittle
