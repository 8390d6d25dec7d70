#include "boundary/write_solid.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "boundary/collapse.h"
#include "mesh/zip_archive.h"
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

SolidFile written(const SolidMesh& mesh, SolidFormat format) {
  Result<SolidFile> file = write_solid(mesh, format, Workers(1));
  EXPECT_TRUE(file);
  return *std::move(file);
}

/// A part of a 3MF file.
std::string part_of(const std::string& file, const char* name) {
  const Result<ZipArchive> archive = ZipArchive::open(file);
  EXPECT_TRUE(archive);
  const ZipArchive::Entry* entry = archive->find(name);
  EXPECT_NE(entry, nullptr);
  return *archive->unpack(*entry, 100'000);
}

TEST(WriteSolid, TextIsShortAndExact) {
  const SolidMesh mesh = tetrahedron(1);
  EXPECT_EQ(written(mesh, SolidFormat::kOff).bytes,
            "OFF 4 4 0\n0 0 0\n1 0 0\n0 1 0\n0.1 0.1 1\n3 0 2 1\n3 0 1 3\n3 2 0 3\n3 1 2 3\n");
  EXPECT_EQ(written(mesh, SolidFormat::kObj).bytes,
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.1 0.1 1\nf 1 3 2\nf 1 2 4\nf 3 1 4\nf 2 3 4\n");
  EXPECT_EQ(written(mesh, SolidFormat::kAsciiStl).bytes.substr(0, 125),
            "solid whittle\n  facet normal 0 0 -1\n    outer loop\n      vertex 0 0 0\n"
            "      vertex 0 1 0\n      vertex 1 0 0\n    endloop\n  end");
}

TEST(WriteSolid, BinaryStlIsCounted) {
  const SolidFile file = written(tetrahedron(1), SolidFormat::kStl);
  ASSERT_EQ(file.bytes.size(), 84u + 4 * 50);
  EXPECT_NE(file.bytes.substr(0, 5), "solid");
  EXPECT_EQ(file.bytes.substr(80, 4), std::string("\4\0\0\0", 4));
  EXPECT_EQ(file.lost, StlLoss{});
}

TEST(WriteSolid, AmfHasMillimetresAndAllDigits) {
  const std::string amf = written(tetrahedron(1.0 / 3), SolidFormat::kAmf).bytes;
  EXPECT_NE(amf.find("<amf unit=\"millimeter\">"), std::string::npos);
  EXPECT_NE(amf.find("<z>0.3333333333333333</z>"), std::string::npos);
  EXPECT_NE(amf.find("<v1>2</v1>\n     <v2>0</v2>\n     <v3>3</v3>"), std::string::npos);
}

TEST(WriteSolid, A3mfHasColoursWhereThereAreAny) {
  SolidMesh mesh = tetrahedron(1.0 / 3);
  const std::string plain = part_of(written(mesh, SolidFormat::k3mf).bytes, "3D/3dmodel.model");
  EXPECT_EQ(plain.find("material"), std::string::npos);
  EXPECT_NE(plain.find("<model unit=\"millimeter\""), std::string::npos);
  EXPECT_NE(plain.find("<vertex x=\"0.1\" y=\"0.1\" z=\"0.3333333333333333\"/>"),
            std::string::npos);
  EXPECT_NE(plain.find("<triangle v1=\"2\" v2=\"0\" v3=\"3\"/>"), std::string::npos);
  mesh.faces[1].color = mesh.faces[3].color = {1, 0.5, 0, 1};
  mesh.faces[2].color = {0, 0, 1, -1};
  const std::string painted = part_of(written(mesh, SolidFormat::k3mf).bytes, "3D/3dmodel.model");
  EXPECT_NE(painted.find("<base name=\"#F9D72CFF\" displaycolor=\"#F9D72CFF\"/>\n"
                         "   <base name=\"#FF8000FF\" displaycolor=\"#FF8000FF\"/>\n"
                         "  </basematerials>"),
            std::string::npos);
  EXPECT_NE(painted.find("<triangle v1=\"0\" v2=\"2\" v3=\"1\" pid=\"2\" p1=\"0\"/>\n"
                         "     <triangle v1=\"0\" v2=\"1\" v3=\"3\" pid=\"2\" p1=\"1\"/>\n"
                         "     <triangle v1=\"2\" v2=\"0\" v3=\"3\" pid=\"2\" p1=\"0\"/>"),
            std::string::npos);
}

TEST(WriteSolid, WhatFloatsMergeIsLeftOut) {
  SolidMesh mesh = tetrahedron(1);
  mesh.corners[3] = {1, 1e-12, 1e-12};
  const SolidFile file = written(mesh, SolidFormat::kStl);
  // What is left is two triangles on one another, which are closed.
  EXPECT_EQ(file.lost, StlLoss{});
  mesh.corners[3] = {1 + 1e-12, 0, 0};
  EXPECT_EQ(written(mesh, SolidFormat::kStl).lost, (StlLoss{2, 0, 0}));
  EXPECT_EQ(written(mesh, SolidFormat::kOff).lost, StlLoss{});
}

/// A square frame: its outside, and its hole or what becomes of it at the top and at the bottom.
SolidMesh frame(double hole_below, double hole_above) {
  SolidMesh mesh;
  const auto ring = [&](double half, double z) {
    for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
      mesh.corners.push_back({10 + half * x, 10 + half * y, z});
  };
  ring(1, 0), ring(1, 1), ring(hole_below, 0), ring(hole_above, 1);
  mesh.faces = {{{0, 0, 1}, 1}};
  const auto band = [&](uint32_t a, uint32_t b) {
    for (uint32_t i = 0; i < 4; ++i) {
      const uint32_t j = (i + 1) % 4;
      mesh.triangles.push_back({{a + i, a + j, b + j}, 0});
      mesh.triangles.push_back({{a + i, b + j, b + i}, 0});
    }
  };
  band(0, 4), band(4, 12), band(12, 8), band(8, 0);
  return mesh;
}

TEST(WriteSolid, AHoleThatIsLostIsTold) {
  ASSERT_EQ(manifold_fault(frame(0.5, 0.5)), "");
  EXPECT_EQ(written(frame(0.5, 0.5), SolidFormat::kStl).lost, StlLoss{});
  EXPECT_EQ(written(frame(1e-12, 1e-12), SolidFormat::kStl).lost, (StlLoss{16, 1, 0}));
  EXPECT_EQ(written(frame(0.5, 1e-12), SolidFormat::kStl).lost, (StlLoss{8, 1, 0}));
}

TEST(WriteSolid, AShellThatIsLostIsTold) {
  SolidMesh mesh = frame(0.5, 0.5);
  for (const Vec3& corner : tetrahedron(1).corners)
    mesh.corners.push_back(Vec3{1, 1, 1} + corner * 1e-12);
  for (SolidMesh::Triangle triangle : tetrahedron(1).triangles) {
    for (uint32_t& corner : triangle.corners) corner += 16;
    mesh.triangles.push_back({triangle.corners, 0});
  }
  EXPECT_EQ(written(mesh, SolidFormat::kStl).lost, (StlLoss{4, 0, 1}));
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

TEST(CollapseShortEdges, AFaceWithoutTrianglesGoes) {
  SolidMesh mesh = prism(1e-13);
  // The wall where the corner was cut off is a face of its own, and so is what comes behind it.
  mesh.faces = {{{0, 0, 1}, 1}, {{1, 1, 0}, 2}, {{0, 1, 0}, 3}};
  for (SolidMesh::Triangle& triangle : mesh.triangles) {
    const auto on_wall = [&](uint32_t i) {
      return std::all_of(triangle.corners.begin(), triangle.corners.end(),
                         [&](uint32_t corner) { return corner % 5 == i || corner % 5 == i + 1; });
    };
    triangle.face = on_wall(2) ? 1 : on_wall(3) ? 2 : 0;
  }
  EXPECT_EQ(collapse_short_edges(mesh, 1e-12), 2u);
  ASSERT_EQ(mesh.faces.size(), 2u);
  EXPECT_EQ(mesh.faces[0].owner, 1u);
  EXPECT_EQ(mesh.faces[1].owner, 3u);
  const auto of_last = std::count_if(mesh.triangles.begin(), mesh.triangles.end(),
                                     [](const auto& triangle) { return triangle.face == 1; });
  EXPECT_EQ(of_last, 2);
}

TEST(CollapseShortEdges, ASmallSolidStays) {
  SolidMesh mesh = tetrahedron(1);
  for (Vec3& corner : mesh.corners) corner *= 1e-20;
  EXPECT_EQ(collapse_short_edges(mesh, 1e-12), 0u);
  EXPECT_EQ(manifold_fault(mesh), "");
}

}  // namespace
}  // namespace whittle
