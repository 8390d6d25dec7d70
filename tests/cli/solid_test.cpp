// whittle FILE -o part.stl: files of the solid itself, and of drawings.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "mesh/zip_archive.h"
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
  ASSERT_EQ(run({"plate.csg", "-o", "a.stl", "-o", "a.off", "-o", "a.obj", "-o", "a.3mf", "-o",
                 "a.amf", "-o", "a.png"})
                .exit_code,
            0);
  const std::string original = picture("plate.csg");
  for (const char* file : {"a.stl", "a.off", "a.obj", "a.3mf", "a.amf"})
    EXPECT_TRUE(picture(file) == original) << file;
}

TEST_F(SolidFiles, ReadAgainTheyAreTheSameSolid) {
  write("balls.csg",
        "difference() { cube(size = 10, center = true); sphere(r = 6, $fn = 17);"
        "multmatrix([[0.6, -0.8, 0, 1], [0.8, 0.6, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]])"
        "cube(size = 3); }\n");
  for (const std::string ending : {"off", "obj", "3mf", "amf"}) {
    ASSERT_EQ(run({"balls.csg", "-o", "a." + ending}).exit_code, 0);
    const Ended again = run({"a." + ending, "-o", "b.off"});
    EXPECT_EQ(again.err, "") << ending;
    ASSERT_EQ(again.exit_code, 0);
    // What is in the one and not in the other is at most a film.
    write("both.csg", "difference() { import(file = \"a." + ending +
                          "\"); import(file = \"b.off\"); }\n"
                          "difference() { import(file = \"b.off\"); import(file = \"a." +
                          ending + "\"); }\n");
    EXPECT_EQ(run({"both.csg", "-o", "x.stl"}).err, "both.csg: error: the solid is empty\n");
  }
}

TEST_F(SolidFiles, CurvesHaveOpenscadsFacets) {
  write("ball.csg", "sphere(r = 10, $fn = 0, $fa = 12, $fs = 2);\n");
  EXPECT_EQ(run({"ball.csg", "-o", "a.off"}).exit_code, 0);
  // 30 fragments, 15 rings.
  EXPECT_EQ(read("a.off").find("OFF 450 896 0\n"), 0u) << read("a.off").substr(0, 20);
  expect_refused("sphere(r = 10);", {"--curves", "smooth"},
                 "odd.csg: error: there are true curves in it, which have no facets "
                 "(--curves smooth asks for them)\n");
  expect_refused("sphere(r = 10, $fn = 2049);", {},
                 "odd.csg: error: there are true curves in it, which have no facets "
                 "(more than 2048 facets around count as a true curve)\n");
}

TEST_F(SolidFiles, WhatIsNoSolidIsRefused) {
  expect_refused(
      "square(size = [1, 1], center = false);", {},
      "odd.csg: error: the model is flat, not a solid; .svg and .dxf hold what is flat\n");
  expect_refused("group();", {}, "odd.csg: error: the solid is empty\n");
  expect_refused("halfspace(n = [0, 0, 1], d = 1);", {},
                 "odd.csg: error: the solid has no end, so no file holds all of it\n");
}

TEST_F(SolidFiles, APictureIsMadeOfWhatIsNoSolid) {
  write("none.csg", "group();\n");
  const Ended done =
      run({"none.csg", "-o", "a.stl", "-o", "a.png", "--imgsize", "8,8", "--summary", "time"});
  EXPECT_EQ(done.exit_code, 1);
  EXPECT_EQ(done.err,
            "none.csg: warning: the solid is empty\nnone.csg: error: the solid is empty\n");
  EXPECT_EQ(files(), (std::vector<std::string>{"a.png", "none.csg", "plate.csg"}));
}

TEST_F(SolidFiles, StandardInputIsReadOnceForAll) {
  write("box.csg", "cube(size = [1, 2, 3], center = false);");
  const std::vector<std::string> outputs{"-o", "b.png", "-o", "b.stl", "-o", "b.svg"};
  std::vector<std::string> arguments{"-"};
  arguments.insert(arguments.end(), outputs.begin(), outputs.end());
  const Ended done = run(arguments, {.in = "cube(size = [1, 2, 3], center = false);"});
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_EQ(done.err, "");
  const std::string stl = read("b.stl");
  EXPECT_EQ(run({"box.csg", "-o", "c.stl"}).exit_code, 0);
  EXPECT_EQ(stl, read("c.stl"));
}

TEST_F(SolidFiles, WhatIsLeftOutIsNoSuccess) {
  write("part.csg", "cube(size = 1); roof() square(size = 1);\n");
  const Ended done = run({"part.csg", "-o", "a.stl", "-q"});
  EXPECT_EQ(done.exit_code, 1);
  EXPECT_EQ(done.err,
            "part.csg:1:17: error: roofs are not supported; so the solid is not what was meant "
            "(--lenient accepts that)\n");
  EXPECT_EQ(read("a.stl").size(), 84u + 50 * 12);
  EXPECT_EQ(run({"part.csg", "-o", "a.stl", "-q", "--lenient"}).exit_code, 0);
}

TEST_F(SolidFiles, ASummaryTellsOfTheSolid) {
  const Ended done =
      run({"plate.csg", "-o", "a.stl", "--summary", "all", "--summary-file", "s.json"});
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_NE(done.err.find("Top level object is a 3D object:\n   Vertices:      16\n"
                          "   Facets:        32\nBounding box:\n   Min:         0.00, 0.00, 0.00\n"
                          "   Max:         8.00, 8.00, 2.00\n"),
            std::string::npos)
      << done.err;
  const nlohmann::json json = nlohmann::json::parse(read("s.json"));
  EXPECT_EQ(json["geometry"]["dimensions"], 3);
  EXPECT_EQ(json["geometry"]["facets"], 32);
  EXPECT_EQ(json["geometry"]["vertices"], 16);
  EXPECT_EQ(json["geometry"]["bounding_box"]["max"], nlohmann::json({8.0, 8.0, 2.0}));
  EXPECT_EQ(json["camera"]["rotation"], nlohmann::json({55.0, 0.0, 25.0}));
  EXPECT_TRUE(json.contains("time"));
  // The camera is the same beside a picture.
  ASSERT_EQ(run({"plate.csg", "-o", "a.stl", "-o", "a.png", "--imgsize", "8,8", "--summary-file",
                 "p.json"})
                .exit_code,
            0);
  const nlohmann::json both = nlohmann::json::parse(read("p.json"));
  EXPECT_EQ(both["geometry"], json["geometry"]);
  EXPECT_NEAR(both["camera"]["distance"], json["camera"]["distance"], 1e-4);
}

TEST_F(SolidFiles, ColoursAreIn3mf) {
  write("two.csg",
        "color([1, 0, 0, 1]) cube(size = 1);"
        "multmatrix([[1, 0, 0, 3], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) cube(size = 2);\n");
  ASSERT_EQ(run({"two.csg", "-o", "a.3mf"}).exit_code, 0);
  const std::string file = read("a.3mf");
  const Result<ZipArchive> archive = ZipArchive::open(file);
  ASSERT_TRUE(archive);
  const ZipArchive::Entry* entry = archive->find("3D/3dmodel.model");
  ASSERT_NE(entry, nullptr);
  const std::string model = *archive->unpack(*entry, 100'000);
  EXPECT_NE(model.find("displaycolor=\"#FF0000FF\""), std::string::npos);
  size_t red = 0, plain = 0;
  for (size_t at = model.find(" p1="); at != std::string::npos; at = model.find(" p1=", at + 1))
    ++(model[at + 5] == '1' ? red : plain);
  EXPECT_EQ(red, 12u);
  EXPECT_EQ(plain, 12u);
}

class DrawingFiles : public ProgramTest {
 protected:
  void SetUp() override {
    write("flat.csg",
          "difference() { multmatrix([[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 0], [0, 0, 0, 1]])"
          "square(size = [10.5, 5.25], center = false);"
          "multmatrix([[1, 0, 0, 3], [0, 1, 0, 4], [0, 0, 1, 0], [0, 0, 0, 1]])"
          "circle(r = 1, $fn = 5); }\n");
  }
};

TEST_F(DrawingFiles, AreOpenscads) {
  ASSERT_EQ(run({"flat.csg", "-o", "a.svg", "-o", "a.DXF", "-o", "a.png"}).err, "");
  const std::string svg = read("a.svg");
  EXPECT_NE(svg.find("<svg width=\"11mm\" height=\"6mm\" viewBox=\"1 -8 11 6\" "),
            std::string::npos)
      << svg;
  EXPECT_NE(svg.find("1,-7.25"), std::string::npos);
  EXPECT_NE(read("a.DXF").find(" 10\n11.5\n 20\n7.25\n"), std::string::npos);
  EXPECT_EQ(run({"flat.csg", "-o", "-", "--export-format", "svg"}).out, svg);
}

TEST_F(DrawingFiles, ReadAgainAreTheSame) {
  ASSERT_EQ(run({"flat.csg", "-o", "a.dxf", "-o", "a.svg"}).err, "");
  ASSERT_EQ(run({"a.dxf", "-o", "b.svg"}).err, "");
  EXPECT_TRUE(read("a.svg") == read("b.svg")) << read("a.svg") << read("b.svg");
  // As OpenSCAD reads an SVG, it is in another place.
  ASSERT_EQ(run({"a.svg", "-o", "c.svg"}).err, "");
  EXPECT_NE(read("c.svg").find("<svg width=\"11mm\" height=\"6mm\" "), std::string::npos);
}

TEST_F(DrawingFiles, WhatIsNotFlatIsRefused) {
  write("cube.csg", "cube(size = 1);\n");
  write("none.csg",
        "intersection() { square(size = 1); }\n"
        "intersection() { square(size = 0); }\n");
  const Ended solid = run({"cube.csg", "-o", "a.dxf"});
  EXPECT_EQ(solid.exit_code, 1);
  EXPECT_EQ(solid.err, "cube.csg: error: the model is not flat, so it has no outlines\n");
  write("square.csg", "square(size = 1);\n");
  const Ended smooth = run({"square.csg", "-o", "a.dxf", "--curves", "smooth"});
  EXPECT_EQ(smooth.exit_code, 0) << smooth.err;
  write("disc.csg", "circle(r = 3);\n");
  const Ended disc = run({"disc.csg", "-o", "a.svg", "--curves", "smooth"});
  EXPECT_EQ(disc.exit_code, 1);
  EXPECT_EQ(disc.err,
            "disc.csg: error: there are true curves in it, which .svg and .dxf do not hold here "
            "(--curves smooth asks for them)\n");
}

TEST_F(DrawingFiles, ASummaryTellsOfTheDrawing) {
  const Ended done = run({"flat.csg", "-o", "a.svg", "--summary", "geometry", "--summary",
                          "bounding-box", "--summary-file", "-"});
  EXPECT_EQ(done.err.find("Top level object is a 2D object:\n   Contours:       2\n"), 0u)
      << done.err;
  const nlohmann::json json = nlohmann::json::parse(done.out);
  EXPECT_EQ(json["geometry"]["dimensions"], 2);
  EXPECT_EQ(json["geometry"]["contours"], 2);
  EXPECT_EQ(json["geometry"]["bounding_box"]["max"], nlohmann::json({11.5, 7.25, 0.0}));
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
            "a.stl: note: 8 triangles are too thin for the 32-bit floats of STL and left out; the "
            "mesh stays closed\n");
  write("hole.csg",
        "multmatrix([[1, 0, 0, 1000], [0, 1, 0, 1000], [0, 0, 1, 0], [0, 0, 0, 1]]) difference() {"
        "cube(size = [9, 9, 9], center = true); cube(size = [0.00001, 0.00001, 10], center = true);"
        "}");
  EXPECT_EQ(run({"hole.csg", "-o", "a.stl", "-o", "a.off"}).err,
            "a.stl: note: 16 triangles are too thin for the 32-bit floats of STL and left out; the "
            "mesh stays closed, but 1 hole through it is gone (the other formats have all "
            "digits)\n");
}

}  // namespace
}  // namespace whittle
