#include "lines/facet_curves.h"

#include <gtest/gtest.h>

#include "support/read_text.h"

namespace whittle {
namespace {

ViewProjection projection_of(double scale) {
  Camera camera;
  camera.orthographic = true;
  return ViewProjection(camera, scale, 10);
}

std::vector<int> facets(const std::string& text, double scale) {
  const ViewProjection projection = projection_of(scale);
  const Result<Model> model = facet_curves(model_of(text), projection, 1'000'000);
  std::vector<int> counts;
  for (const Primitive& primitive : model->primitives) {
    if (const auto* sphere = std::get_if<Sphere>(&primitive.shape))
      counts.push_back(sphere->facets);
    if (const auto* cylinder = std::get_if<Cylinder>(&primitive.shape))
      counts.push_back(cylinder->facets);
  }
  return counts;
}

TEST(FacetCurves, LargerCurvesGetMore) {
  const std::string text =
      "sphere(r = 1); cylinder(h = 1, r1 = 20, r2 = 1); cylinder(h = 1, r1 = 3, r2 = 3, $fn = 7);";
  const std::vector<int> one = facets(text, 1), ten = facets(text, 10);
  EXPECT_LT(one[0], one[1]);
  EXPECT_LT(one[1], ten[1]);
  EXPECT_EQ(one[2], 7);
  // No farther from the curve than it says.
  EXPECT_LT(20 * (1 - std::cos(M_PI / one[1])), 0.025);
  EXPECT_EQ(one[1] % 4, 0);
  // As it stands in the world.
  const std::string grown = "multmatrix([[10,0,0,0],[0,10,0,0],[0,0,10,0],[0,0,0,1]]) " + text;
  EXPECT_EQ(facets(grown, 1)[0], ten[0]);
}

TEST(FacetCurves, PartsOfOneBodyFit) {
  const std::vector<int> counts =
      facets("rotate_extrude() polygon([[0, 0], [10, 0], [12, 5], [2, 9], [0, 9]]);", 1);
  ASSERT_GT(counts.size(), 1u);
  for (const int count : counts) EXPECT_EQ(count, counts[0]);
}

TEST(FacetCurves, ManyGetFewer) {
  const ViewProjection projection = projection_of(1);
  const Model model = model_of("sphere(r = 100);");
  const Result<Model> all = facet_curves(model, projection, 100'000),
                      few = facet_curves(model, projection, 2'000);
  ASSERT_TRUE(all && few);
  EXPECT_LT(facet_count(few->primitives[0].shape), 2'000u);
  EXPECT_GT(facet_count(all->primitives[0].shape), 2'000u);
  EXPECT_FALSE(facet_curves(model, projection, 10));
}

}  // namespace
}  // namespace whittle
