#include "film/palette.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstdlib>

namespace whittle {
namespace {

Picture of_colors(const std::vector<Rgb8>& colors) {
  Picture picture(int(colors.size()), 1);
  for (size_t i = 0; i < colors.size(); ++i) {
    const uint8_t rgba[4] = {colors[i].r, colors[i].g, colors[i].b, 255};
    std::copy(rgba, rgba + 4, &picture.rgba[4 * i]);
  }
  return picture;
}

int farthest(const Picture& picture, const IndexedPicture& indexed) {
  int most = 0;
  for (size_t i = 0; i < indexed.indices.size(); ++i) {
    const Rgb8 color = indexed.colors[indexed.indices[i]];
    const uint8_t* rgba = &picture.rgba[4 * i];
    most = std::max({most, std::abs(rgba[0] - color.r), std::abs(rgba[1] - color.g),
                     std::abs(rgba[2] - color.b)});
  }
  return most;
}

RC_GTEST_PROP(Palette, FewColorsStayAsTheyAre, ()) {
  std::vector<Rgb8> colors;
  for (int i = 0; i < *rc::gen::inRange(1, 60); ++i) {
    // Two of one pair of levels are one.
    const auto level = [] { return uint8_t(2 * *rc::gen::inRange(0, 128)); };
    const uint8_t r = level(), g = level();
    colors.push_back({r, g, level()});
  }
  const Picture picture = of_colors(colors);
  RC_ASSERT(farthest(picture, to_palette(picture, 256, false)) == 0);
  RC_ASSERT(farthest(picture, to_palette(picture, 256, true)) == 0);
}

TEST(Palette, AGreyRampLosesNoMoreThanAStep) {
  std::vector<Rgb8> ramp;
  for (int i = 0; i < 256; ++i) ramp.push_back({uint8_t(i), uint8_t(i), uint8_t(i)});
  const Picture picture = of_colors(ramp);
  EXPECT_LE(farthest(picture, to_palette(picture, 256, false)), 1);
  const IndexedPicture few = to_palette(picture, 16, false);
  EXPECT_EQ(few.colors.size(), 16u);
  EXPECT_LE(farthest(picture, few), 20);
}

TEST(Palette, NoMoreColorsThanAsked) {
  Picture picture(64, 64);
  uint32_t seed = 1;
  for (uint8_t& v : picture.rgba) v = uint8_t((seed = seed * 1664525u + 1013904223u) >> 24);
  for (const size_t most : {size_t(2), size_t(7), size_t(256)}) {
    const IndexedPicture indexed = to_palette(picture, most, false);
    EXPECT_EQ(indexed.colors.size(), most);
    for (const uint8_t index : indexed.indices) EXPECT_LT(index, most);
  }
}

}  // namespace
}  // namespace whittle
