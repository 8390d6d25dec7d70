#include "trace/vulkan/leaf_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "lower/lower.h"
#include "subdivide/subdivide.h"
#include "support/read_text.h"

namespace whittle {
namespace {

/// All cases of the leaves of a model.
std::set<LeafCase> cases_of(const std::string& text, uint32_t leaf_size) {
  const Model model = model_of(text);
  const Scene scene = *lower(model);
  SubdivideSettings settings;
  settings.leaf_size = leaf_size;
  const CellTree tree = subdivide(scene, settings);
  std::set<LeafCase> cases;
  std::vector<const Cell*> open{tree.root};
  while (!open.empty()) {
    const CellLink link = open.back()->link();
    open.pop_back();
    if (link.kind() == CellKind::kNode)
      open.insert(open.end(), {link.children(), link.children() + 1});
    else if (is_leaf(link.kind()))
      cases.insert(leaf_case(scene, link.kind(), link.leaf()));
  }
  return cases;
}

bool has(const std::set<LeafCase>& cases, FormulaCase formula, SurfaceCase surfaces) {
  return std::ranges::any_of(cases, [&](LeafCase leaf) {
    return formula_case(leaf) == formula && surface_case(leaf) == surfaces;
  });
}

const std::string kA = "sphere(5); ", kB = "translate([3, 0, 0]) sphere(5); ",
                  kC = "translate([0, 3, 0]) sphere(5); ";

TEST(LeafCase, OneLiteral) {
  EXPECT_EQ(cases_of(kA, 6).size(), 1u);
  EXPECT_TRUE(has(cases_of(kA, 6), FormulaCase::kOneLiteral, SurfaceCase::kPlanesAndSpheres));
  EXPECT_TRUE(has(cases_of("cube(1);", 1), FormulaCase::kOneLiteral, SurfaceCase::kPlanes));
  EXPECT_TRUE(has(cases_of("cylinder(h = 9, r = 5, $fn = 0);", 1), FormulaCase::kOneLiteral,
                  SurfaceCase::kAnySurfaces));
}

TEST(LeafCase, ThePapersFourCasesOfTwo) {
  constexpr SurfaceCase kSpheres = SurfaceCase::kPlanesAndSpheres;
  const std::string without_a = "difference() { cube(50, center = true); " + kA;
  EXPECT_TRUE(
      has(cases_of("intersection() {" + kA + kB + "}", 2), FormulaCase::kIntersection, kSpheres));
  EXPECT_TRUE(
      has(cases_of("difference() {" + kA + kB + "}", 2), FormulaCase::kDifference, kSpheres));
  EXPECT_TRUE(has(cases_of("intersection() {" + without_a + "}" + kB + "}", 2),
                  FormulaCase::kBackDifference, kSpheres));
  EXPECT_TRUE(has(cases_of(without_a + kB + "}", 2), FormulaCase::kOutside, kSpheres));
}

TEST(LeafCase, LongerFormulas) {
  constexpr SurfaceCase kSpheres = SurfaceCase::kPlanesAndSpheres;
  EXPECT_TRUE(has(cases_of("intersection() {" + kA + kB + kC + "}", 6), FormulaCase::kConjunctions,
                  kSpheres));
  EXPECT_TRUE(has(cases_of(kA + kB + kC, 6), FormulaCase::kDisjunctions, kSpheres));
  const std::string either = "difference() {" + kA + kB + "} difference() {" + kB + kA + "}";
  EXPECT_TRUE(has(cases_of(either, 6), FormulaCase::kTables, kSpheres));
  std::string many;
  for (int i = 0; i < 4; ++i) {
    const std::string x = std::to_string(i);
    many += "difference() { translate([" + x + ", 0, 0]) sphere(5); translate([" + x +
            ", 4, 0]) sphere(4); }";
  }
  EXPECT_TRUE(has(cases_of(many, 16), FormulaCase::kPrograms, kSpheres));
}

TEST(LeafCase, SmallSpheresAreSpheres) {
  for (const LeafCase leaf : cases_of("cube(100); translate([50, 50, 100]) sphere(0.5);", 6))
    EXPECT_NE(surface_case(leaf), SurfaceCase::kAnySurfaces);
}

}  // namespace
}  // namespace whittle
