// Numbers without a source of their own are what OpenSCAD 2021.01 makes of the same text.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "flat/outlines.h"
#include "flat/polygons_for_test.h"

namespace whittle {
namespace {

constexpr const char* kPage = R"(width="100mm" height="100mm" viewBox="0 0 100 100")";
constexpr const char* kRect = R"(<rect x="10" y="10" width="20" height="10"/>)";

std::string svg(const std::string& content, const std::string& page = kPage) {
  return R"(<?xml version="1.0"?><svg xmlns="http://www.w3.org/2000/svg" )" + page + ">" + content +
         "</svg>";
}

std::string path(const std::string& data, const std::string& more = "") {
  return svg("<path d=\"" + data + "\" " + more + "/>");
}

class Svg : public testing::Test {
 protected:
  Polygons read(const std::string& content) {
    remarks.clear();
    const Result<Polygons> polygons = read_svg(
        content, how, [this](const auto&, const std::string& text) { remarks.push_back(text); });
    EXPECT_TRUE(polygons) << polygons.error().message;
    return polygons ? *polygons : Polygons{};
  }
  std::string error(const std::string& content) {
    const Result<Polygons> polygons = read_svg(content, how, [](const auto&, const auto&) {});
    return polygons ? "" : polygons.error().message;
  }
  /// One contour, in millimetres.
  void expect_box(const std::string& content, double x0, double y0, double x1, double y1) {
    const Polygons polygons = read(content);
    ASSERT_EQ(polygons.contours.size(), 1u) << content;
    const Rect box = bounds(polygons);
    EXPECT_NEAR(box.lo.x, x0, 1e-4) << content;
    EXPECT_NEAR(box.lo.y, y0, 1e-4) << content;
    EXPECT_NEAR(box.hi.x, x1, 1e-4) << content;
    EXPECT_NEAR(box.hi.y, y1, 1e-4) << content;
  }

  Import how;
  std::vector<std::string> remarks;
};

TEST_F(Svg, YPointsUpFromTheLowerEdgeOfThePage) {
  expect_box(svg(kRect), 10, 80, 30, 90);
}

TEST_F(Svg, PagesHaveUnits) {
  const std::string view = R"( viewBox="0 0 100 100")";
  expect_box(svg(kRect, ""), 10, -20, 30, -10);
  expect_box(svg(kRect, view), 3.527778, 28.222222, 10.583333, 31.75);
  expect_box(svg(kRect, R"(width="100" height="50")"), 10, -2.361111, 30, 7.638889);
  expect_box(svg(kRect, R"(width="100px" height="50px")" + view), 7.9375, 10.583333, 10.583333,
             11.90625);
  expect_box(svg(kRect, R"(width="1in" height="2in")" + view), 2.54, 33.02, 7.62, 35.56);
  expect_box(svg(kRect, R"(width="10pc" height=" 10 pc ")"), 10, 22.333333, 30, 32.333333);
  expect_box(svg(kRect, R"(width="10cm" height="1e1cm")"), 10, 80, 30, 90);
  expect_box(svg(kRect, R"(width="50%" height="50%")" + view), 10, 80, 30, 90);
  expect_box(svg(kRect, R"(width="abc" height="5mm")" + view), 15.638889, 4, 16.638889, 4.5);
  how.dpi = 96;
  expect_box(svg(kRect, R"(width="96" height="96")"), 10, 5.4, 30, 15.4);
  how.dpi = 0;
  expect_box(svg(kRect, R"(width="72" height="72")"), 10, 5.4, 30, 15.4);
}

TEST_F(Svg, ViewBoxesFitTheirPages) {
  const auto page = [](const std::string& fit) {
    return svg(kRect, R"(width="100mm" height="50mm" viewBox="0 0 20 100" preserveAspectRatio=")" +
                          fit + "\"");
  };
  expect_box(page("xMinYMin"), 5, 40, 15, 45);
  expect_box(page("none"), 50, 40, 150, 45);
  expect_box(page("xMaxYMax slice"), 50, 400, 150, 450);
  expect_box(page("defer xMidYMid slice"), 50, 175, 150, 225);
  expect_box(page("xMidYMin meet"), 50, 40, 60, 45);
  expect_box(page("nonsense"), 50, 40, 60, 45);
  expect_box(svg(kRect, R"(width="100mm" height="100mm" viewBox="5 7 100 100")"), 5, 73, 25, 83);
  expect_box(svg(kRect, R"(width="100mm" height="100mm" viewBox="0,0,-5,10")"), 10, 80, 30, 90);
  EXPECT_TRUE(read(svg(kRect, R"(width="9mm" height="9mm" viewBox="0 0 0 0")")).is_empty());
}

TEST_F(Svg, CenteringForgetsTheViewBox) {
  how.center = true;
  expect_box(svg(kRect), -10, -5, 10, 5);
  expect_box(svg(kRect, R"(width="100mm" height="100mm" viewBox="5 7 100 100")"), -15, -12, 5, -2);
}

TEST_F(Svg, CurvesHaveFixedSteps) {
  how.fragments.fn = 7;
  const Polygons circle = read(svg(R"(<circle cx="50" cy="50" r="10"/>)"));
  ASSERT_EQ(circle.contours.size(), 1u);
  EXPECT_EQ(circle.contours[0].size(), 40u);
  EXPECT_NEAR(area(circle), 20 * 10 * 10 * std::sin(std::numbers::pi / 20), 1e-6);
  EXPECT_EQ(read(path("M0 0C0 50 50 50 50 0z")).contours[0].size(), 21u);
  EXPECT_EQ(read(path("M0 0Q0 50 50 50T50 0z")).contours[0].size(), 41u);
  EXPECT_EQ(read(path("M10 10A20 10 30 1 1 50 30z")).contours[0].size(), 15u);
  EXPECT_EQ(read(path("M10 10A5 5 0 0 1 20 10z")).contours[0].size(), 15u);
  EXPECT_EQ(read(path("M10 10A1 1 0 0 0 20 10V20z")).contours[0].size(), 17u);
  EXPECT_EQ(read(svg(R"(<rect x="10" y="20" width="30" height="20" rx="5"/>)")).contours[0].size(),
            40u);
}

TEST_F(Svg, SmoothCurvesMirrorTheControlPointOfTheirOwnKind) {
  const auto same = [this](const std::string& a, const std::string& b) {
    const Polygons p = read(path(a)), q = read(path(b));
    EXPECT_EQ(p.contours, q.contours) << a;
  };
  same("M0 0C0 20 10 20 10 10S20 0 30 0V40z", "M0 0C0 20 10 20 10 10C10 0 20 0 30 0V40z");
  same("M0 0Q0 20 10 20S20 0 30 0V40z", "M0 0Q0 20 10 20C10 20 20 0 30 0V40z");
  same("M0 0Q5 20 10 20T20 40H0z", "M0 0Q5 20 10 20Q15 20 20 40H0z");
  same("M0 0C0 20 10 20 10 10T30 0V40z", "M0 0C0 20 10 20 10 10Q10 10 30 0V40z");
  same("M1 1c0 20 10 20 10 10s10 -10 20 -10v40z", "M1 1C1 21 11 21 11 11S21 1 31 1V41z");
}

TEST_F(Svg, PathDataNeedsNoSpaces) {
  expect_box(path("m10,10 20,0 0,10-20,0z"), 10, 80, 30, 90);
  expect_box(path("M1e1.1E+2H+30V20L10 20z"), 10, 80, 30, 90);
  EXPECT_NEAR(area(read(path("M10 10a5 5 0 0110 0z"))),
              area(read(path("M10 10 a 5 5 0 0 1 10 0 z"))), 1e-12);
  // What is not understood ends it.
  expect_box(path("M0 0H10V10H0z M 20 20 # H30V30z"), 0, 90, 10, 100);
  expect_box(path("M0 0H10V10H0zM0"), 0, 90, 10, 100);
}

TEST_F(Svg, OpenPathsAreStrokes) {
  expect_box(path("M0 0H10"), -0.5, 99.5, 10.5, 100.5);
  expect_box(path("M0 0H10", "style='stroke-width:2;stroke-linecap:butt'"), 0, 99, 10, 101);
  // A unit is not understood, and spaces are not forgiven.
  expect_box(path("M0 0H10", "style='stroke-width:2px; stroke-linecap:butt'"), -0.5, 99.5, 10.5,
             100.5);
  EXPECT_EQ(read(path("M0 0H10", "stroke-linecap='round'")).contours[0].size(), 316u);
  EXPECT_NEAR(area(read(path("M0 0H10V10"))), 21, 1e-3);
  // Ends within 0.1 meet.
  EXPECT_NEAR(area(read(path("M0 0H10V10H0V0.05"))), 100, 0.3);
  EXPECT_NEAR(area(read(path("M0 0H10V10H0V0.15"))), 40, 1);
  // Behind a closed part the last is closed as well.
  EXPECT_NEAR(area(read(path("M20 20h5v5zM0 0H10V10"))), 62.5, 1e-6);
  EXPECT_NEAR(area(read(path("M0 0H10V10M20 20h5v5z"))), 21 + 12.5, 1e-3);
  expect_box(svg("<line x2='10' transform='scale(3)'/>"), -1.5, 98.5, 31.5, 101.5);
  EXPECT_NEAR(area(read(svg("<polyline points='0,0 10,0 10,10'/>"))), 21, 1e-3);
  expect_box(svg("<polyline points='5,5'/>"), 4.5, 94.5, 5.5, 95.5);
}

TEST_F(Svg, StrokesWithoutMeasureAreLeftOut) {
  EXPECT_TRUE(read(path("M0 0H10", "stroke-width='1e300'")).is_empty());
  EXPECT_TRUE(read(path("M0 0H1e300")).is_empty());
}

TEST_F(Svg, ShapesAreEvenOddAndJoined) {
  EXPECT_NEAR(area(read(path("M0 0H50V50H0zM10 10H40V40H10z"))), 2500 - 900, 1e-6);
  EXPECT_NEAR(area(read(svg("<polygon points='0 0 50 0 50 50 0 50'/>"
                            "<polygon points='10 10 40 10 40 40 10 40' fill='none'/>"))),
              2500, 1e-6);
}

TEST_F(Svg, RectanglesMayBeRound) {
  const auto round = [this](const std::string& radii) {
    return area(read(svg("<rect x='10' y='20' width='30' height='20' " + radii + "/>")));
  };
  EXPECT_NEAR(round("rx='0'"), 600, 1e-6);
  EXPECT_NEAR(round("rx='-3'"), 600, 1e-6);
  // A quarter turn has nine steps.
  const double quarter = 0.5 * 25 * 9 * std::sin(std::numbers::pi / 18);
  EXPECT_NEAR(round("rx='5'"), 600 - 4 * (25 - quarter), 1e-6);
  EXPECT_NEAR(round("ry='5'"), round("rx='5'"), 1e-9);
  EXPECT_NEAR(round("rx='99' ry='5'"), 600 - 4 * 3 * (25 - quarter), 1e-6);
}

TEST_F(Svg, TransformsNest) {
  expect_box(svg("<g transform='translate(10,20) scale(2)'>"
                 "<rect transform='rotate(90 1 2)' x='1' y='2' width='3' height='4'/></g>"),
             4, 70, 12, 76);
  const auto moved = [](const std::string& how_so) {
    return svg("<rect x='10' y='10' width='20' height='10' transform='" + how_so + "'/>");
  };
  expect_box(moved("translate( 1 , 2 ) , scale (2)"), 21, 58, 61, 78);
  expect_box(moved("matrix(1,0,.5,1,10,-20)"), 25, 100, 50, 110);
  expect_box(moved("skewX(45)"), 20, 80, 50, 90);
  expect_box(moved("translate(1,2,3)"), 10, 80, 30, 90);
  // A page has none.
  expect_box(svg(kRect, std::string(kPage) + " transform='scale(9)'"), 10, 80, 30, 90);
}

TEST_F(Svg, DefinitionsAreDrawnWhereTheyAreUsed) {
  const std::string defs = "<defs><g id='a'><rect x='1' y='2' width='3' height='4'/></g></defs>";
  EXPECT_TRUE(read(svg(defs)).is_empty());
  expect_box(svg(defs + "<use xlink:href='#a' x='10' y='20'/>"), 11, 74, 14, 78);
  expect_box(
      svg(defs + "<g transform='scale(2)'><use href='#a'><title/></use></g>" + "<use href='#b'/>"),
      2, 88, 8, 96);
  EXPECT_NEAR(area(read(svg(defs + "<use href='#a'/><use href='#a' x='9'/>"))), 24, 1e-6);
}

TEST_F(Svg, UsesWithoutEndEnd) {
  EXPECT_NEAR(area(read(svg("<defs><g id='a'><rect width='1' height='1'/><use href='#a' x='2'/></g>"
                            "</defs><use href='#a'/>"))),
              16, 1e-6);
  std::string many = "<defs><g id='a'>";
  for (int i = 0; i < 100; ++i) many += "<use href='#a'/>";
  EXPECT_EQ(error(svg(many + "</g></defs><use href='#a'/>")),
            "it has more elements or corners than can be drawn");
}

TEST_F(Svg, IdsAndLayersAreChosen) {
  const std::string file =
      svg("<g inkscape:groupmode='layer' inkscape:label='A &amp; B'>"
          "<rect id='r' width='1' height='1'/><g><rect width='2' height='1' x='5'/></g></g>"
          "<g inkscape:groupmode='layer' inkscape:label='C'><rect id='r' width='4' height='1'/></g>"
          "<g inkscape:label='D' id='d'><rect width='8' height='1'/></g>");
  how.layer = "A & B";
  EXPECT_NEAR(area(read(file)), 3, 1e-6);
  how.layer = "";
  how.id = "d";
  EXPECT_NEAR(area(read(file)), 8, 1e-6);
  how.id = "r";
  how.layer = "C";
  EXPECT_NEAR(area(read(file)), 4, 1e-6);
  EXPECT_TRUE(remarks.empty());
  how.layer = "D";  // is no layer
  EXPECT_TRUE(read(file).is_empty());
  EXPECT_EQ(remarks.size(), 1u);
}

TEST_F(Svg, WhatIsNotDrawnIsSaid) {
  EXPECT_TRUE(read(svg("<text x='1' y='2'>a</text><image/>")).is_empty());
  EXPECT_EQ(remarks, std::vector<std::string>{"text and pictures in it are left out"});
  EXPECT_TRUE(read(svg("<rect width='100%' height='1'/>")).is_empty());
  EXPECT_EQ(remarks,
            std::vector<std::string>{"lengths with a unit in it count as 0, as in OpenSCAD"});
}

TEST_F(Svg, NoXmlIsAnError) {
  EXPECT_EQ(error(""), "this is no SVG file");
  EXPECT_EQ(error("solid a"), "this is no SVG file");
  const std::string whole = svg(kRect);
  EXPECT_EQ(error(whole.substr(0, whole.size() - 3)), "its XML is damaged or was cut off");
}

TEST_F(Svg, HostileFilesEnd) {
  std::string deep;
  for (int i = 0; i < 200'000; ++i) deep += "<g transform='scale(1e9)'>";
  for (int i = 0; i < 200'000; ++i) deep += "</g>";
  EXPECT_TRUE(read(svg(deep)).is_empty());
  std::string wide = "<path d='M0 0";
  for (int i = 0; i < 60'000; ++i) wide += "t1 1";
  EXPECT_EQ(error(svg(wide + "'/>")), "it has more elements or corners than can be drawn");
  std::string tangle = "M";
  for (int i = 0; i < 5'000; ++i)
    tangle += std::to_string(i * 7919 % 2003) + " " + std::to_string(i * 104'729 % 1009) + " ";
  EXPECT_EQ(error(path(tangle + "z")), "it has too many lines across one another");
  for (const char* data : {"M1e999 0L1 1 2 2z", "M0 0a1e300 1e-300 9 0 1 1e300 1e300z",
                           "M0 0a0 0 0 0 1 1 1z", "M0 0a1 1 0 0 1 0 0z", "M-1e308 0l2e308 1 1 1z"})
    read(path(data));
}

}  // namespace
}  // namespace whittle
