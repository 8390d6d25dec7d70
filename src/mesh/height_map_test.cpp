#include <gtest/gtest.h>
#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <string>

#include "mesh/close_mesh.h"
#include "mesh/mesh_files.h"

namespace whittle {
namespace {

constexpr size_t kMany = 1000;

TEST(HeightMap, Text) {
  const Result<RawMesh> raw = read_height_map("# c\n1 2 3\n4 5\n\n7 8 9 10\n", {}, kMany);
  ASSERT_TRUE(raw);
  const TriangleMesh mesh = close_mesh(*raw, 0).mesh;
  // Four columns, three rows; what is missing is 0, and the bottom is one below 1.
  EXPECT_EQ(mesh.points.size(), 12u + 6 + 10 + 1);
  double sum = 0;  // of the four triangles' mean heights in each square: the mean of its corners
  const double h[3][4] = {{1, 2, 3, 0}, {4, 5, 0, 0}, {7, 8, 9, 10}};
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x) sum += (h[y][x] + h[y][x + 1] + h[y + 1][x] + h[y + 1][x + 1]) / 4;
  EXPECT_NEAR(volume(mesh), sum, 1e-12);
  EXPECT_FALSE(read_height_map("1 2\n3 x\n", {}, kMany));
  EXPECT_FALSE(read_height_map("1 nan\n3 4\n", {}, kMany));
  EXPECT_FALSE(read_height_map("1 1e76\n3 4\n", {}, kMany));
  EXPECT_TRUE(read_height_map("1 2 3\n", {}, kMany)->triangles.empty());
  EXPECT_FALSE(read_height_map("1 2 3\n4 5 6\n", {}, 20));
  HeightMap centered;
  centered.center = true;
  EXPECT_EQ(read_height_map("1 2 3\n4 5 6\n", centered, kMany)->points[0], (Vec3{-1, -0.5, 1}));
}

// PNG: the expected heights are those that OpenSCAD 2021.01 gives for these files.

void put_chunk(std::string& png, const std::string& name, const std::string& data) {
  const auto put = [&](uint64_t number) {
    for (int shift = 24; shift >= 0; shift -= 8) png += char(number >> shift & 255);
  };
  put(data.size());
  png += name + data;
  const std::string checked = name + data;
  put(crc32(0, reinterpret_cast<const Bytef*>(checked.data()), uInt(checked.size())));
}

/// Two by two pixels. `rows`: each with the filter's number, 0, before it.
std::string make_png(int depth, int color_type, const std::string& rows,
                     const std::vector<std::pair<std::string, std::string>>& more = {}) {
  std::string png = "\x89PNG\r\n\x1a\n";
  std::string head{0, 0, 0, 2, 0, 0, 0, 2, char(depth), char(color_type), 0, 0, 0};
  put_chunk(png, "IHDR", head);
  for (const auto& [name, data] : more) put_chunk(png, name, data);
  std::string packed(200, '\0');
  uLongf size = packed.size();
  compress(reinterpret_cast<Bytef*>(packed.data()), &size,
           reinterpret_cast<const Bytef*>(rows.data()), uLong(rows.size()));
  packed.resize(size);
  put_chunk(png, "IDAT", packed);
  put_chunk(png, "IEND", "");
  return png;
}

template <class... Byte>
std::string bytes(Byte... value) {
  return {char(value)...};
}

/// The four heights, (0, 0), (1, 0), (0, 1), (1, 1), and the bottom.
std::vector<double> heights(const std::string& png, bool invert = false) {
  HeightMap how;
  how.invert = invert;
  const Result<RawMesh> mesh = read_height_map(png, how, kMany);
  EXPECT_TRUE(mesh) << mesh.error().message;
  std::vector<double> z;
  if (!mesh) return z;
  for (size_t i = 0; i < 4; ++i) z.push_back(mesh->points[i].z);
  z.push_back(mesh->points.back().z);
  return z;
}

void expect_heights(const std::string& png, const std::vector<double>& expected,
                    bool invert = false) {
  const std::vector<double> found = heights(png, invert);
  ASSERT_EQ(found.size(), expected.size());
  for (size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-4) << i;
}

TEST(HeightMap, PngOfAnyKind) {
  const std::vector<double> grey = {78.4314, 98.0392, 39.2157, 58.8235, 0};
  const std::string rows = bytes(0, 100, 150, 0, 200, 250);
  expect_heights(make_png(8, PNG_COLOR_TYPE_GRAY, rows), grey);
  // What brightness the numbers mean is not asked.
  expect_heights(make_png(8, PNG_COLOR_TYPE_GRAY, rows, {{"gAMA", bytes(0, 1, 134, 160)}}), grey);
  expect_heights(make_png(16, PNG_COLOR_TYPE_GRAY, bytes(0, 100, 200, 150, 0, 0, 200, 255, 250, 0)),
                 grey);
  expect_heights(
      make_png(8, PNG_COLOR_TYPE_GRAY_ALPHA, bytes(0, 100, 0, 150, 128, 0, 200, 255, 250, 9)),
      grey);
  expect_heights(make_png(1, PNG_COLOR_TYPE_GRAY, bytes(0, 0x40, 0, 0xc0)), {100, 100, 0, 100, -1});
  expect_heights(
      make_png(8, PNG_COLOR_TYPE_PALETTE, bytes(0, 0, 1, 0, 2, 2),
               {{"PLTE", bytes(255, 0, 0, 0, 255, 0, 0, 0, 255)}, {"tRNS", bytes(0, 128)}}),
      {7.22, 7.22, 21.26, 71.52, 0});
  expect_heights(make_png(8, PNG_COLOR_TYPE_GRAY, bytes(0, 0, 150, 0, 200, 250)),
                 {78.4314, 98.0392, 0, 58.8235, -1});
  expect_heights(make_png(8, PNG_COLOR_TYPE_GRAY, rows),
                 {-78.0392, -97.6471, -38.8235, -58.4314, -98.6471}, true);
}

TEST(HeightMap, DamagedPng) {
  const std::string png = make_png(8, PNG_COLOR_TYPE_GRAY, bytes(0, 100, 150, 0, 200, 250));
  for (size_t size = 8; size + 30 < png.size(); ++size)
    EXPECT_FALSE(read_height_map(png.substr(0, size), {}, kMany)) << size;
  const Result<RawMesh> few = read_height_map(png, {}, 12);
  ASSERT_FALSE(few);
  EXPECT_NE(few.error().message.find("limit of 12"), std::string::npos);
}

}  // namespace
}  // namespace whittle
