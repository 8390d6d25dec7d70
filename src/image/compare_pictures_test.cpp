#include "image/compare_pictures.h"

#include <gtest/gtest.h>

namespace whittle {
namespace {

Picture grey(int width, int height, uint8_t level) {
  Picture picture(width, height);
  for (size_t i = 0; i < picture.rgba.size(); ++i)
    picture.rgba[i] = i % 4 == 3 ? uint8_t(255) : level;
  return picture;
}

TEST(ComparePictures, CountsWhatIsVisible) {
  const Picture a = grey(10, 4, 100);
  Picture b = a;
  EXPECT_EQ(compare(a, b).differing, 0u);
  b.at(3, 1)[2] = 100 + kVisibleLevels;
  EXPECT_EQ(compare(a, b).differing, 0u);
  EXPECT_EQ(compare(a, b).most_levels, kVisibleLevels);
  b.at(7, 2)[0] = 100 - kVisibleLevels - 1;
  b.at(1, 3)[1] = 255;
  const PictureComparison c = compare(a, b);
  EXPECT_EQ(c.differing, 2u);
  EXPECT_EQ(c.most_levels, 155);
  EXPECT_EQ(c.x, 7);
  EXPECT_EQ(c.y, 2);
  EXPECT_DOUBLE_EQ(c.share(), 0.05);
  EXPECT_EQ(describe(c),
            "2 of 40 pixels differ (5 %), by up to 155 of 255 levels; the first at 7,2");
}

TEST(ComparePictures, WhatIsTransparentInBothIsEqual) {
  const Picture a = grey(2, 2, 100);
  Picture b = a, c = a;
  b.at(0, 0)[3] = 0;
  EXPECT_EQ(compare(a, b).differing, 1u);
  c.at(0, 0)[3] = 0, c.at(0, 0)[0] = 7;
  EXPECT_EQ(compare(b, c).differing, 0u);
}

TEST(ComparePictures, SizesThatDifferAreDifferent) {
  const PictureComparison c = compare(grey(3, 4, 1), grey(4, 3, 1));
  EXPECT_EQ(c.share(), 1);
  EXPECT_EQ(describe(c), "different sizes: 3 x 4 and 4 x 3");
  EXPECT_TRUE(difference_picture(grey(3, 4, 1), grey(4, 3, 1)).rgba.empty());
}

TEST(ComparePictures, TheDifferenceIsRed) {
  const Picture a = grey(2, 1, 100);
  Picture b = a;
  b.at(1, 0)[0] = 0;
  const Picture d = difference_picture(a, b);
  EXPECT_EQ(d.at(0, 0)[0], d.at(0, 0)[1]);
  EXPECT_GT(d.at(1, 0)[0], 200);
  EXPECT_LT(d.at(1, 0)[1], 50);
}

}  // namespace
}  // namespace whittle
