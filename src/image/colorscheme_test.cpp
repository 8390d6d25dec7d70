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

TEST(ColorScheme, DrawingsHaveColorsOfTheirOwn) {
  const auto plane = [](const char* name) { return find_color_scheme(name)->plane; };
  const auto outline = [](const char* name) { return find_color_scheme(name)->outline; };
  EXPECT_EQ(plane("Cornfield"), (Rgb8{0x00, 0xBF, 0x99}));
  EXPECT_EQ(outline("Monotone"), (Rgb8{0xFF, 0x00, 0x00}));
  EXPECT_EQ(plane("Starnight"), (Rgb8{0x93, 0x70, 0xDB}));
  EXPECT_EQ(outline("DeepOcean"), (Rgb8{0xFF, 0x00, 0xFF}));
  EXPECT_EQ(outline("Solarized"), (Rgb8{0xB5, 0x88, 0x00}));
  EXPECT_EQ(plane("Tomorrow Night"), (Rgb8{0xB5, 0xBD, 0x68}));
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
