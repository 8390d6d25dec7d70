// The grid's answers (grid.h) are checked against what the Menger sponge is by definition; then cpu
// and oracle against the grid's answers, on random trees of boxes, where everything coincides.
#include <gtest/gtest.h>

#include <random>

#include <fmt/format.h>

#include "coincident/answer.h"
#include "coincident/grid.h"
#include "support/read_text.h"
#include "trace/oracle/oracle.h"

namespace whittle {
namespace {

/// Is this point in the solid? Rays from inside leave it along its outward normal.
bool is_solid_at(const RayFormula& formula, Vec3 p) {
  const Vec3 d = normalize(Vec3{0.61, 0.53, 0.59});
  const Hit hit = *formula({p, d});
  return hit.hit() && double(hit.normal.x + hit.normal.y + hit.normal.z) > 0;
}

TEST(Grid, SpongeIsGoneWhereTwoCoordinatesHaveA1AsTheSameDigitInBase3) {
  int sponges = 0;
  for (const CoincidentScene& scene : menger_scenes()) {
    if (!scene.name.starts_with("sponge")) continue;
    SCOPED_TRACE(scene.name);
    ++sponges;
    const int level = scene.name.back() - '0', side = level == 1 ? 3 : level == 2 ? 9 : 27;
    const int cell = sponge_cell(level);
    int wrong = 0;
    for (int z = 0; z < side; ++z)
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
          bool gone = false;
          for (int digit = 1; digit < side; digit *= 3)
            gone |= (x / digit % 3 == 1) + (y / digit % 3 == 1) + (z / digit % 3 == 1) >= 2;
          wrong +=
              is_solid_at(scene.formula, Vec3{x + 0.5, y + 0.5, z + 0.5} * double(cell)) == gone;
        }
    EXPECT_EQ(wrong, 0);
  }
  EXPECT_EQ(sponges, 5);
}

TEST(Grid, OwnersFollowTheTieRule) {
  const auto owner = [](const char* text, Vec3 eye, Vec3 direction) {
    return (*grid_formula(text)({eye, normalize(direction)})).id;
  };
  const Vec3 down{1e-3, 1e-3, -1};
  // A pocket flush with the top: its floor is the cutter's, the top beside it the cube's.
  const char* const pocket = "difference() { cube(10); translate([2, 2, 5]) cube([6, 6, 5]); }";
  EXPECT_EQ(owner(pocket, {5, 5, 20}, down), 2u);
  EXPECT_EQ(owner(pocket, {1, 1, 20}, down), 1u);
  // Of two faces on one another the earlier is seen; of two cutters the earlier owns the cut.
  EXPECT_EQ(owner("cube(4); cube(4);", {1, 1, 9}, down), 1u);
  EXPECT_EQ(owner("difference() { cube(9); translate([1, 1, 4]) cube(9); translate([2, 2, 4]) "
                  "cube(9); }",
                  {5, 5, 20}, down),
            2u);
  EXPECT_EQ(owner("difference() { cube(4); cube(4); }", {1, 1, 9}, down), 0u);
}

/// A tree of about `budget` boxes with corners on whole numbers from 0 to 6.
std::string random_boxes(std::mt19937_64& random, int budget) {
  const auto below = [&](uint64_t n) { return int(random() % n); };
  if (budget <= 1) {
    int low[3], size[3];
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = below(6);
      size[axis] = 1 + below(uint64_t(6 - low[axis]));
    }
    return fmt::format("translate([{}, {}, {}]) cube([{}, {}, {}]);\n", low[0], low[1], low[2],
                       size[0], size[1], size[2]);
  }
  static constexpr const char* kOperators[] = {"union", "difference", "difference", "intersection"};
  const int operands = 2 + below(3);
  std::string text = std::string(kOperators[below(4)]) + "() {\n";
  for (int i = 0; i < operands; ++i) text += random_boxes(random, budget / operands);
  return text + "}\n";
}

TEST(Grid, RandomTreesOfBoxesAreSeenByCpuAndOracle) {
  int solid = 0;
  for (uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    CoincidentScene scene{.name = "boxes", .text = "", .equal = ""};
    for (int i = 0; i < 2; ++i) scene.text += random_boxes(random, 4 + int(seed % 12));
    scene.formula = grid_formula(scene.text);
    const Model model = model_of(scene.text);
    solid += is_solid_at(scene.formula, {2.5, 2.5, 2.5});
    Answer answer(scene, model, 32);
    answer.expect_seen_by(*make_oracle_tracer(model));
    const CpuSubject cpu(model, leaf_size(2 + uint32_t(seed % 5)));
    answer.expect_seen_by(*cpu.tracer);
  }
  EXPECT_GT(solid, 40) << "few trees should be empty";
  EXPECT_LT(solid, 260) << "or full";
}

}  // namespace
}  // namespace whittle
