#include "boundary/write_solid.h"

#include <gtest/gtest.h>

#include "boundary/collapse.h"
#include "support/mesh_checks.h"

namespace whittle {
namespace {

/// A tetrahedron over a triangle in z = 0.
SolidMesh tetrahedron(double top) {
  SolidMesh mesh;
  mesh.corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, -0.0}, {0.1, 0.1, top}};
  mesh.faces = {{{0, 0, -1}, 1}, {{0, -1, 0}, 1}, {{-1, 0, 0}, 1}, {{0, 0, 1}, 1}};
  mesh.triangles = {{{0, 2, 1}, 0}, {{0, 1, 3}, 1}, {{2, 0, 3}, 2}, {{1, 2, 3}, 3}};
  return mesh;
}

TEST(WriteSolid, TextIsShortAndExact) {
  const SolidMesh mesh = tetrahedron(1);
  EXPECT_EQ(write_solid(mesh, SolidFormat::kOff).bytes,
            "OFF 4 4 0\n0 0 0\n1 0 0\n0 1 0\n0.1 0.1 1\n3 0 2 1\n3 0 1 3\n3 2 0 3\n3 1 2 3\n");
  EXPECT_EQ(write_solid(mesh, SolidFormat::kObj).bytes,
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.1 0.1 1\nf 1 3 2\nf 1 2 4\nf 3 1 4\nf 2 3 4\n");
  EXPECT_EQ(write_solid(mesh, SolidFormat::kAsciiStl).bytes.substr(0, 125),
            "solid whittle\n  facet normal 0 0 -1\n    outer loop\n      vertex 0 0 0\n"
            "      vertex 0 1 0\n      vertex 1 0 0\n    endloop\n  end");
}

TEST(WriteSolid, BinaryStlIsCounted) {
  const SolidFile file = write_solid(tetrahedron(1), SolidFormat::kStl);
  ASSERT_EQ(file.bytes.size(), 84u + 4 * 50);
  EXPECT_NE(file.bytes.substr(0, 5), "solid");
  EXPECT_EQ(file.bytes.substr(80, 4), std::string("\4\0\0\0", 4));
  EXPECT_EQ(file.left_out, 0u);
}

TEST(WriteSolid, WhatFloatsMergeIsLeftOut) {
  SolidMesh mesh = tetrahedron(1);
  mesh.corners[3] = {1, 1e-12, 1e-12};
  const SolidFile file = write_solid(mesh, SolidFormat::kStl);
  // What is left is two triangles on one another, which are closed.
  EXPECT_EQ(file.left_out, 0u);
  mesh.corners[3] = {1 + 1e-12, 0, 0};
  EXPECT_EQ(write_solid(mesh, SolidFormat::kStl).left_out, 2u);
  EXPECT_EQ(write_solid(mesh, SolidFormat::kOff).left_out, 0u);
}

/// A prism over a square whose corner was cut off, ever so little.
SolidMesh prism(double cut) {
  SolidMesh mesh;
  const std::vector<Vec3> base = {
      {0, 0, 0}, {1, 0, 0}, {1, 1 - cut, 0}, {1 - cut, 1, 0}, {0, 1, 0}};
  const auto n = uint32_t(base.size());
  for (const double z : {0.0, 1.0})
    for (const Vec3& p : base) mesh.corners.push_back({p.x, p.y, z});
  mesh.faces = {{{0, 0, 1}, 1}};
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t j = (i + 1) % n;
    mesh.triangles.push_back({{i, j, j + n}, 0});
    mesh.triangles.push_back({{i, j + n, i + n}, 0});
    if (i > 0 && j > 0) mesh.triangles.push_back({{0, j, i}, 0});
    if (i > 0 && j > 0) mesh.triangles.push_back({{n, i + n, j + n}, 0});
  }
  return mesh;
}

TEST(CollapseShortEdges, LeavesAManifoldOfTheSameVolume) {
  SolidMesh mesh = prism(1e-13);
  ASSERT_EQ(manifold_fault(mesh), "");
  EXPECT_EQ(collapse_short_edges(mesh, 1e-12), 2u);
  EXPECT_EQ(manifold_fault(mesh), "");
  EXPECT_EQ(mesh.corners.size(), 8u);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_NEAR(volume(mesh), 1, 1e-12);
  SolidMesh coarse = prism(0.1);
  EXPECT_EQ(collapse_short_edges(coarse, 1e-12), 0u);
  EXPECT_EQ(coarse.corners.size(), 10u);
}

TEST(CollapseShortEdges, ASmallSolidStays) {
  SolidMesh mesh = tetrahedron(1);
  for (Vec3& corner : mesh.corners) corner *= 1e-20;
  EXPECT_EQ(collapse_short_edges(mesh, 1e-12), 0u);
  EXPECT_EQ(manifold_fault(mesh), "");
}

}  // namespace
}  // namespace whittle
