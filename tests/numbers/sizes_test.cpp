// Very small beside very large: things seen from afar, far from the origin, of many sizes in one
// model, and thin ones.
#include <gtest/gtest.h>

#include <cmath>

#include <fmt/format.h>

#include "numbers/accuracy.h"

namespace whittle {
namespace {

TEST(Sizes, AHoleOfOneMillimetreFromTenMetresAndFromTenKilometres) {
  const std::string plate =
      "difference() { translate([-50, -50, -5]) cube([100, 100, 10]);"
      " cylinder(h = 30, r = 0.5, center = true); }";
  const Answer answer = [](const ExactRay& ray) {
    return seen_of_difference(ray, {box(1, ray, {-50, -50, -5}, {50, 50, 5}),
                                    cylinder(2, ray, 2, {0, 0, -15}, 0.5L, 30)});
  };
  for (const double away : {1e4, 1e7}) {
    SCOPED_TRACE(away);
    const double fov = 2 / away * (45 / std::atan(1.0));
    // So nearly from above that the wall of the hole is seen, and the light at its end too.
    for (const Vec3 aside : {Vec3{0, 0, 0}, Vec3{0.031, -0.043, 0}}) {
      const Vec3 eye = Vec3{0, 0, away} + aside * away;
      const PictureCounts counts = expect_known(plate, look(eye, {0, 0, 5}, fov), answer);
      EXPECT_GT(counts.hits, counts.pixels / 2);
      EXPECT_LT(counts.hits, counts.pixels);
      EXPECT_LE(counts.undecided, 2);
      expect_known(plate, look_parallel(eye, {0, 0, 5}, 2), answer);
    }
  }
}

TEST(Sizes, FarFromTheOriginNothingIsLost) {
  for (const Vec3 at : {Vec3{1e6, -1e6, 1e6}, Vec3{1e9, 0, 0}, Vec3{-1e9, 1e9, 1e9}}) {
    SCOPED_TRACE(fmt::format("at ({}, {}, {})", at.x, at.y, at.z));
    const std::string drilled = fmt::format(
        "translate([{}, {}, {}]) difference() {{ cube(10, center = true); sphere(6.5);"
        " cylinder(h = 20, r = 2, center = true); }}",
        at.x, at.y, at.z);
    const ExactVec middle = exact(at);
    const ExactVec half = {5, 5, 5};
    const Answer answer = [&](const ExactRay& ray) {
      return seen_of_difference(
          ray, {box(1, ray, middle - half, middle + half), sphere(2, ray, middle, 6.5L),
                cylinder(3, ray, 2, middle - ExactVec{0, 0, 10}, 2, 20)});
    };
    for (const Vec3 from : {Vec3{16, -20, 13}, Vec3{0, 0, 30}, Vec3{0.5, 0.25, 0.125}}) {
      const PictureCounts counts = expect_known(drilled, look(at + from, at, 40), answer);
      EXPECT_GT(counts.hits, counts.pixels / 10);
      EXPECT_LE(counts.undecided, counts.pixels / 50);
    }
    expect_known(drilled, look_parallel(at + Vec3{16, -20, 13}, at, 16), answer);
  }
}

TEST(Sizes, FromMillionthsToMillionsInOneModel) {
  // A drilled block of edge s stands at x = 3 s, for every power of ten.
  constexpr int kLow = -6, kHigh = 6;
  std::string blocks;
  for (int power = kLow; power <= kHigh; ++power)
    blocks += fmt::format(
        "multmatrix([[1e{0}, 0, 0, 3e{0}], [0, 1e{0}, 0, 0], [0, 0, 1e{0}, 0], [0, 0, 0, 1]])"
        " difference() {{ cube(1);"
        " translate([0.5, 0.5, -1]) cylinder(h = 3, r = 0.25); }}",
        power);
  const Answer answer = [](const ExactRay& ray) {
    Known nearest;
    for (int power = kLow; power <= kHigh; ++power) {
      // The text is read as doubles.
      const Exact s = Exact(std::stod(fmt::format("1e{}", power)));
      const Exact x = Exact(std::stod(fmt::format("3e{}", power)));
      const uint32_t id = uint32_t(2 * (power - kLow) + 1);
      const Known block =
          seen_of_difference(ray, {box(id, ray, {x, 0, 0}, {x + s, s, s}),
                                   cylinder(id + 1, ray, 2, {x + s / 2, s / 2, -s}, s / 4, 3 * s)});
      if (block.distance < nearest.distance) nearest = block;
    }
    return nearest;
  };
  for (int power = kLow; power <= kHigh; ++power) {
    SCOPED_TRACE(fmt::format("the block of edge 1e{}", power));
    const double s = std::pow(10, power);
    const Vec3 middle = Vec3{3.5, 0.5, 0.5} * s;
    const PictureCounts counts =
        expect_known(blocks, look(middle + Vec3{1.5, -2, 3} * s, middle, 30), answer);
    EXPECT_GT(counts.hits, counts.pixels / 4);
  }
}

TEST(Sizes, WallsOfATenThousandth) {
  // A box without a lid and a tube, walls 0.001 thick, 10 wide.
  const std::string open_box =
      "difference() { cube([10, 10, 10]);"
      " translate([0.001, 0.001, 0.001]) cube([9.998, 9.998, 20]); }";
  const Answer box_answer = [](const ExactRay& ray) {
    return seen_of_difference(ray, {box(1, ray, {0, 0, 0}, {10, 10, 10}),
                                    box(2, ray, {0.001, 0.001, 0.001}, {9.999, 9.999, 20.001})});
  };
  const std::string tube =
      "difference() { cylinder(h = 10, r = 5); translate([0, 0, -1]) cylinder(h = 12, r = 4.999);"
      "}";
  const Answer tube_answer = [](const ExactRay& ray) {
    return seen_of_difference(ray, {cylinder(1, ray, 2, {0, 0, 0}, 5, 10),
                                    cylinder(2, ray, 2, {0, 0, -1}, Exact(4.999), 12)});
  };
  // The whole, then a piece of the rim so near that its wall fills a third of the picture.
  expect_known(open_box, look({25, -31, 22}, {5, 5, 5}, 30), box_answer);
  expect_known(open_box, look_parallel({5, 0.0005, 40}, {5, 0.0005, 0}, 0.003), box_answer);
  expect_known(open_box, look({5.003, -0.001, 10.004}, {5, 0.0005, 10}, 30), box_answer);
  expect_known(tube, look({25, -31, 22}, {0, 0, 5}, 30), tube_answer);
  expect_known(tube, look_parallel({4.9995, 0, 40}, {4.9995, 0, 0}, 0.003), tube_answer);
  const PictureCounts counts =
      expect_known(tube, look({5.001, 0.003, 10.004}, {4.9995, 0, 10}, 30), tube_answer);
  EXPECT_GT(counts.hits, counts.pixels / 4);
  EXPECT_LE(counts.undecided, 2);
}

}  // namespace
}  // namespace whittle
