#include "lines/write_line_svg.h"

#include <gtest/gtest.h>

namespace whittle {
namespace {

TEST(WriteLineSvg, DrawingToScale) {
  const LineDrawing drawing{
      .is_to_scale = true,
      .corner = {-2, -12.5},
      .size = {14, 14.5},
      .paths = {{LineKind::kSilhouette, true, {{0, -0.0001}, {10, 0}, {10, -10.5}}},
                {LineKind::kHidden, false, {{0, 0}, {1.25, 3}}}}};
  EXPECT_EQ(write_line_svg(drawing, "a<b>&c.csg"),
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"14mm\" height=\"14.5mm\" "
            "viewBox=\"-2 -12.5 14 14.5\">\n"
            "<title>a&lt;b&gt;&amp;c.csg</title>\n"
            "<style>\n"
            "path { fill: none; stroke: black; stroke-linecap: round; stroke-linejoin: round }\n"
            ".silhouette { stroke-width: 0.5 }\n"
            ".edge { stroke-width: 0.25 }\n"
            ".hidden { stroke-width: 0.25; stroke-dasharray: 1.5 0.75 }\n"
            "</style>\n"
            "<g class=\"hidden\">\n"
            "<path d=\"M0 0L1.25 3\"/>\n"
            "</g>\n"
            "<g class=\"silhouette\">\n"
            "<path d=\"M0 0L10 0L10 -10.5Z\"/>\n"
            "</g>\n"
            "</svg>\n");
}

TEST(WriteLineSvg, PictureIsInPixels) {
  const std::string svg = write_line_svg(
      {.is_to_scale = false, .corner = {}, .size = {512, 300}, .paths = {}}, "part.csg");
  EXPECT_NE(svg.find("width=\"512\" height=\"300\" viewBox=\"0 0 512 300\""), std::string::npos);
  EXPECT_EQ(svg.find("<g"), std::string::npos);
}

TEST(WriteLineSvg, TitleIsWellFormed) {
  const auto title = [](std::string_view name) {
    const std::string svg = write_line_svg({}, name);
    const size_t from = svg.find("<title>") + 7;
    return svg.substr(from, svg.find("</title>") - from);
  };
  EXPECT_EQ(title("B\xc3\xbcgel \xe2\x82\xac \xf0\x9f\x94\xa7.csg"),
            "B\xc3\xbcgel \xe2\x82\xac \xf0\x9f\x94\xa7.csg");
  // Latin-1; cut off; overlong; a surrogate; beyond Unicode; no character; a control character.
  EXPECT_EQ(title("B\xfcgel"), "B?gel");
  EXPECT_EQ(title("a\xe2\x82"), "a??");
  EXPECT_EQ(title("\xc0\xaf \xe0\x80\xaf \xf0\x80\x80\xaf"), "?? ??? ????");
  EXPECT_EQ(title("\xed\xa0\x80 \xf4\x90\x80\x80 \xff"), "??? ???? ?");
  EXPECT_EQ(title("\xef\xbf\xbf\x01"), "????");
}

}  // namespace
}  // namespace whittle
