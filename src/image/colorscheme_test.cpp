#include "image/colorscheme.h"

#include <gtest/gtest.h>

#include <set>

namespace whittle {
namespace {

TEST(ColorScheme, CornfieldComesFirst) {
  const ColorScheme& first = color_schemes().front();
  EXPECT_EQ(first.name, "Cornfield");
  EXPECT_EQ(first.background_top, (Rgb8{0xFF, 0xFF, 0xE5}));
  EXPECT_EQ(first.front, (Rgb8{0xF9, 0xD7, 0x2C}));
  EXPECT_EQ(first.back, (Rgb8{0x9D, 0xCB, 0x51}));
}

TEST(ColorScheme, EveryNameFindsItsOwnScheme) {
  std::set<std::string_view> names;
  for (const ColorScheme& scheme : color_schemes()) {
    EXPECT_EQ(find_color_scheme(scheme.name), &scheme);
    EXPECT_NE(color_scheme_names().find(scheme.name), std::string::npos);
    names.insert(scheme.name);
  }
  EXPECT_EQ(names.size(), 14u);
}

TEST(ColorScheme, CaseDoesNotMatterButTheRestDoes) {
  EXPECT_EQ(find_color_scheme("tomorrow night"), find_color_scheme("Tomorrow Night"));
  EXPECT_EQ(find_color_scheme(""), nullptr);
  EXPECT_EQ(find_color_scheme("Tomorrow "), nullptr);
  EXPECT_EQ(find_color_scheme("Cornfields"), nullptr);
}

TEST(ColorScheme, OnlyClearSkyIsAGradient) {
  for (const ColorScheme& scheme : color_schemes()) {
    EXPECT_EQ(scheme.background_top == scheme.background_bottom, scheme.name != "ClearSky");
  }
}

}  // namespace
}  // namespace whittle
