#include "image/draw_outlines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace whittle {
namespace {

constexpr int kOutlineSide = 12;

/// Looks straight down, a pixel a unit; the origin is the picture's lower left corner.
Camera outline_camera() {
  Camera camera;
  camera.orthographic = true;
  camera.eye = {kOutlineSide / 2, kOutlineSide / 2, 10};
  camera.right = {1, 0, 0}, camera.up = {0, 1, 0}, camera.forward = {0, 0, -1};
  camera.half_height = kOutlineSide / 2;
  camera.ortho_reach = 100;
  camera.width = camera.height = kOutlineSide;
  return camera;
}

Picture outline_picture(const std::vector<Vec2>& outline, int antialias = 1) {
  Picture picture(kOutlineSide, kOutlineSide);
  draw_outlines({{outline}}, outline_camera(), {255, 0, 0}, antialias, picture);
  return picture;
}

/// Rows from the top, # where a line is.
std::vector<std::string> outline_rows(const std::vector<Vec2>& outline) {
  const Picture picture = outline_picture(outline);
  std::vector<std::string> rows;
  for (int y = 0; y < kOutlineSide; ++y) {
    std::string& row = rows.emplace_back();
    for (int x = 0; x < kOutlineSide; ++x) row += picture.at(x, y)[3] == 255 ? '#' : '.';
  }
  return rows;
}

/// How many pixels are covered, those partly covered as parts.
double outline_ink(const Picture& picture) {
  double ink = 0;
  for (size_t i = 3; i < picture.rgba.size(); i += 4) ink += picture.rgba[i] / 255.0;
  return ink;
}

TEST(DrawOutlines, LinesAreTwoPixelsWideAndEndSquareToThePicture) {
  // Each ends in a column or row of pixels, so corners are notched.
  const std::vector<std::string> expected = {"............", "............", "...######...",
                                             "..########..", "..##....##..", "..##....##..",
                                             "..##....##..", "..##....##..", "..########..",
                                             "...######...", "............", "............"};
  EXPECT_EQ(outline_rows({{3, 3}, {9, 3}, {9, 9}, {3, 9}}), expected);
}

TEST(DrawOutlines, ALineThatSlopesIsTwoPixelsHighInEveryColumn) {
  // y = x / 2 in the picture's lower left; the way back covers the same.
  const std::vector<std::string> rows = outline_rows({{0, 0}, {12, 6}});
  for (int x = 1; x < 11; ++x) {
    int count = 0;
    for (const std::string& row : rows) count += row[size_t(x)] == '#';
    EXPECT_EQ(count, 2) << x;
  }
}

TEST(DrawOutlines, ALineBeginsInTheDiamondsThatItLeaves) {
  // There and back along row 5. The diamond of its pixel 3 is about x = 3.5.
  const auto columns = [](double from, double to, double y) {
    return outline_rows({{from, y}, {to, y}})[5].substr(2, 8);
  };
  EXPECT_EQ(columns(3.2, 8.2, 6.5), ".######.") << "each way begins in one, and ends before one";
  EXPECT_EQ(columns(3.8, 8.8, 6.5), ".######.");
  // Beside the diamonds a pixel counts if its middle is passed.
  EXPECT_EQ(columns(3.8, 8.8, 6.1), "..#####.");
  EXPECT_EQ(columns(3.2, 8.2, 6.1), ".#####..");
}

TEST(DrawOutlines, TheEndOfALineIsNotDrawnAndItsBeginningIs) {
  // From a diamond in row 5 to the right, and back to it from below on the right.
  EXPECT_EQ(outline_rows({{3.2, 6.5}, {400, 6.5}, {380, -400}})[5], "...#########");
}

TEST(DrawOutlines, WithSamplesAPixelIsAsRedAsItIsCovered) {
  const std::vector<Vec2> slanted = {{2.3, 2.1}, {9.7, 3.3}, {8.1, 9.6}};
  double length = 0;
  for (size_t i = 0; i < 3; ++i) {
    const Vec2 way = slanted[(i + 1) % 3] - slanted[i];
    length += std::max(std::fabs(way.x), std::fabs(way.y));
  }
  const Picture hard = outline_picture(slanted), soft = outline_picture(slanted, 8);
  EXPECT_NEAR(outline_ink(hard), 2 * length, 5);
  EXPECT_NEAR(outline_ink(soft), 2 * length, 5);
  int partly = 0;
  for (size_t i = 3; i < soft.rgba.size(); i += 4) partly += soft.rgba[i] % 255 != 0;
  EXPECT_GT(partly, 20);
}

TEST(DrawOutlines, WhatIsOutsideThePictureIsLeftOut) {
  EXPECT_EQ(outline_ink(outline_picture({{-5, -5}, {99, -5}, {99, 99}, {-5, 99}})), 0);
  const std::vector<std::string> rows =
      outline_rows({{-1e9, 6}, {1e9, 6}, {1e9, 1e9}, {-1e9, 1e9}});
  EXPECT_EQ(rows[5], std::string(kOutlineSide, '#'));
  EXPECT_EQ(rows[7], std::string(kOutlineSide, '.'));
  for (const double far : {1e75, 1e300}) {
    outline_picture({{-far, 6.3}, {far, -far}, {0.7 * far, far}});
    outline_picture({{-far, -0.9 * far}, {far, far}, {0.7 * far, far}});
  }
  EXPECT_EQ(outline_ink(outline_picture({})), 0);
  EXPECT_EQ(outline_ink(outline_picture({{4, 4}})), 0) << "a point has no length";
}

}  // namespace
}  // namespace whittle
