#include "lower/along_kind.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lower/lower.h"
#include "support/read_text.h"

namespace whittle {
namespace {

/// Of the curved half-spaces of a solid beside a cube that is 100 long.
std::vector<AlongKind> kinds_of(const std::string& solid) {
  const Scene scene = *lower(model_of("cube(100); " + solid));
  std::vector<AlongKind> kinds;
  for (const HalfSpace& h : scene.half_spaces)
    if (!h.is_plane()) kinds.push_back(along_kind(h, 100));
  return kinds;
}

TEST(AlongKind, SmallIsAShareOfTheRegion) {
  using Kinds = std::vector<AlongKind>;
  EXPECT_EQ(kinds_of("translate([50, 50, 50]) sphere(1.6);"), Kinds{AlongKind::kSphere});
  EXPECT_EQ(kinds_of("translate([50, 50, 50]) sphere(1.5);"), Kinds{AlongKind::kSmallSphere});
  const std::string place = "translate([50, 50, 50]) rotate([0, 30, 0]) ";
  EXPECT_EQ(kinds_of(place + "cylinder(h = 9, r = 1.6, $fn = 0);"), Kinds{AlongKind::kQuadric});
  EXPECT_EQ(kinds_of(place + "cylinder(h = 9, r = 1.5, $fn = 0);"),
            Kinds{AlongKind::kSmallQuadric});
}

TEST(AlongKind, AxesAndTips) {
  using Kinds = std::vector<AlongKind>;
  EXPECT_EQ(kinds_of("translate([50, 50, 50]) cylinder(h = 9, r = 5, $fn = 0);"),
            Kinds{AlongKind::kDiagonal});
  EXPECT_EQ(kinds_of("translate([50, 50, 50]) cylinder(h = 9, r1 = 5, r2 = 0, $fn = 0);"),
            Kinds{AlongKind::kCone});
}

}  // namespace
}  // namespace whittle
