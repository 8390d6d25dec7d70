#include "subdivide/simplify.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "lower/evaluate.h"
#include "lower/lower.h"
#include "subdivide/leaf.h"
#include "subdivide/points_for_test.h"
#include "support/random_tree.h"
#include "support/read_text.h"

namespace whittle {
namespace {

Scene lowered_text(const std::string& text) {
  return *lower(model_of(text));
}

TEST(Classify, InsideAndOutsideAreNeverWrong) {
  Points points(3);
  for (uint64_t seed = 0; seed < 100; ++seed) {
    const Scene scene = lowered_text(random_tree(seed));
    for (const HalfSpace& h : scene.half_spaces) {
      const Box box = points.box_in(scene.region);
      const Side side = classify(h, CellBox(box, 0));
      if (side == Side::kCrosses) continue;
      for (int i = 0; i < 20; ++i)
        ASSERT_EQ(contains(h, points.in(box)), side == Side::kInside) << seed;
    }
  }
}

TEST(Classify, BoundsOfAPrimitiveAreNeverWrong) {
  Points points(4);
  const Scene scene = lowered_text("rotate([10,20,30]) sphere(10, $fn = 24);");
  ASSERT_GT(scene.units[0].inner_radius, 5);
  int proofs = 0;
  for (int i = 0; i < 20000; ++i) {
    const Box box = points.box_in(scene.region);
    const Side side = classify_bounds(scene.units[0], CellBox(box, 0));
    if (side == Side::kCrosses) continue;
    ++proofs;
    for (int j = 0; j < 8; ++j)
      ASSERT_EQ(contains(scene, scene.formula, points.in(box)), side == Side::kInside);
  }
  EXPECT_GT(proofs, 100);
}

TEST(Classify, ObliqueWallsAreToldWhereTheyAre) {
  // Boxes that a wall misses by a hundredth of their size, however it lies in space.
  const std::string turned = "rotate([31, 17, 53]) ";
  struct Wall {
    const char* text;
    double radius;  ///< at the place that is looked at, the middle
    double steep;   ///< by how much it grows along the axis
  };
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> angle(0, 360);
  for (const Wall& wall : {Wall{"cylinder(r = 4, h = 20, center = true);", 4, 0},
                           Wall{"cylinder(r1 = 6, r2 = 2, h = 20, center = true);", 4, -0.2}}) {
    const Scene scene = lowered_text(turned + wall.text);
    const HalfSpace& h = scene.half_spaces[scene.faces[0].literal >> 1];
    const Scene axis = lowered_text(turned + "halfspace(n = [0, 0, 1], d = 0);");
    const Vec3 along = normalize(axis.half_spaces[0].f.b);
    for (int i = 0; i < 100; ++i) {
      Vec3 across = cross(along, normalize(Vec3{std::cos(angle(random)), std::sin(angle(random)),
                                                std::cos(2 * angle(random))}));
      across = normalize(across);
      const Vec3 normal = normalize(across - along * wall.steep);
      const double half = 0.5,
                   depth = half * (std::fabs(normal.x) + std::fabs(normal.y) + std::fabs(normal.z));
      const Vec3 foot = across * wall.radius;
      const auto box_at = [&](double distance) {
        const Vec3 center = foot + normal * distance - scene.origin;
        return Box{center - Vec3{half, half, half}, center + Vec3{half, half, half}};
      };
      EXPECT_EQ(classify(h, CellBox(box_at(depth + 0.01), 0)), Side::kOutside);
      EXPECT_EQ(classify(h, CellBox(box_at(depth - 0.01), 0)), Side::kCrosses);
      // The wall is curved, so a box inside is farther from it than the tangent is.
      EXPECT_EQ(classify(h, CellBox(box_at(-depth - 0.25), 0)), Side::kInside);
      EXPECT_EQ(classify(h, CellBox(box_at(-depth + 0.01), 0)), Side::kCrosses);
    }
  }
}

TEST(UnitBoxes, TellOnlyWhatIsSo) {
  Points points(10);
  size_t beside = 0, within = 0, balls = 0;
  for (uint64_t seed = 0; seed < 2000; ++seed) {
    const Scene scene = lowered_text(random_tree(seed % 100, {.halfspaces = seed % 4 == 0}));
    const UnitBoxes boxes(scene);
    for (size_t i = 0; i < scene.formula.size(); i += UnitBoxes::kBatch) {
      const std::span<const Token> tokens =
          std::span<const Token>(scene.formula)
              .subspan(i, std::min<size_t>(UnitBoxes::kBatch, scene.formula.size() - i));
      Box box;
      box.include(points.in(scene.region));
      box.include(box.lo + scene.region.size() * 0.05);
      const UnitBoxes::Batch batch = boxes.look_at(tokens, CellBox(box, 0));
      for (size_t k = 0; k < tokens.size(); ++k) {
        EXPECT_EQ(batch.negated >> k & 1, uint32_t(tokens[k].negated()));
        const bool is_beside = batch.beside >> k & 1, is_within = batch.within >> k & 1;
        beside += is_beside, within += is_within, balls += batch.balls >> k & 1;
        ASSERT_FALSE(tokens[k].is_group() && (is_beside || is_within));
        if (!is_beside && !is_within) continue;
        for (int j = 0; j < 10; ++j)
          ASSERT_EQ(contains(scene, tokens.subspan(k, 1), points.in(box)),
                    is_within != tokens[k].negated());
      }
    }
  }
  EXPECT_GT(beside, 300u);
  EXPECT_GT(within, 10u);
  EXPECT_GT(balls, 100u);
}

TEST(UnitBoxes, AreTheSameMadeByManyThreads) {
  std::string balls;
  for (int i = 0; i < 10000; ++i)
    balls += "translate([" + std::to_string(i % 100) + "," + std::to_string(i / 100) +
             ",0]) sphere(" + std::to_string(0.1 + i % 7 * 0.1) + ");";
  const Scene scene = lowered_text("union(){" + balls + "}");
  const Workers workers(4);
  const UnitBoxes alone(scene), together(scene, &workers);
  EXPECT_EQ(alone.are_worth_it(1), together.are_worth_it(1));
  const CellBox cell(Box{{-20, -20, -1}, {10, 10, 1}}, 0);
  size_t beside = 0;
  for (size_t i = 0; i < scene.formula.size(); i += UnitBoxes::kBatch) {
    const std::span<const Token> tokens =
        std::span<const Token>(scene.formula)
            .subspan(i, std::min<size_t>(UnitBoxes::kBatch, scene.formula.size() - i));
    const UnitBoxes::Batch one = alone.look_at(tokens, cell),
                           other = together.look_at(tokens, cell);
    EXPECT_EQ(one.beside, other.beside);
    EXPECT_EQ(one.within, other.within);
    EXPECT_EQ(one.balls, other.balls);
    beside += size_t(std::popcount(one.beside));
  }
  EXPECT_GT(beside, 1000u);
  EXPECT_LT(beside, 9900u);
}

bool value_of(Truth truth, const Scene& scene, const Formula& formula, Vec3 p) {
  return truth == Truth::kVaries ? contains(scene, formula, p) : truth == Truth::kTrue;
}

TEST(Simplify, KeepsTheValueInsideTheCell) {
  Points points(5);
  int shorter = 0, constant = 0;
  for (uint64_t seed = 0; seed < 300; ++seed) {
    const Scene scene = lowered_text(random_tree(seed));
    if (scene.region.is_empty()) continue;
    const UnitBoxes boxes(scene);
    Simplifier simplifier(scene, boxes, 0);
    Formula outer, inner;
    const Box box = points.box_in(scene.region);
    const Truth truth =
        simplifier.simplify(scene.formula, box, seed % 2 ? Expand::kUnits : Expand::kLarge, outer);
    shorter += outer.size() < scene.formula.size();
    constant += truth != Truth::kVaries;
    for (int i = 0; i < 20; ++i) {
      const Vec3 p = points.in(box);
      const bool whole = contains(scene, scene.formula, p);
      ASSERT_EQ(value_of(truth, scene, outer, p), whole) << seed;
    }
    if (truth != Truth::kVaries) continue;
    // From the parent's formula as from the whole one.
    const Box child = points.box_in(box);
    const Truth child_truth = simplifier.simplify(outer, child, Expand::kUnits, inner);
    for (int i = 0; i < 20; ++i) {
      const Vec3 p = points.in(child);
      const bool whole = contains(scene, scene.formula, p);
      ASSERT_EQ(value_of(child_truth, scene, inner, p), whole) << seed;
    }
  }
  EXPECT_GT(shorter, 100);
  EXPECT_GT(constant, 10);
}

/// The formula with its pass headers left out: they mean nothing by themselves.
Formula bare(const Formula& formula) {
  Formula result;
  for (const Token token : flat_tokens(formula))
    result.push_back(token.is_group() ? Token::make(token.kind(), 0) : token);
  return result;
}

TEST(Simplify, TwiceIsOnce) {
  Points points(6);
  for (uint64_t seed = 0; seed < 300; ++seed) {
    const Scene scene = lowered_text(random_tree(seed));
    if (scene.region.is_empty()) continue;
    const UnitBoxes boxes(scene);
    Simplifier simplifier(scene, boxes, 0);
    Formula once, twice, thrice;
    const Box box = points.box_in(scene.region);
    if (simplifier.simplify(scene.formula, box, Expand::kUnits, once) != Truth::kVaries) continue;
    ASSERT_EQ(simplifier.simplify(once, box, Expand::kUnits, twice), Truth::kVaries);
    EXPECT_EQ(bare(once).size(), bare(twice).size()) << seed;
    ASSERT_EQ(simplifier.simplify(twice, box, Expand::kUnits, thrice), Truth::kVaries);
    EXPECT_EQ(twice, thrice) << seed;
  }
}

TEST(Simplify, AGroupLeftWithOneOperandJoinsTheGroupAround) {
  // Or(a, And(b, Or(c, d))) where b is everywhere and c nowhere in the cell: Or(a, d).
  const Scene scene = lowered_text(
      "union(){ sphere(1); intersection(){ cube(100, center = true);"
      " union(){ translate([50,0,0]) sphere(1); translate([1,0,0]) sphere(1); } } }");
  const UnitBoxes boxes(scene);
  Simplifier simplifier(scene, boxes, 0);
  Formula out;
  const Box cell{Vec3{0.4, -0.5, -1} - scene.origin, Vec3{0.6, 0.5, 1} - scene.origin};
  ASSERT_EQ(simplifier.simplify(scene.formula, cell, Expand::kUnits, out), Truth::kVaries);
  LeafAnalysis leaf(scene);
  leaf.analyse(out);
  EXPECT_EQ(leaf.size(), 2u);
  Arena arena;
  EXPECT_EQ(leaf.write(arena).kind(), CellKind::kDisjunction);
}

TEST(Simplify, FacetsOfTurnedBodiesAreTheWholeBodyInTheCell) {
  // Long facets aslant, tips, stretched facets; and planes that were moved onto earlier ones.
  for (const char* const text : {
           "rotate([20,30,0]) cylinder(r = 1, h = 5, $fn = 512);",
           "rotate([70,10,5]) cylinder(r1 = 2, r2 = 0, h = 5, $fn = 200);",
           "multmatrix([[5,1,0,3],[0,1,1,0],[0,0,0.2,1],[0,0,0,1]]) sphere(2, $fn = 60);",
           "rotate([20,30,0]) { cylinder(r = 1, h = 5, $fn = 64);"
           "  translate([1e-6,0,0]) cylinder(r = 1, h = 4.999999, $fn = 64); }",
       }) {
    Points points(12);
    const Scene scene = lowered_text(text);
    const UnitBoxes boxes(scene);
    Simplifier simplifier(scene, boxes, 1e-10);
    Formula out;
    int decided = 0;
    for (int i = 0; i < 4000; ++i) {
      const Vec3 at = points.in(scene.region);
      const double half = 0.002 * (1 << i % 8);
      const Box cell{at - Vec3{half, half, half}, at + Vec3{half, half, half}};
      const Truth truth = simplifier.simplify(scene.formula, cell, Expand::kUnits, out);
      decided += truth != Truth::kVaries;
      for (int j = 0; j < 10; ++j) {
        const Vec3 p = points.in(cell);
        const bool simplified =
            truth == Truth::kVaries ? contains(scene, out, p) : truth == Truth::kTrue;
        ASSERT_EQ(simplified, contains(scene, scene.formula, p)) << text;
      }
    }
    EXPECT_GT(decided, 2000) << text;
  }
}

TEST(Simplify, LongFacetsAslantAreDroppedWhereTheyAreNot) {
  const Scene scene = lowered_text("rotate([20,30,0]) cylinder(r = 1, h = 5, $fn = 2048);");
  const UnitBoxes boxes(scene);
  Simplifier simplifier(scene, boxes, 1e-10);
  Points points(13);
  Formula out;
  size_t most = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 at = points.in(scene.region), half{0.01, 0.01, 0.01};
    simplifier.simplify(scene.formula, {at - half, at + half}, Expand::kUnits, out);
    most = std::max(most, out.size());
  }
  // Twelve facets are as wide as the cell's diagonal; the planes of two hundred cross it.
  EXPECT_GT(most, 5u);
  EXPECT_LT(most, 40u);
}

TEST(Simplify, FacetsThatDoNotReachTheCellAreDropped) {
  // The planes of a finely facetted sphere all cross any cell at its surface of some size.
  Points points(8);
  const Scene scene = lowered_text("rotate([10,20,30]) scale([1,1.5,0.7]) sphere(10, $fn = 60);");
  const UnitBoxes boxes(scene);
  Simplifier simplifier(scene, boxes, 0);
  Formula outer, inner;
  size_t kept = 0, cells = 0;
  for (int i = 0; i < 3000; ++i) {
    Box box;
    box.include(points.in(scene.region));
    box.include(box.lo + scene.region.size() * 0.15);
    if (simplifier.simplify(scene.formula, box, Expand::kUnits, outer) != Truth::kVaries) continue;
    Box child = points.box_in(box);
    const Truth truth = simplifier.simplify(outer, child, Expand::kUnits, inner);
    for (int j = 0; j < 20; ++j) {
      const Vec3 p = points.in(box), q = points.in(child);
      ASSERT_EQ(contains(scene, outer, p), contains(scene, scene.formula, p));
      ASSERT_EQ(value_of(truth, scene, inner, q), contains(scene, scene.formula, q));
    }
    kept += expanded_size(scene, outer);
    ++cells;
  }
  ASSERT_GT(cells, 300u);
  EXPECT_LT(double(kept) / double(cells), 60) << "of " << scene.faces.size();
}

}  // namespace
}  // namespace whittle
