#include "boundary/closed_mesh.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/read_text.h"

namespace whittle {
namespace {

TEST(ClosedMesh, HasTheSolidsFacesAsFacets) {
  const Workers workers(2);
  const Result<TriangleMesh> mesh = closed_mesh(
      facetted_model_of("difference() { cube(10); multmatrix([[1,0,0,2],[0,1,0,2],[0,0,1,5],"
                        "[0,0,0,1]]) cube([3, 4, 9]); }"),
      workers);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->points.size(), 16u);
  EXPECT_EQ(mesh->facets.size(), 11u);
  EXPECT_NEAR(volume(*mesh), 1000 - 3 * 4 * 5, 1e-9);
  EXPECT_LE(mesh->rise, 1e-14);
  for (const TriangleMesh::Triangle& t : mesh->triangles)
    for (const uint32_t corner : t.corners)
      EXPECT_NEAR(dot(mesh->facets[t.facet].n, mesh->points[corner]), mesh->facets[t.facet].d,
                  1e-14);
}

TEST(ClosedMesh, OfNothingHasNoTriangles) {
  const Workers workers(1);
  const Result<TriangleMesh> mesh =
      closed_mesh(facetted_model_of("difference() { cube(1); cube(2); }"), workers);
  ASSERT_TRUE(mesh);
  EXPECT_TRUE(mesh->triangles.empty());
}

TEST(ClosedMesh, HasLimits) {
  const Workers workers(2);
  const Model model = facetted_model_of("difference() { sphere(5, $fn = 30); cube(9); }");
  EXPECT_TRUE(closed_mesh(model, workers));
  EXPECT_FALSE(closed_mesh(model, workers, {.pairs = 100}));
  EXPECT_FALSE(closed_mesh(model, workers, {.pieces = 100}));
}

}  // namespace
}  // namespace whittle
