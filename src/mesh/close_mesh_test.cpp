#include "mesh/close_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

namespace whittle {
namespace {

const std::vector<Vec3> kCubePoints = {{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0},
                                       {0, 0, 4}, {2, 0, 4}, {2, 3, 4}, {0, 3, 4}};
const std::vector<std::vector<uint32_t>> kCubeFaces = {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                                       {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

RawMesh cube(Vec3 at = {}, double scale = 1) {
  RawMesh raw{kCubePoints, kCubeFaces, {}};
  for (Vec3& p : raw.points) p = p * scale + at;
  return raw;
}

RawMesh both(RawMesh a, const RawMesh& b) {
  const auto shift = uint32_t(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (std::vector<uint32_t> face : b.faces) {
    for (uint32_t& corner : face) corner += shift;
    a.faces.push_back(face);
  }
  return a;
}

RawMesh turned(RawMesh raw) {
  for (auto& face : raw.faces) std::reverse(face.begin(), face.end());
  return raw;
}

void expect_closed(const TriangleMesh& mesh) {
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (const auto& t : mesh.triangles)
    for (size_t e = 0; e < 3; ++e) {
      const uint32_t a = t.corners[e], b = t.corners[(e + 1) % 3];
      a < b ? ++edges[{a, b}] : --edges[{b, a}];
    }
  for (const auto& [edge, balance] : edges) EXPECT_EQ(balance, 0);
  for (const auto& t : mesh.triangles)
    for (const uint32_t corner : t.corners)
      EXPECT_LE(
          std::fabs(dot(mesh.facets[t.facet].n, mesh.points[corner]) - mesh.facets[t.facet].d),
          mesh.rise + 1e-12);
}

TEST(CloseMesh, ACubeHasSixFacetsThatAreExact) {
  const ClosedMesh closed = close_mesh(cube(), 6);
  expect_closed(closed.mesh);
  EXPECT_EQ(closed.open_edges, 0u);
  EXPECT_EQ(closed.turned_faces, 0u);
  EXPECT_EQ(closed.mesh.triangles.size(), 12u);
  ASSERT_EQ(closed.mesh.facets.size(), 6u);
  EXPECT_EQ(closed.mesh.rise, 0);
  EXPECT_DOUBLE_EQ(volume(closed.mesh), 24);
  for (const Plane& plane : closed.mesh.facets)
    EXPECT_EQ(std::fabs(plane.n.x) + std::fabs(plane.n.y) + std::fabs(plane.n.z), 1);
}

TEST(CloseMesh, AnyFacesMayBeTurned) {
  for (uint32_t which = 0; which < 64; ++which) {
    RawMesh raw = cube();
    for (size_t face = 0; face < 6; ++face)
      if (which >> face & 1) std::reverse(raw.faces[face].begin(), raw.faces[face].end());
    const ClosedMesh closed = close_mesh(raw, 6);
    expect_closed(closed.mesh);
    EXPECT_DOUBLE_EQ(volume(closed.mesh), 24) << which;
  }
}

TEST(CloseMesh, CavitiesStayAndPartsInsideOutDoNot) {
  const RawMesh small = cube({0.5, 0.5, 0.5}, 0.25);
  const double hollow = 24 - 24.0 / 64;
  EXPECT_DOUBLE_EQ(volume(close_mesh(both(cube(), turned(small)), 6).mesh), hollow);
  // The whole file inside out.
  EXPECT_DOUBLE_EQ(volume(close_mesh(both(turned(cube()), small), 6).mesh), hollow);
  // Beside one another.
  EXPECT_DOUBLE_EQ(volume(close_mesh(both(cube(), turned(cube({9, 0, 0}, 0.25))), 6).mesh),
                   24 + 24.0 / 64);
  // On a side of it, without and within.
  EXPECT_DOUBLE_EQ(volume(close_mesh(both(cube(), turned(cube({0.5, 0.5, 4}, 0.25))), 6).mesh),
                   24 + 24.0 / 64);
  EXPECT_DOUBLE_EQ(volume(close_mesh(both(cube(), turned(cube({0.5, 0.5, 0}, 0.25))), 6).mesh),
                   hollow);
}

TEST(CloseMesh, AFinAtAnEdgeIsLeftOutAlone) {
  RawMesh raw = cube();
  raw.points.push_back({1, -1, -1});
  raw.faces.push_back({0, 1, 8});
  const ClosedMesh closed = close_mesh(raw, 6);
  expect_closed(closed.mesh);
  EXPECT_EQ(closed.open_edges, 3u);
  EXPECT_DOUBLE_EQ(volume(closed.mesh), 24);
}

TEST(CloseMesh, ACornerOnAnEdgeIsNoCrack) {
  // Between points 0 and 1, where the side below has none.
  RawMesh raw = cube();
  raw.points.push_back({1.000001, 0, 0});
  raw.faces[2] = {0, 8, 1, 5, 4};
  ClosedMesh closed = close_mesh(raw, 6);
  expect_closed(closed.mesh);
  EXPECT_EQ(closed.open_edges, 0u);
  EXPECT_EQ(closed.mesh.facets.size(), 6u);
  EXPECT_NEAR(volume(closed.mesh), 24, 1e-4);
  // Where the digits tell a gap there is one: a triangle between the three, as a fin.
  raw.points[8].z = -0.01;
  closed = close_mesh(raw, 6);
  expect_closed(closed.mesh);
  EXPECT_EQ(closed.open_edges, 3u);
  EXPECT_DOUBLE_EQ(volume(closed.mesh), 24);
}

TEST(CloseMesh, OpenPartsAreLeftOut) {
  RawMesh open = cube({5, 0, 0});
  open.faces.pop_back();
  const ClosedMesh closed = close_mesh(both(cube(), open), 6);
  EXPECT_EQ(closed.open_edges, 4u);
  EXPECT_EQ(closed.first_open.x, 5);
  EXPECT_DOUBLE_EQ(volume(closed.mesh), 24);
  EXPECT_TRUE(close_mesh(open, 6).mesh.triangles.empty());
}

TEST(CloseMesh, CubesThatShareAnEdgeAreBothThere) {
  const ClosedMesh closed = close_mesh(both(cube(), cube({2, 3, 0})), 6);
  expect_closed(closed.mesh);
  EXPECT_EQ(closed.open_edges, 0u);
  EXPECT_DOUBLE_EQ(volume(closed.mesh), 48);
  EXPECT_EQ(closed.mesh.points.size(), 14u);
}

TEST(CloseMesh, EveryTriangleWithItsOwnPointsInSixDigits) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> stray(-4e-6, 4e-6);
  RawMesh raw;
  for (const auto& face : kCubeFaces)
    for (const auto& t : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
      std::vector<uint32_t> loop;
      for (const int k : t) {
        loop.push_back(uint32_t(raw.points.size()));
        const Vec3 p = kCubePoints[face[size_t(k)]];
        raw.points.push_back(p + Vec3{stray(random), stray(random), stray(random)} * 0.3);
      }
      raw.faces.push_back(loop);
    }
  const ClosedMesh closed = close_mesh(raw, 6);
  expect_closed(closed.mesh);
  EXPECT_EQ(closed.mesh.points.size(), 8u);
  EXPECT_EQ(closed.mesh.facets.size(), 6u);
  EXPECT_NEAR(volume(closed.mesh), 24, 1e-4);
}

TEST(CloseMesh, FacesMayBeConcaveAndOfManyCorners) {
  // An L of height 2, its caps hexagons.
  RawMesh raw;
  const std::vector<Vec2> loop = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 4}, {0, 4}};
  for (const double z : {0.0, 2.0})
    for (const Vec2 p : loop) raw.points.push_back({p.x, p.y, z});
  raw.faces = {{5, 4, 3, 2, 1, 0}, {6, 7, 8, 9, 10, 11}};
  for (uint32_t k = 0; k < 6; ++k) raw.faces.push_back({k, (k + 1) % 6, 6 + (k + 1) % 6, 6 + k});
  const ClosedMesh closed = close_mesh(raw, 6);
  expect_closed(closed.mesh);
  EXPECT_EQ(closed.mesh.facets.size(), 8u);
  EXPECT_DOUBLE_EQ(volume(closed.mesh), 12);
}

TEST(CloseMesh, WhatIsNoNumberIsNotThere) {
  RawMesh raw = both(cube(), cube({9, 9, 9}));
  raw.points[8].x = NAN;
  raw.points.push_back({INFINITY, 0, 0});
  const ClosedMesh closed = close_mesh(raw, 6);
  EXPECT_DOUBLE_EQ(volume(closed.mesh), 24);
  EXPECT_TRUE(close_mesh({}, 6).mesh.triangles.empty());
  EXPECT_TRUE(close_mesh(cube({}, 1e300), 6).mesh.triangles.empty());
}

}  // namespace
}  // namespace whittle
