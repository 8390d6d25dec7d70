// whittle FILE -o part.stl: files of the solid itself.
#include <string>
#include <vector>

#include "support/program.h"

namespace whittle {
namespace {

class SolidFiles : public ProgramTest {
 protected:
  void SetUp() override {
    write("plate.csg",
          "difference() { cube(size = [8, 8, 2]);"
          "multmatrix([[1, 0, 0, 3], [0, 1, 0, 3], [0, 0, 1, -1], [0, 0, 0, 1]])"
          "cube(size = [2, 2, 4]); }\n");
  }
  void expect_refused(const std::string& text, const std::vector<std::string>& more,
                      const std::string& message) {
    write("odd.csg", text);
    std::vector<std::string> arguments{"odd.csg", "-o", "odd.stl"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended refused = run(arguments);
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_EQ(refused.err, message);
    for (const std::string& file : files()) EXPECT_NE(file, "odd.stl");
  }
};

TEST_F(SolidFiles, EachFormatIsWhatItSays) {
  const Ended done = run({"plate.csg", "-o", "a.stl", "-o", "a.off", "-o", "a.OBJ"});
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_EQ(done.err, "");
  // A ring: 16 corners, 10 faces, 32 triangles.
  EXPECT_EQ(read("a.stl").size(), 84u + 50 * 32);
  EXPECT_EQ(read("a.off").find("OFF 16 32 0\n"), 0u);
  EXPECT_EQ(read("a.OBJ").find("v "), 0u);
  const Ended text = run({"plate.csg", "-o", "-", "--export-format", "asciistl"});
  EXPECT_EQ(text.out.find("solid whittle\n  facet normal "), 0u);
  EXPECT_EQ(text.out.substr(text.out.size() - 17), "endsolid whittle\n");
  EXPECT_EQ(run({"plate.csg", "-o", "-", "--export-format", "binstl"}).out, read("a.stl"));
}

TEST_F(SolidFiles, ReadAgainTheyShowTheSame) {
  const std::vector<std::string> view{"--imgsize", "64,64", "--camera", "4,4,1,55,0,25,40"};
  const auto picture = [&](const std::string& file) {
    std::vector<std::string> arguments{file, "-o", "x.png", "--pass", "depth"};
    arguments.insert(arguments.end(), view.begin(), view.end());
    const Ended done = run(arguments);
    EXPECT_EQ(done.exit_code, 0) << done.err;
    EXPECT_EQ(done.err, "");
    return read("x.png");
  };
  ASSERT_EQ(
      run({"plate.csg", "-o", "a.stl", "-o", "a.off", "-o", "a.obj", "-o", "a.png"}).exit_code, 0);
  const std::string original = picture("plate.csg");
  for (const char* file : {"a.stl", "a.off", "a.obj"})
    EXPECT_TRUE(picture(file) == original) << file;
}

TEST_F(SolidFiles, CurvesHaveOpenscadsFacets) {
  write("ball.csg", "sphere(r = 10, $fn = 0, $fa = 12, $fs = 2);\n");
  EXPECT_EQ(run({"ball.csg", "-o", "a.off"}).exit_code, 0);
  // 30 fragments, 15 rings.
  EXPECT_EQ(read("a.off").find("OFF 450 896 0\n"), 0u) << read("a.off").substr(0, 20);
  expect_refused(
      "sphere(r = 10);", {"--curves", "smooth"},
      "odd.csg: error: true curves have no facets (--curves facets gives them some; more "
      "than 2048 count as a true curve)\n");
}

TEST_F(SolidFiles, WhatIsNoSolidIsRefused) {
  expect_refused("square(size = [1, 1], center = false);", {},
                 "odd.csg: error: is flat; these files hold solids\n");
  expect_refused("group();", {}, "odd.csg: error: the solid is empty\n");
  expect_refused("halfspace(n = [0, 0, 1], d = 1);", {},
                 "odd.csg: error: the solid has no end, so no file holds all of it\n");
}

TEST_F(SolidFiles, ThreadsMakeNoDifference) {
  write("balls.csg", "difference() { cube(size = 10, center = true); sphere(r = 6, $fn = 24); }\n");
  ASSERT_EQ(run({"balls.csg", "-o", "one.off", "--threads", "1"}).exit_code, 0);
  ASSERT_EQ(run({"balls.csg", "-o", "three.off", "--threads", "3"}).exit_code, 0);
  EXPECT_TRUE(read("one.off") == read("three.off"));
}

TEST_F(SolidFiles, FloatsThatAreTooCoarseAreTold) {
  write("thin.csg",
        "multmatrix([[1, 0, 0, 1000], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {"
        "cube(size = [0.00001, 1, 1]); }"
        "cube(size = 1);\n");
  const Ended done = run({"thin.csg", "-o", "a.stl", "-o", "a.off"});
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_EQ(done.err,
            "a.stl: note: 8 triangles are too thin for the 32-bit floats of STL and were left out; "
            "the mesh stays closed\n");
}

}  // namespace
}  // namespace whittle
