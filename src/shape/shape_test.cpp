#include "shape/shape.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <utility>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "shape/build_planes.h"

namespace whittle {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

/// The largest amount by which a point is outside one of the planes.
double outside(const std::vector<Plane>& planes, Vec3 p) {
  double most = -kInf;
  for (const Plane& plane : planes) most = std::max(most, dot(plane.n, p) - plane.d);
  return most;
}

/// How many of the points lie on the plane.
int64_t on_plane(const Plane& plane, const std::vector<Vec3>& points, double slack) {
  return std::ranges::count_if(
      points, [&](Vec3 p) { return std::fabs(dot(plane.n, p) - plane.d) <= slack; });
}

TEST(FacetPlanes, CubeStandsWhereItShould) {
  const auto corner = facet_planes(Cube{.size = {1, 2, 3}, .center = false});
  EXPECT_EQ(corner.size(), 6u);
  EXPECT_LT(outside(corner, {0.5, 1, 1.5}), 0);
  EXPECT_GT(outside(corner, {-0.1, 1, 1.5}), 0);
  const auto centered = facet_planes(Cube{.size = {1, 2, 3}, .center = true});
  EXPECT_LT(outside(centered, {-0.4, -0.9, -1.4}), 0);
  EXPECT_GT(outside(centered, {0, 0, 1.6}), 0);
}

TEST(FacetPlanes, SphereHasOpenScadsRings) {
  // Four meridians: two rings at 45 and 135 degrees, one band between them.
  const Sphere sphere{.r = 2, .facets = 4};
  const auto planes = facet_planes(sphere);
  const auto points = outline(sphere);
  EXPECT_EQ(planes.size(), 4u + 2u);
  EXPECT_EQ(points.size(), 8u);
  for (const Vec3 p : points) {
    EXPECT_NEAR(std::fabs(p.z), std::sqrt(2.0), 1e-15);
    EXPECT_NEAR(std::hypot(p.x, p.y), std::sqrt(2.0), 1e-15);
  }
  EXPECT_EQ(points[0].y, 0) << "the first vertex is on +x";
}

TEST(FacetPlanes, EvenSphereIsSymmetricToTheLastBit) {
  const auto planes = facet_planes(Sphere{.r = 1, .facets = 28});
  int upright = 0;
  for (const Plane& plane : planes) upright += plane.n.z == 0;
  EXPECT_EQ(upright, 28) << "14 rings: the band about the equator stands upright";
}

TEST(FacetPlanes, ConeHasNoLid) {
  EXPECT_EQ(facet_planes(Cylinder{.h = 1, .r1 = 1, .r2 = 0, .facets = 5}).size(), 6u);
  EXPECT_EQ(outline(Cylinder{.h = 1, .r1 = 1, .r2 = 0, .facets = 5}).size(), 6u);
  EXPECT_EQ(facet_planes(Cylinder{.h = 1, .r1 = 1, .r2 = 2, .facets = 5}).size(), 7u);
}

TEST(FacetPlanes, FourSidedPrismIsTheCubeToTheLastBit) {
  // Rotated by 45 degrees its sides are those of a cube; the normals must be each other's.
  for (const Plane& plane : facet_planes(Cylinder{.h = 2, .r1 = 1, .r2 = 1, .facets = 4}))
    if (plane.n.z == 0) {
      EXPECT_EQ(std::fabs(plane.n.x), std::fabs(plane.n.y));
    }
}

TEST(FacetPlanes, HalfspaceIsNormalised) {
  const auto planes = facet_planes(Halfspace{.n = {0, 0, 1e200}, .d = 2e200});
  ASSERT_EQ(planes.size(), 1u);
  EXPECT_EQ(planes[0].n, (Vec3{0, 0, 1}));
  EXPECT_EQ(planes[0].d, 2);
}

TEST(FacetPlanes, AndVerticesAreTheSameSolid) {
  EXPECT_TRUE(rc::check([] {
    const int n = *rc::gen::inRange(3, 40);
    const double r1 = *rc::gen::inRange(0, 1000) / 100.0, r2 = *rc::gen::inRange(1, 1000) / 100.0,
                 h = *rc::gen::inRange(1, 2000) / 100.0;
    const bool center = *rc::gen::arbitrary<bool>();
    const Shape shape = *rc::gen::element<Shape>(
        Sphere{.r = r2, .facets = n},
        Cylinder{.h = h, .r1 = r1, .r2 = r2, .center = center, .facets = n},
        Cylinder{.h = h, .r1 = r2, .r2 = r1, .center = center, .facets = n},
        Cube{.size = {r2, h, 1}, .center = center});
    const auto planes = facet_planes(shape);
    const auto points = outline(shape);
    for (const Plane& plane : planes) {
      RC_ASSERT(std::fabs(length(plane.n) - 1) < 1e-14);
      RC_ASSERT(on_plane(plane, points, 1e-12) >= 3);
    }
    for (const Vec3 p : points) {
      RC_ASSERT(std::fabs(outside(planes, p)) < 1e-12);
      RC_ASSERT(std::ranges::count_if(planes, [&](const Plane& plane) {
                  return std::fabs(dot(plane.n, p) - plane.d) < 1e-12;
                }) >= 3);
    }
  }));
}

TEST(IsEmpty, SizesThatAreNone) {
  EXPECT_FALSE(is_empty(Cube{}));
  EXPECT_TRUE(is_empty(Cube{.size = {1, 0, 1}}));
  EXPECT_TRUE(is_empty(Cube{.size = {1, 1, kNan}}));
  EXPECT_TRUE(is_empty(Cube{.size = {kInf, 1, 1}}));
  EXPECT_TRUE(is_empty(Sphere{.r = -1}));
  EXPECT_FALSE(is_empty(Cylinder{.h = 1, .r1 = 0, .r2 = 1}));
  EXPECT_TRUE(is_empty(Cylinder{.h = 1, .r1 = 0, .r2 = 0}));
  EXPECT_TRUE(is_empty(Cylinder{.h = 1, .r1 = -1, .r2 = 2}));
  EXPECT_TRUE(is_empty(Cylinder{.h = kInf, .r1 = 1, .r2 = 1}));
  EXPECT_TRUE(is_empty(Polyhedron{}));
  EXPECT_TRUE(is_empty(Halfspace{.n = {0, 0, 0}, .d = 1}));
  EXPECT_TRUE(is_empty(Halfspace{.n = {0, 0, 1}, .d = kInf}));
}

// The planes of a ball that stands where six digits are coarse are off its corners, and each facet
// is where the others leave something of its plane: every way out of the ball ends in a facet.
TEST(Facets, BoxesHoldTheFacetsOfCoarsePolyhedra) {
  for (const double offset : {0.0, 30.0, 800.0, 5000.0}) {
    const Vec3 center = Vec3{1, 0.7, -0.9} * offset;
    constexpr int kMeridians = 24, kRings = kMeridians / 2;
    Polyhedron p;
    for (const Vec3 v : outline(Sphere{.r = 6, .facets = kMeridians})) {
      const Vec3 q = center + Vec3{v.x, v.y * 0.8 - v.z * 0.6, v.y * 0.6 + v.z * 0.8};
      Vec3 printed;
      for (int i = 0; i < 3; ++i) {
        char text[32];
        std::snprintf(text, sizeof text, "%.6g", q[i]);
        printed[i] = std::atof(text);
      }
      p.points.push_back(printed);
    }
    const auto at = [](int ring, int k) { return uint32_t(ring * kMeridians + k % kMeridians); };
    p.faces.resize(2);
    for (int k = 0; k < kMeridians; ++k) {
      p.faces[0].push_back(at(0, kMeridians - k));
      p.faces[1].push_back(at(kRings - 1, k));
      for (int i = 0; i + 1 < kRings; ++i) {
        p.faces.push_back({at(i, k), at(i, k + 1), at(i + 1, k + 1)});
        p.faces.push_back({at(i, k), at(i + 1, k + 1), at(i + 1, k)});
      }
    }
    ASSERT_EQ(build_planes(p).refusal, "") << offset;
    const std::vector<Box> boxes = facet_boxes(p);
    ASSERT_EQ(boxes.size(), p.planes.size());
    constexpr int kWays = 20000;
    for (int i = 0; i < kWays; ++i) {
      const double z = 1 - 2 * (i + 0.5) / kWays, r = std::sqrt(1 - z * z);
      const Vec3 way{r * std::cos(2.4 * i), r * std::sin(2.4 * i), z};
      size_t facet = 0;
      double nearest = kInfinity;
      for (size_t f = 0; f < p.planes.size(); ++f) {
        const double slope = dot(p.planes[f].n, way);
        if (!(slope > 0)) continue;
        const double t = (p.planes[f].d - dot(p.planes[f].n, center)) / slope;
        if (t < nearest) nearest = t, facet = f;
      }
      const Vec3 end = center + way * nearest;
      const Vec3 margin = Vec3{1, 1, 1} * (0.05 * boxes[facet].diagonal());  // as lower() adds it
      const Box box{boxes[facet].lo - margin, boxes[facet].hi + margin};
      ASSERT_TRUE(box.contains(end)) << offset << " way " << i << " facet " << facet;
    }
  }
}

TEST(FacetPlanes, AreAsManyAsCounted) {
  for (const Shape& shape :
       {Shape(Sphere{3, 0}), Shape(Sphere{3, 5}), Shape(Sphere{3, 8}), Shape(Cylinder{4, 2, 1}),
        Shape(Cylinder{4, 2, 1, false, 7}), Shape(Cylinder{4, 2, 0, true, 12}),
        Shape(Cylinder{4, 0, 2, true, 9}), Shape(Cube{}), Shape(Halfspace{})})
    EXPECT_EQ(plane_count(shape), facet_planes(shape).size());
}

TEST(Facets, BoxesHoldTheFacets) {
  for (const Shape& shape :
       {Shape(Sphere{3, 5}), Shape(Sphere{3, 8}), Shape(Sphere{2, 31}),
        Shape(Cylinder{4, 2, 1, false, 7}), Shape(Cylinder{4, 2, 0, true, 12}),
        Shape(Cylinder{4, 0, 2, true, 9}), Shape(Cylinder{4, 2, 1, false, 2500}), Shape(Cube{})}) {
    const std::vector<Plane> planes = facet_planes(shape);
    const std::vector<Vec3> vertices = outline(shape);
    const std::vector<Box> boxes = facet_boxes(shape);
    ASSERT_EQ(boxes.size(), planes.size());
    for (size_t f = 0; f < planes.size(); ++f) {
      int corners = 0;
      Box just;
      for (const Vec3 v : vertices) {
        if (std::fabs(planes[f].d - dot(planes[f].n, v)) > 1e-9) continue;
        ++corners;
        just.include(v);
        EXPECT_TRUE(boxes[f].contains(v));
      }
      EXPECT_GE(corners, 3);
      EXPECT_LT(boxes[f].diagonal(), 1.1 * just.diagonal());
    }
  }
}

/// Three edges of length 2 along the axes.
TriangleMesh corner_mesh() {
  const double s = 1 / std::sqrt(3.0);
  return {.points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}},
          .triangles = {{{0, 2, 1}, 0}, {{0, 1, 3}, 1}, {{0, 3, 2}, 2}, {{1, 2, 3}, 3}},
          .facets = {{{0, 0, -1}, 0}, {{0, -1, 0}, 0}, {{-1, 0, 0}, 0}, {{s, s, s}, 2 * s}}};
}

TEST(Facets, BoxesOfAMeshAreThoseOfItsTriangles) {
  const Mesh mesh{std::make_shared<const TriangleMesh>(corner_mesh())};
  const std::vector<Box> boxes = facet_boxes(mesh);
  ASSERT_EQ(boxes.size(), 4u);
  EXPECT_EQ(boxes[0], (Box{{0, 0, 0}, {2, 2, 0}}));
  EXPECT_EQ(boxes[1], (Box{{0, 0, 0}, {2, 0, 2}}));
  EXPECT_EQ(boxes[2], (Box{{0, 0, 0}, {0, 2, 2}}));
  EXPECT_EQ(boxes[3], (Box{{0, 0, 0}, {2, 2, 2}}));
}

TEST(Volume, CountsWithTheTurnOfTheTriangles) {
  TriangleMesh mesh = corner_mesh();
  for (Vec3& p : mesh.points) p += Vec3{5, -7, 9};
  EXPECT_DOUBLE_EQ(volume(mesh), 4.0 / 3);
  for (TriangleMesh::Triangle& t : mesh.triangles) std::swap(t.corners[0], t.corners[1]);
  EXPECT_DOUBLE_EQ(volume(mesh), -4.0 / 3);
  EXPECT_EQ(volume({}), 0);
}

TEST(FiniteBox, HoldsWhatIsBounded) {
  const Affine map{.row = {{1, 0.2, 0}, {0, 2, 0.3}, {0.1, 0, 0.5}}, .translation = {1, 2, 3}};
  const Shape shapes[] = {Cube{{1, 2, 3}, true},
                          Sphere{3, 0},
                          Sphere{3, 5},
                          Cylinder{4, 2, 1, true, 0},
                          Cylinder{4, 0, 2, false, 7},
                          Mesh{std::make_shared<const TriangleMesh>(corner_mesh())}};
  for (const Shape& shape : shapes) {
    const Box outer = finite_box(shape, map), box = shape_box(shape, map);
    EXPECT_EQ(unite(outer, box), outer) << kShapeNames[shape.index()];
    EXPECT_LT(outer.diagonal(), 3 * box.diagonal()) << kShapeNames[shape.index()];
  }
}

TEST(FiniteBox, OfAHalfSpaceIsThePointNextToTheOrigin) {
  const Box box = finite_box(Halfspace{.n = {3, 0, 4}, .d = 10}, scaling({2, 2, 2}));
  EXPECT_EQ(box.lo, box.hi);
  EXPECT_NEAR(length(box.lo - Vec3{2.4, 0, 3.2}), 0, 1e-15);
}

TEST(Wall, IsZeroOnTheOutlineAndNegativeInside) {
  const Shape shapes[] = {Sphere{.r = 3}, Cylinder{.h = 4, .r1 = 2, .r2 = 2, .center = true},
                          Cylinder{.h = 4, .r1 = 2, .r2 = 0.5}, Cylinder{.h = 4, .r1 = 0, .r2 = 1}};
  for (const Shape& shape : shapes) {
    const std::optional<Wall> surface = wall(shape);
    ASSERT_TRUE(surface);
    const auto value = [&](Vec3 p) {
      const Vec3 q = p - surface->center, s = surface->squares;
      return s.x * q.x * q.x + s.y * q.y * q.y + s.z * q.z * q.z + 2 * surface->along * q.z +
             surface->constant;
    };
    EXPECT_LT(value(surface->center), 0);
    for (const Vec3 p : outline(shape)) EXPECT_NEAR(value(p), 0, 1e-14);
    if (surface->tip) {
      EXPECT_NEAR(value(*surface->tip), 0, 1e-14);
    }
  }
  EXPECT_EQ(wall(Cylinder{.h = 4, .r1 = 0, .r2 = 1})->tip, (Vec3{0, 0, 0}));
  EXPECT_FALSE(wall(Cylinder{.h = 4, .r1 = 2, .r2 = 2})->tip) << "a cylinder has none";
  EXPECT_FALSE(wall(Sphere{.r = 3, .facets = 8})) << "facets are flat";
}

}  // namespace
}  // namespace whittle
