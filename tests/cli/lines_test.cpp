// whittle FILE -o part.svg: line drawings.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/program.h"

namespace whittle {
namespace {

class LineFiles : public ProgramTest {
 protected:
  void SetUp() override { write("box.csg", "cube(size = [10, 20, 30], center = false);\n"); }

  /// From the front, to scale.
  Ended draw(std::vector<std::string> more) {
    std::vector<std::string> arguments{"box.csg", "--camera", "0,0,0,90,0,0,100", "--projection",
                                       "ortho"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }

  void expect_refused(const std::vector<std::string>& arguments, int code,
                      const std::string& message) {
    const Ended refused = run(arguments);
    EXPECT_EQ(refused.exit_code, code);
    EXPECT_EQ(refused.err, message);
    for (const std::string& file : files()) EXPECT_EQ(file.find(".svg"), std::string::npos);
  }
};

TEST_F(LineFiles, DrawingToScale) {
  const Ended done = draw({"-o", "a.svg", "-o", "b.SVG"});
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_EQ(done.err, "");
  const std::string svg = read("a.svg");
  EXPECT_NE(svg.find("width=\"14mm\" height=\"34mm\" viewBox=\"-2 -32 14 34\""), std::string::npos);
  EXPECT_NE(svg.find("<title>box.csg</title>"), std::string::npos);
  EXPECT_NE(svg.find("<g class=\"silhouette\">\n<path d=\"M"), std::string::npos);
  EXPECT_EQ(read("b.SVG"), svg);
  EXPECT_EQ(draw({"-o", "-", "--export-format", "svg"}).out, svg);
  EXPECT_EQ(draw({"-o", "-", "--export-format", "svg", "--threads", "1"}).out, svg);
  EXPECT_EQ(draw({"-o", "c.svg", "--scale", "0.5"}).exit_code, 0);
  EXPECT_NE(read("c.svg").find("viewBox=\"-2 -17 9 19\""), std::string::npos);
}

TEST_F(LineFiles, HiddenLinesOnRequest) {
  EXPECT_EQ(run({"box.csg", "-o", "a.svg"}).exit_code, 0);
  EXPECT_EQ(run({"box.csg", "-o", "b.svg", "--hidden-lines"}).exit_code, 0);
  EXPECT_EQ(read("a.svg").find("class=\"hidden\""), std::string::npos);
  EXPECT_NE(read("b.svg").find("class=\"hidden\""), std::string::npos);
}

TEST_F(LineFiles, ASummaryOfADrawingAloneIsThatOfThePicture) {
  const auto summary = [&](const std::vector<std::string>& outputs) {
    std::vector<std::string> arguments{"box.csg", "--summary-file", "s.json"};
    for (const std::string& output : outputs) arguments.insert(arguments.end(), {"-o", output});
    EXPECT_EQ(run(arguments).exit_code, 0);
    return nlohmann::json::parse(read("s.json"));
  };
  const nlohmann::json alone = summary({"a.svg"}), beside = summary({"a.svg", "a.png"});
  EXPECT_EQ(alone["geometry"], beside["geometry"]);
  EXPECT_EQ(alone["geometry"]["bounding_box"]["max"], nlohmann::json({10.0, 20.0, 30.0}));
  EXPECT_NEAR(alone["camera"]["distance"], beside["camera"]["distance"], 1e-3);
  EXPECT_EQ(alone["camera"]["rotation"], beside["camera"]["rotation"]);
  EXPECT_EQ(summary({"a.svg", "a.stl"})["geometry"]["facets"], 12);
  // Warnings are said once.
  write("odd.csg", "cube(size = [1, 2, 3], length = 4);\n");
  EXPECT_EQ(run({"odd.csg", "-o", "b.svg"}).err,
            "odd.csg:1:24: warning: cube: the argument 'length' is not known; it is ignored\n");
}

TEST_F(LineFiles, PictureAndDrawingAreOfOneSize) {
  const Ended done =
      run({"box.csg", "-o", "a.png", "-o", "a.svg", "-o", "a.stl", "--imgsize", "90,70"});
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_NE(read("a.svg").find("width=\"90\" height=\"70\" viewBox=\"0 0 90 70\""),
            std::string::npos);
  EXPECT_GT(read("a.png").size(), 100u);
  EXPECT_GT(read("a.stl").size(), 100u);
}

TEST_F(LineFiles, SaysWhatItDid) {
  const Ended done = draw({"-o", "a.svg", "--stats"});
  EXPECT_NE(done.err.find("facets                  12   12 edges that may be drawn"),
            std::string::npos);
  EXPECT_NE(done.err.find("paths                    1   4 points\n"), std::string::npos);
}

TEST_F(LineFiles, NothingInTheFrameIsSaid) {
  const Ended away = run({"box.csg", "-o", "a.svg", "--camera", "0,0,500,0,0,900"});
  EXPECT_EQ(away.exit_code, 0);
  EXPECT_EQ(away.err, "box.csg: note: nothing of it is in the drawing\n");
  EXPECT_EQ(read("a.svg").find("<path"), std::string::npos);
}

TEST_F(LineFiles, WhatCannotBeDrawnIsRefused) {
  write("none.csg", "difference() { cube(size = 1); cube(size = 1); }");
  expect_refused({"none.csg", "-o", "x.svg"}, 1, "none.csg: error: the solid is empty\n");
  expect_refused({"box.csg", "-o", "x.svg", "--scale", "2"}, 2,
                 "whittle: --scale is for --projection ortho; no other view has a scale\n");
  for (const char* scale : {"0", "-1", "1e9", "x"})
    EXPECT_EQ(draw({"-o", "x.svg", "--scale", scale}).exit_code, 2);
}

}  // namespace
}  // namespace whittle
