// --views, and what is drawn over pictures.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "image/png.h"
#include "sheet/sheet.h"
#include "support/program.h"

namespace whittle {
namespace {

/// What box.csg is.
const Box kSheetBox{{1, 2, 3}, {41, 32, 23}};

class Sheets : public ProgramTest {
 protected:
  void SetUp() override {
    write("box.csg",
          "multmatrix([[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]])\n"
          "  cube(size = [40, 30, 20], center = false);\n");
    write("flat.csg", "square(size = [3, 2], center = false);\n");
    write("empty.csg", "group();\n");
  }
  void expect_refused(const std::vector<std::string>& arguments, int code, const std::string& why) {
    const std::vector<std::string> before = files();
    const Ended ended = run(arguments);
    EXPECT_EQ(ended.exit_code, code);
    EXPECT_TRUE(ended.err.starts_with(why)) << ended.err;
    EXPECT_EQ(files(), before);
  }
  Picture picture(const std::string& name) const {
    Result<Picture> read = read_png(path(name));
    EXPECT_TRUE(read) << name;
    return read ? *std::move(read) : Picture(1, 1);
  }
};

TEST_F(Sheets, ABoxIsWhereItMustBeInEachView) {
  using V = NamedView;
  const std::vector<V> views = {V::kFront, V::kRight, V::kTop, V::kIso};
  for (const auto& [name, angle] :
       {std::pair("first", ProjectionAngle::kFirst), std::pair("third", ProjectionAngle::kThird)}) {
    const Ended ended = run({"box.csg", "--views", "front,right,top,iso", "--angle", name, "-o",
                             "sheet.png", "--imgsize", "800,600", "--no-background"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_EQ(ended.err, "");
    const Picture sheet = picture("sheet.png");
    const SheetSettings settings{views, angle, ""};
    const Result<Sheet> layout = sheet_of_pixels(settings, kSheetBox, 800, 600);
    ASSERT_TRUE(layout);
    for (const SheetView& view : layout->views) {
      const Vec2 middle = view.middle(), half = view.drawn * 0.5;
      const auto alpha = [&](double x, double y) {
        return sheet.at(int(std::floor(x)), int(std::floor(y)))[3];
      };
      EXPECT_EQ(alpha(middle.x, middle.y), 255);
      if (view.view == V::kIso) continue;
      // A pixel and a half within each edge it is there, as far outside it is not. (On the left and
      // below are extension lines, whose gap is larger.)
      constexpr double kOff = 1.6;
      for (const double side : {-1.0, 1.0}) {
        EXPECT_EQ(alpha(middle.x + side * (half.x - kOff), middle.y), 255);
        EXPECT_EQ(alpha(middle.x + side * (half.x + kOff), middle.y), 0);
        EXPECT_EQ(alpha(middle.x, middle.y + side * (half.y - kOff)), 255);
        EXPECT_EQ(alpha(middle.x, middle.y + side * (half.y + kOff)), 0);
      }
    }
  }
}

/// The box of all points of the paths of one class in an SVG.
Box drawn_box(const std::string& svg, const std::string& kind) {
  Box box;
  const size_t start = svg.find("<g class=\"" + kind + "\">"), end = svg.find("</g>", start);
  for (size_t at = start; (at = svg.find_first_of("ML", at)) < end; ++at) {
    char* next = nullptr;
    const double x = std::strtod(&svg[at + 1], &next);
    if (next != &svg[at + 1]) box.include({x, std::strtod(next, nullptr), 0});
  }
  return box;
}

TEST_F(Sheets, ADrawingOfAllViewsIsToScale) {
  const Ended ended = run({"box.csg", "--views", "front,top", "-o", "sheet.svg", "--scale", "2"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const std::string svg = read("sheet.svg");
  const SheetSettings settings{{NamedView::kFront, NamedView::kTop}, ProjectionAngle::kThird, ""};
  const Sheet layout = sheet_to_scale(settings, kSheetBox, 2);
  // The silhouettes reach from the top of the top view to the bottom of the front.
  const SheetView &front = layout.views[0], &top = layout.views[1];
  const Box box = drawn_box(svg, "silhouette");
  EXPECT_NEAR(box.lo.x, front.middle().x - 40, 2e-3);
  EXPECT_NEAR(box.hi.x, front.middle().x + 40, 2e-3);
  EXPECT_NEAR(box.lo.y, top.middle().y - 30, 2e-3);
  EXPECT_NEAR(box.hi.y, front.middle().y + 20, 2e-3);
  EXPECT_NE(svg.find("<g class=\"dimension\">"), std::string::npos);
}

TEST_F(Sheets, WithViewInTheNameEachIsAFile) {
  const Ended ended =
      run({"box.csg", "--views", "top,left", "-o", "{name}-{view}.png", "-o", "{view}.svg", "-o",
           "{view}.exr", "--imgsize", "60,50", "--projection", "ortho"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(files(),
            (std::vector<std::string>{"box-left.png", "box-top.png", "box.csg", "empty.csg",
                                      "flat.csg", "left.exr", "left.svg", "top.exr", "top.svg"}));
  ASSERT_EQ(run({"box.csg", "--from", "left", "-o", "x.png", "--imgsize", "60,50", "--projection",
                 "ortho"})
                .exit_code,
            0);
  EXPECT_EQ(read("x.png"), read("box-left.png"));
}

TEST_F(Sheets, WhatCannotBeIsRefused) {
  const auto with = [](std::vector<std::string> more) {
    std::vector<std::string> arguments{"box.csg", "-o", "x.png"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  };
  expect_refused(with({"--views", "front,side"}), 2, "whittle: --views: unknown view 'side'");
  expect_refused(with({"--views", "top,top"}), 2, "whittle: --views: 'top' is there twice");
  expect_refused(with({"--views", ""}), 2, "whittle: --views: ");
  expect_refused(with({"--views", "top,"}), 2, "whittle: --views: ");
  expect_refused(with({"--views", "top", "--angle", "second"}), 2, "whittle: --angle: ");
  expect_refused(with({"--angle", "first"}), 2, "whittle: --angle is for a sheet");
  expect_refused(with({"--views", "top", "--from", "top"}), 2, "whittle: --views says where");
  expect_refused(with({"--views", "top", "--camera", "0,0,0,0,0,0,1"}), 2, "whittle: --views says");
  expect_refused(with({"--views", "top", "--turntable", "3"}), 2, "whittle: --views is for");
  expect_refused(with({"--views", "top", "--axes"}), 2, "whittle: a sheet has dimensions");
  expect_refused(with({"--views", "top", "--pass", "id"}), 2, "whittle: --pass id: a sheet shows");
  expect_refused(with({"--views", "top", "--imgsize", "20,20"}), 2,
                 "whittle: a sheet of these views does not fit 20 x 20 pixels");
  expect_refused({"box.csg", "--views", "top", "-o", "x.exr"}, 2, "whittle: -o x.exr: facts are");
  expect_refused({"box.csg", "--views", "top", "-o", "x.stl"}, 2, "whittle: -o x.stl: --views");
  expect_refused({"flat.csg", "--views", "top", "-o", "x.png"}, 1, "flat.csg: error: is flat");
  expect_refused({"flat.csg", "--views", "top", "-o", "x.svg"}, 1, "flat.csg: error: is flat");
  expect_refused({"empty.csg", "--views", "top", "-o", "x.svg"}, 1, "empty.csg: ");
  write("top.svg", "<svg/>");
  expect_refused({"top.svg", "--views", "left,top", "-o", "{view}.svg"}, 2,
                 "whittle: -o top.svg is the file that is read");
  expect_refused(with({"--scale-bar"}), 2, "whittle: --scale-bar is for --projection ortho");
  expect_refused(with({"--grid", "--pass", "depth"}), 2, "whittle: --pass depth: --axes");
  expect_refused(with({"--title", std::string(201, 'x')}), 2, "whittle: --title: has 201 bytes");
}

TEST_F(Sheets, AxesBehindTheSolidAreHidden) {
  // From the front the solid hides where the z axis is, but not what stands above it.
  write("plate.csg", "cube(size = [20, 20, 10], center = true);\n");
  const std::vector<std::string> view{"plate.csg",    "--from",      "front",
                                      "--projection", "ortho",       "--imgsize",
                                      "101,101",      "--no-ground", "-o"};
  const auto draw = [&](const std::string& name, bool axes) {
    std::vector<std::string> arguments = view;
    arguments.push_back(name);
    if (axes) arguments.emplace_back("--axes");
    EXPECT_EQ(run(arguments).exit_code, 0);
    return picture(name);
  };
  const Picture plain = draw("plain.png", false), axes = draw("axes.png", true);
  const auto differs = [&](int x, int y) {
    return !std::equal(plain.at(x, y), plain.at(x, y) + 4, axes.at(x, y));
  };
  // 20 units are 85 of 101 pixels; the axis ends three units above the plate.
  EXPECT_FALSE(differs(50, 50));
  EXPECT_FALSE(differs(50, 35));
  EXPECT_TRUE(differs(50, 22));
}

}  // namespace
}  // namespace whittle
