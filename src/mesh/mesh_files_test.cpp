#include "mesh/mesh_files.h"

#include <gtest/gtest.h>

#include <cstring>

namespace whittle {
namespace {

constexpr size_t kMany = 1000;

RawMesh read(std::string_view content, std::string_view name) {
  Result<RawMesh> mesh = read_mesh(content, name, kMany);
  EXPECT_TRUE(mesh) << mesh.error().message;
  return mesh ? *std::move(mesh) : RawMesh{};
}

std::string error(std::string_view content, std::string_view name) {
  const Result<RawMesh> mesh = read_mesh(content, name, kMany);
  return mesh ? "none" : mesh.error().message;
}

constexpr const char* kTriangle =
    "facet normal 0 0 1\n outer loop\n vertex 0 0 1\n vertex 1e0 0 +1\n vertex 0 1 1\n endloop\n"
    "endfacet\n";

std::string binary_stl(uint32_t claimed, uint32_t held, const char* head = "") {
  std::string content(84 + 50 * size_t(held), '\0');
  std::memcpy(content.data(), head, std::strlen(head));
  std::memcpy(content.data() + 80, &claimed, 4);
  for (uint32_t i = 0; i < held; ++i) {
    const float corners[9] = {0, 0, float(i), 1, 0, float(i), 0, 1, float(i)};
    std::memcpy(content.data() + 84 + 50 * size_t(i) + 12, corners, sizeof corners);
  }
  return content;
}

TEST(MeshFiles, FormatsByTheirSuffix) {
  EXPECT_TRUE(is_mesh_file("a/b.STL"));
  EXPECT_TRUE(is_mesh_file("x.off"));
  EXPECT_TRUE(is_mesh_file(".obj"));
  EXPECT_FALSE(is_mesh_file("x.svg"));
  EXPECT_FALSE(is_mesh_file("stl"));
  EXPECT_FALSE(is_mesh_file(""));
}

TEST(MeshFiles, StlText) {
  const RawMesh mesh =
      read(std::string("solid x\n") + kTriangle + kTriangle + "endsolid x\n", "x.stl");
  EXPECT_EQ(mesh.triangles.size(), 2u);
  ASSERT_EQ(mesh.points.size(), 6u);
  EXPECT_EQ(mesh.points[1], (Vec3{1, 0, 1}));
  EXPECT_EQ(error("solid\nvertex 0 0 x\n", "x.stl"), "a vertex is not three numbers");
  EXPECT_EQ(error("hello", "x.stl"), "this is no STL file");
  EXPECT_EQ(error("", "x.stl"), "this is no STL file");
}

TEST(MeshFiles, StlBinary) {
  EXPECT_EQ(read(binary_stl(3, 3), "x.stl").triangles.size(), 3u);
  // One that begins like a text, one that was cut off, one with something behind it.
  EXPECT_EQ(read(binary_stl(3, 3, "solid"), "x.stl").triangles.size(), 3u);
  EXPECT_EQ(read(binary_stl(4000000000u, 3), "x.stl").triangles.size(), 3u);
  EXPECT_EQ(read(binary_stl(3, 3) + "tail", "x.stl").triangles.size(), 3u);
  EXPECT_EQ(read(binary_stl(2, 2), "x.stl").points[5], (Vec3{0, 1, 1}));
  EXPECT_NE(error(binary_stl(1001, 1001), "x.stl").find("more triangles than the limit of 1000"),
            std::string::npos);
}

TEST(MeshFiles, Off) {
  const RawMesh mesh =
      read("OFF # c\n\n3 1 0\n0 0 0 255 0 0\n1 0 0\n0 1 0 # z\n3 0 1 2 0.5\n", "x.off");
  EXPECT_EQ(mesh.points.size(), 3u);
  ASSERT_EQ(mesh.faces.size(), 1u);
  EXPECT_EQ(mesh.faces[0], (std::vector<uint32_t>{0, 1, 2}));
  EXPECT_EQ(read("COFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "x.off").faces.size(), 1u);
  EXPECT_EQ(error("OFF BINARY\n", "x.off"), "binary OFF is not read");
  EXPECT_EQ(error("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "x.off"),
            "a face has a corner that is no point");
  EXPECT_EQ(error("OFF\n3 1 0\n0 0 0\n", "x.off"), "a point is not three numbers");
  EXPECT_NE(error("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n", "x.off").find("limit"),
            std::string::npos);
}

TEST(MeshFiles, Obj) {
  const RawMesh mesh =
      read("# c\no x\nv 0 0 0\nv 1 0 0 1\nvn 0 0 1\nv 0 1 0\nf 1/1/1 2//1 \\\n 3\nf -3 -2 -1\n",
           "x.obj");
  ASSERT_EQ(mesh.faces.size(), 2u);
  EXPECT_EQ(mesh.faces[0], (std::vector<uint32_t>{0, 1, 2}));
  EXPECT_EQ(mesh.faces[1], mesh.faces[0]);
  EXPECT_EQ(error("v 0 0 0\nf 1 2 3\n", "x.obj"), "a face has a corner that is no vertex");
  EXPECT_EQ(error("v 0 0 0\nf 0 1 1\n", "x.obj"), "a face has a corner that is no vertex");
}

}  // namespace
}  // namespace whittle
