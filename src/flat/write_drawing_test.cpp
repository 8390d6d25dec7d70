#include "flat/write_drawing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flat/outlines.h"

namespace whittle {
namespace {

/// A plate with a hole, aside, and a triangle with corners of many digits.
std::vector<Contour> plate() {
  return even_odd(std::vector<Contour>{{{1, 2}, {11.5, 2}, {11.5, 7.25}, {1, 7.25}},
                                       {{2, 3}, {4, 3}, {4, 5}, {2, 5}},
                                       {{20, 0}, {20 + 1.0 / 3, 0}, {20, 1e-7 / 3 + 0.1}}})
      .contours;
}

Polygons read_again(const std::string& file, DrawingFormat format) {
  const auto read = format == DrawingFormat::kSvg ? read_svg : read_dxf;
  const Result<Polygons> polygons = read(
      file, Import{}, [](const std::string&, const std::string& said) { ADD_FAILURE() << said; });
  EXPECT_TRUE(polygons);
  return polygons ? *polygons : Polygons{};
}

double drawn_area(const Polygons& polygons) {
  double twice = 0;
  for (const Contour& contour : polygons.contours)
    for (size_t i = 0; i < contour.size(); ++i) {
      const Vec2 a = contour[i], b = contour[(i + 1) % contour.size()];
      twice += a.x * b.y - a.y * b.x;
    }
  return twice / 2;
}

// What OpenSCAD 2021.01 wrote of translate([1, 2]) square([10.5, 5.25]).
TEST(WriteDrawing, SvgIsOpenscads) {
  const std::vector<Contour> square{{{11.5, 7.25}, {1, 7.25}, {1, 2}, {11.5, 2}}};
  EXPECT_EQ(write_drawing(square, DrawingFormat::kSvg),
            R"(<?xml version="1.0" standalone="no"?>
<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd">
<svg width="11mm" height="6mm" viewBox="1 -8 11 6" xmlns="http://www.w3.org/2000/svg" version="1.1">
<title>OpenSCAD Model</title>
<path d="
M 11.5,-7.25 L 1,-7.25 L 1,-2 L 11.5,-2 z
" stroke="black" fill="lightgray" stroke-width="0.5"/>
</svg>
)");
}

TEST(WriteDrawing, DxfIsOpenscads) {
  const std::vector<Contour> triangle{{{11.5, 7.25}, {-0.0, 7.25}, {1, 2}}};
  EXPECT_EQ(write_drawing(triangle, DrawingFormat::kDxf),
            "  0\nSECTION\n  2\nBLOCKS\n  0\nENDSEC\n  0\nSECTION\n  2\nENTITIES\n"
            "  0\nLINE\n  8\n0\n 10\n11.5\n 20\n7.25\n 11\n0\n 21\n7.25\n"
            "  0\nLINE\n  8\n0\n 10\n0\n 20\n7.25\n 11\n1\n 21\n2\n"
            "  0\nLINE\n  8\n0\n 10\n1\n 20\n2\n 11\n11.5\n 21\n7.25\n"
            "  0\nENDSEC\n  0\nSECTION\n  2\nOBJECTS\n  0\nDICTIONARY\n  0\nENDSEC\n  0\nEOF\n");
}

TEST(WriteDrawing, ADxfReadAgainIsTheSame) {
  const Polygons again =
      read_again(write_drawing(plate(), DrawingFormat::kDxf), DrawingFormat::kDxf);
  EXPECT_TRUE(subtract(std::vector{again, Polygons{plate()}}).is_empty());
  EXPECT_TRUE(subtract(std::vector{Polygons{plate()}, again}).is_empty());
}

// OpenSCAD reads its own files so that the page begins at the origin.
TEST(WriteDrawing, AnSvgReadAgainIsTheSameInAnotherPlace) {
  const Polygons again =
      read_again(write_drawing(plate(), DrawingFormat::kSvg), DrawingFormat::kSvg);
  EXPECT_EQ(again.contours.size(), plate().size());
  EXPECT_NEAR(drawn_area(again), drawn_area(Polygons{plate()}), 1e-12);
  const Rect before = bounds(Polygons{plate()}), after = bounds(again);
  EXPECT_NEAR(after.hi.x - after.lo.x, before.hi.x - before.lo.x, 1e-12);
  EXPECT_NEAR(after.hi.y - after.lo.y, before.hi.y - before.lo.y, 1e-12);
}

TEST(SvgWriter, KeepsGroupsAndOpenLines) {
  SvgWriter writer({{0, 0}, {2, 1}}, "Lines");
  writer.begin_group(R"( id="a" fill="none")");
  writer.add(std::vector<Contour>{{{0, 0}, {2, 1}}, {{1, 0}, {1, 1}}}, false, R"( stroke="red")");
  writer.end_group();
  const std::string file = std::move(writer).finish();
  EXPECT_EQ(file.substr(file.find("<title>")),
            "<title>Lines</title>\n<g id=\"a\" fill=\"none\">\n"
            "<path d=\"\nM 0,0 L 2,-1\nM 1,0 L 1,-1\n\" stroke=\"red\"/>\n</g>\n</svg>\n");
}

}  // namespace
}  // namespace whittle
