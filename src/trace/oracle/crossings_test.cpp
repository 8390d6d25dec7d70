#include "trace/oracle/crossings.h"

#include <gtest/gtest.h>

namespace whittle {
namespace {

constexpr Vec3 kX{1, 0, 0};

/// Bounds whose tolerance is 2e-5.
const Bounds kBounds = {.box = {{0, 0, 0}, {10, 10, 5}}};

std::vector<std::vector<uint32_t>> groups(std::vector<Crossing> crossings, Vec3 direction) {
  std::vector<size_t> ends;
  group_crossings(crossings, direction, Coincidence(kBounds), ends);
  std::vector<std::vector<uint32_t>> result;
  size_t begin = 0;
  for (const size_t end : ends) {
    result.emplace_back();
    for (; begin < end; ++begin) result.back().push_back(crossings[begin].leaf);
  }
  return result;
}

using Groups = std::vector<std::vector<uint32_t>>;

TEST(GroupCrossings, SortsWhatIsApart) {
  EXPECT_EQ(groups({{3, 0, true, kX}, {1, 1, true, kX}, {2, 2, true, kX}}, kX),
            (Groups{{1}, {2}, {0}}));
}

TEST(GroupCrossings, SameSurfaceWithinTheTolerance) {
  EXPECT_EQ(groups({{1, 0, true, kX}, {1.000019, 1, true, -kX}}, kX), (Groups{{0, 1}}));
  EXPECT_EQ(groups({{1, 0, true, kX}, {1.000021, 1, true, kX}}, kX), (Groups{{0}, {1}}));
}

TEST(GroupCrossings, DoNotChain) {
  EXPECT_EQ(groups({{1, 0, true, kX}, {1.000015, 1, true, kX}, {1.00003, 2, true, kX}}, kX),
            (Groups{{0, 1}, {2}}));
  const Vec3 turned = normalize(Vec3{1, 3e-6, 0}), twice = normalize(Vec3{1, 6e-6, 0});
  EXPECT_EQ(groups({{1, 0, true, kX}, {1.000001, 1, true, turned}, {1.000002, 2, true, twice}}, kX),
            (Groups{{0, 1}, {2}}));
}

TEST(GroupCrossings, DistanceIsAcrossTheSurface) {
  // A grazing ray crosses two planes 1e-5 apart at places 1e-3 apart.
  const Vec3 n = normalize(Vec3{0.01, 1, 0});
  EXPECT_EQ(groups({{1, 0, true, n}, {1.001, 1, true, n}}, kX), (Groups{{0, 1}}));
}

TEST(GroupCrossings, SurfacesThatCrossStayApart) {
  // An edge: as near as can be, but not parallel; and the one between does not split the others.
  const Vec3 n = normalize(Vec3{1, 1, 0});
  EXPECT_EQ(groups({{1, 0, true, kX}, {1.000005, 1, true, n}, {1.00001, 2, false, kX}}, kX),
            (Groups{{0, 2}, {1}}));
}

TEST(GroupCrossings, EqualIsEqualWhateverTheDirection) {
  EXPECT_EQ(groups({{1, 5, true, kX}, {1, 3, true, normalize(Vec3{1, 1, 0})}}, kX),
            (Groups{{3, 5}}));
}

TEST(GroupCrossings, NearlyParallelIsOneOnlyOverTheWholeModel) {
  // Planes that part by less than the tolerance over half the model, and by more.
  EXPECT_EQ(groups({{1, 0, true, kX}, {1.000001, 1, true, normalize(Vec3{1, 3.9e-6, 0})}}, kX),
            (Groups{{0, 1}}));
  EXPECT_EQ(groups({{1, 0, true, kX}, {1.000001, 1, true, normalize(Vec3{1, 4.1e-6, 0})}}, kX),
            (Groups{{0}, {1}}));
}

}  // namespace
}  // namespace whittle
