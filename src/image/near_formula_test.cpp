#include "image/near_formula.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "lower/evaluate.h"
#include "lower/lower.h"
#include "support/read_text.h"

namespace whittle {
namespace {

/// A row of a thousand plates with a hole each, so that groups have rows of rows of operands.
std::string plates() {
  std::string text = "difference(){ union(){";
  for (int i = 0; i < 1000; ++i)
    text += "multmatrix([[1,0,0," + std::to_string(3 * i) +
            "],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) difference(){ cube(2); cube([1,1,3]); }";
  return text + "} cube([3000,0.5,0.5]); }";
}

/// Half of them near some of it, so that units are asked, half anywhere.
std::vector<Vec3> points(const Scene& scene) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<Vec3> found;
  for (int i = 0; i < 2000; ++i) {
    const Box box = i % 2 == 0
                        ? scene.region
                        : scene.units[size_t(share(random) * double(scene.units.size()))].outer;
    const Vec3 size = box.size();
    found.push_back(box.lo +
                    Vec3{size.x * share(random), size.y * share(random), size.z * share(random)});
  }
  return found;
}

bool is_in(const Scene& scene, uint32_t unit, Vec3 p) {
  const Unit& u = scene.units[unit];
  for (uint32_t f = u.first_face; f < u.first_face + u.face_count; ++f)
    if (!contains(scene, scene.faces[f].literal, p)) return false;
  return true;
}

TEST(NearFormula, IsWhatTheWholeFormulaIs) {
  for (const std::string& text :
       {plates(), std::string("cube(1);"),
        std::string("intersection(){ cube(4); difference(){ sphere(3); union(){ cube(2);"
                    " cylinder(h=9,r=1); } } union(){ cube(3); sphere(1); } }"),
        std::string("difference(){ cube(9); difference(){ cube(5); intersection(){ cube(4);"
                    " sphere(4); } } difference(){ sphere(8); cube(8); } }")}) {
    const Scene scene = *lower(model_of(text));
    const NearFormula formula(scene);
    size_t inside = 0;
    for (const Vec3 p : points(scene)) {
      const bool whole = contains(scene, scene.formula, p);
      inside += whole;
      EXPECT_EQ(formula.value_at(p, 0, [&](uint32_t unit) { return is_in(scene, unit, p); }), whole)
          << text.substr(0, 80) << " at " << p.x << ", " << p.y << ", " << p.z;
    }
    EXPECT_GT(inside, 0u);
  }
}

TEST(NearFormula, UnitsAreAskedWithinTheMarginAlone) {
  const Scene scene = *lower(model_of(plates()));
  const NearFormula formula(scene);
  const auto asked = [&](Vec3 p, double margin) {
    size_t count = 0;
    formula.value_at(p - scene.origin, margin, [&](uint32_t) { return ++count, false; });
    return count;
  };
  // Plate 100 and its hole, and what is taken from all.
  EXPECT_EQ(asked({300.5, 0.4, 0.4}, 0), 3u);
  EXPECT_EQ(asked({302.5, 1, 1}, 0), 0u);
  // It and the next with its hole, and what is taken from all.
  EXPECT_EQ(asked({302.5, 1, 1}, 0.6), 4u);
}

TEST(NearFormula, OfAnEmptySolidIsFalse) {
  const Scene scene = *lower(model_of("difference(){ cube(0); cube(1); }"));
  EXPECT_FALSE(NearFormula(scene).value_at({0, 0, 0}, 1, [](uint32_t) { return true; }));
}

}  // namespace
}  // namespace whittle
