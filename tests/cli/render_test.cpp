// whittle FILE -o OUT: what is in the pictures.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <tuple>

#include "image/exr.h"
#include "image/png.h"
#include "support/program.h"

namespace whittle {
namespace {

/// Names of an EXR's channels, in the order of its header.
std::vector<std::string> channel_names(const std::string& bytes) {
  // An attribute: name, type, both ended by a zero byte, its size in four bytes, its value. A
  // channel: its name, ended by a zero byte, and 16 bytes.
  const std::string mark("channels\0chlist\0", 16);
  size_t at = bytes.find(mark);
  if (at == std::string::npos) return {};
  at += mark.size() + 4;
  std::vector<std::string> names;
  while (at < bytes.size() && bytes[at] != '\0') {
    names.emplace_back(bytes.c_str() + at);
    at += names.back().size() + 1 + 16;
  }
  return names;
}

class Render : public ProgramTest {
 protected:
  void SetUp() override {
    write("part.csg",
          "difference() {\n"
          "  color([0.2, 0.4, 0.8, 1]) cube(20, center = true);\n"
          "  sphere(12);\n"
          "  multmatrix([[1,0,0,3],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) cylinder(h = 30, r = 4);\n"
          "}\n");
  }

  /// Runs and expects that it went well.
  Ended good(std::vector<std::string> arguments, const RunSettings& settings = {}) {
    Ended done = run(arguments, settings);
    EXPECT_EQ(done.exit_code, 0) << done.err;
    return done;
  }
  Picture png(const std::string& name) {
    Result<Picture> picture = read_png(path(name));
    EXPECT_TRUE(bool(picture)) << (picture ? "" : picture.error().message);
    return picture ? *picture : Picture(1, 1);
  }
  Frame exr(const std::string& name) {
    Result<Frame> frame = read_exr(path(name));
    EXPECT_TRUE(bool(frame)) << (frame ? "" : frame.error().message);
    return frame ? *frame : Frame(1, 1);
  }
};

TEST_F(Render, APngHasTheAskedSizeAndSaysNothing) {
  const Ended done = good({"part.csg", "-o", "x.png", "--imgsize", "60,40"});
  EXPECT_EQ(done.out, "");
  EXPECT_EQ(done.err, "");
  EXPECT_EQ(read("x.png").substr(0, 8), "\x89PNG\r\n\x1a\n");
  const Picture picture = png("x.png");
  EXPECT_EQ(picture.width, 60);
  EXPECT_EQ(picture.height, 40);
}

TEST_F(Render, ThePictureIs512SquareUnlessSaid) {
  good({"part.csg", "-o", "x.png"});
  const Picture picture = png("x.png");
  EXPECT_EQ(picture.width, 512);
  EXPECT_EQ(picture.height, 512);
}

TEST_F(Render, AllOutputsAreWrittenAndNothingElse) {
  good({"part.csg", "-o", "a.png", "-o", "b.exr", "-o", "c.PNG", "--imgsize", "16,16"});
  EXPECT_EQ(files(), (std::vector<std::string>{"a.png", "b.exr", "c.PNG", "part.csg"}));
  EXPECT_EQ(read("a.png"), read("c.PNG"));
}

TEST_F(Render, AnExrHasItsChannels) {
  good({"part.csg", "-o", "x.exr", "--imgsize", "16,16"});
  const std::vector<std::string> expected{"A", "B", "G", "N.X", "N.Y", "N.Z", "R", "Z", "id"};
  EXPECT_EQ(channel_names(read("x.exr")), expected);
}

TEST_F(Render, TheFactsAreThoseOfTheModel) {
  write("cube.csg", "cube(10, center = true);");
  good({"cube.csg", "-o", "x.exr", "--camera", "0,0,0,0,0,0,50", "--imgsize", "65,65"});
  const Frame frame = exr("x.exr");
  const Hit& middle = frame.at(32, 32);
  EXPECT_EQ(middle.id, 1u);
  EXPECT_FLOAT_EQ(middle.distance, 45);
  EXPECT_EQ(middle.normal, (Vec3f{0, 0, 1}));
  const Hit& corner = frame.at(0, 0);
  EXPECT_EQ(corner.id, 0u);
  EXPECT_TRUE(std::isinf(corner.distance));
}

TEST_F(Render, IdsCountStatementsThatAreEmptyDisabledOrBackground) {
  write("ids.csg",
        "cube(0); *sphere(1); %sphere(3); union() { *cube(2); } cube(10, center = true);");
  good({"ids.csg", "-o", "x.exr", "--imgsize", "33,33"});
  EXPECT_EQ(exr("x.exr").at(16, 16).id, 5u);
}

TEST_F(Render, StandardInputAndOutputCarryTheSameBytesAsFiles) {
  good({"part.csg", "-o", "x.png", "-o", "x.exr", "--imgsize", "40,30"});
  for (const char* format : {"png", "exr"}) {
    const Ended piped = good({"-", "-o", "-", "--export-format", format, "--imgsize", "40,30"},
                             {.in = read("part.csg")});
    EXPECT_TRUE(piped.out == read(std::string("x.") + format)) << format;
  }
}

TEST_F(Render, OneThreadAndManyMakeTheSameBytes) {
  good({"model", "cheese", "60", "-o", "cheese.csg"});
  for (const char* threads : {"1", "2", "7"}) {
    good({"cheese.csg", "-o", std::string("x") + threads + ".png", "-o",
          std::string("x") + threads + ".exr", "--threads", threads, "--imgsize", "200,150"});
  }
  for (const char* many : {"2", "7"}) {
    for (const char* ending : {".png", ".exr"}) {
      EXPECT_TRUE(read(std::string("x1") + ending) == read(std::string("x") + many + ending))
          << many << " threads, " << ending;
    }
  }
}

TEST_F(Render, NoSettingThatIsForSpeedChangesAFact) {
  good({"part.csg", "-o", "a.exr", "--imgsize", "96,96"});
  const std::vector<std::vector<std::string>> settings = {
      {"--leaf-size", "1"},
      {"--leaf-size", "40"},
      {"--split", "xyz"},
      {"--split", "octree"},
      {"--split", "cost"},
      {"--pixel-threshold", "8"},
      {"--backend", "oracle"},
      {"--paper", "--small-cells", "trace"},
      {"--pixel-threshold", "20", "--small-cells", "trace"}};
  for (std::vector<std::string> arguments : settings) {
    SCOPED_TRACE(arguments[0] + " " + arguments[1]);
    arguments.insert(arguments.begin(), {"part.csg", "-o", "b.exr", "--imgsize", "96,96"});
    good(arguments);
    const Ended compared = run({"compare", "a.exr", "b.exr"});
    EXPECT_EQ(compared.exit_code, 0) << compared.out;
  }
}

TEST_F(Render, SmallCellsAreIgnoredIfAskedFor) {
  good({"part.csg", "-o", "a.exr", "--imgsize", "96,96"});
  good({"part.csg", "-o", "b.exr", "--imgsize", "96,96", "--paper", "--pixel-threshold", "30"});
  EXPECT_EQ(run({"compare", "a.exr", "b.exr"}).exit_code, 1);
}

TEST_F(Render, BothSpellingsOfAnOptionAreOne) {
  good({"part.csg", "-o", "a.png", "--imgsize=48,32", "--camera=-5,0,0,55,0,25,100",
        "--projection=o", "--colorscheme=Sunset"});
  good({"-ob.png", "--imgsize", "48,32", "--camera", "-5,0,0,55,0,25,100", "--projection", "ortho",
        "--colorscheme", "sunset", "part.csg"});
  EXPECT_TRUE(read("a.png") == read("b.png"));
}

TEST_F(Render, StyleOpenscadHasOpenscadsVeryColours) {
  write("cube.csg", "cube(10);");
  good({"cube.csg", "-o", "x.png", "--style", "openscad"});
  const Picture picture = png("x.png");
  std::set<std::array<int, 3>> colors;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const uint8_t* p = picture.at(x, y);
      colors.insert({p[0], p[1], p[2]});
    }
  }
  // Measured from OpenSCAD's own picture: background, right, left, top; no antialiasing.
  const std::set<std::array<int, 3>> expected{
      {255, 255, 229}, {143, 123, 25}, {165, 143, 29}, {250, 216, 44}};
  EXPECT_EQ(colors, expected);
}

TEST_F(Render, EdgesAreSmoothedUnlessSwitchedOff) {
  write("plain.csg", "color([1, 1, 1]) cube(10);");
  const auto count_colors = [&](const std::string& aa) {
    good({"plain.csg", "-o", "x.png", "--aa", aa, "--no-background", "--no-ground", "--imgsize",
          "64,64"});
    const Picture picture = png("x.png");
    std::set<int> alphas;
    for (size_t i = 3; i < picture.rgba.size(); i += 4) alphas.insert(picture.rgba[i]);
    return alphas.size();
  };
  EXPECT_EQ(count_colors("1"), 2u) << "hit or not";
  EXPECT_GT(count_colors("4"), 4u);
  good({"plain.csg", "-o", "a.png", "--aa", "3", "--imgsize", "64,64"});
  good({"plain.csg", "-o", "b.png", "--imgsize", "64,64"});
  EXPECT_TRUE(read("a.png") == read("b.png")) << "3 is the default";
  good({"plain.csg", "-o", "a.png", "--aa", "2", "--quality", "draft", "--imgsize", "64,64"});
  good({"plain.csg", "-o", "b.png", "--quality", "draft", "--imgsize", "64,64"});
  EXPECT_TRUE(read("a.png") == read("b.png")) << "2 of a draft";
}

TEST_F(Render, PassesShowFacts) {
  write("cube.csg", "cube(10, center = true);");
  const std::vector<std::string> view{"cube.csg", "--camera", "0,0,0,0,0,0,50", "--imgsize",
                                      "33,33"};
  const auto middle_of = [&](const char* pass) {
    std::vector<std::string> arguments = view;
    arguments.insert(arguments.end(),
                     {"-o", "x.png", "--pass", pass, "--no-background", "--no-ground"});
    good(arguments);
    const Picture picture = png("x.png");
    EXPECT_EQ(picture.at(0, 0)[3], 0) << pass << ": background is transparent";
    const uint8_t* p = picture.at(16, 16);
    EXPECT_EQ(p[3], 255) << pass;
    return std::tuple<int, int, int>(p[0], p[1], p[2]);
  };
  EXPECT_EQ(middle_of("normal"), std::tuple(128, 128, 255)) << "up";
  const auto [r, g, b] = middle_of("depth");
  EXPECT_TRUE(r == g && g == b) << "grey";
  EXPECT_NE(middle_of("id"), middle_of("color"));
}

TEST_F(Render, TheBackgroundIsTheSchemes) {
  good({"part.csg", "-o", "x.png", "--style", "openscad", "--colorscheme", "Starnight", "--imgsize",
        "32,32"});
  const Picture picture = png("x.png");
  EXPECT_EQ(picture.at(0, 0)[0] + picture.at(0, 0)[1] + picture.at(0, 0)[2], 0);
}

TEST_F(Render, WhatIsNotSupportedIsShownWithoutButIsNoSuccess) {
  write("roof.csg", "cube(1);\nroof() {\n  square(10);\n}\n");
  const std::vector<std::string> command = {"roof.csg", "-o", "x.png", "--imgsize", "16,16"};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = command;
    arguments.insert(arguments.end(), more.begin(), more.end());
    std::filesystem::remove(path("x.png"));
    return run(arguments);
  };
  const std::string warning =
      "roof.csg:2:1: warning: roofs are not supported; nothing is shown for it\n";
  const std::string refusal =
      "roof.csg:2:1: error: roofs are not supported; so the picture is not what was meant "
      "(--lenient accepts that)\n";
  const Ended plain = with({});
  EXPECT_EQ(plain.exit_code, 1);
  EXPECT_EQ(plain.err, warning + refusal);
  EXPECT_EQ(png("x.png").width, 16) << "the picture is written";
  const Ended quiet = with({"-q"});
  EXPECT_EQ(quiet.exit_code, 1);
  EXPECT_EQ(quiet.err, refusal);
  const Ended lenient = with({"--lenient"});
  EXPECT_EQ(lenient.exit_code, 0);
  EXPECT_EQ(lenient.err, warning);
  EXPECT_EQ(with({"--lenient", "-q"}).err, "");
  const Ended strict = with({"--strict", "-q"});
  EXPECT_EQ(strict.exit_code, 1);
  EXPECT_EQ(strict.err, "roof.csg:2:1: error: roofs are not supported (--strict)\n");
  EXPECT_EQ(files(), (std::vector<std::string>{"part.csg", "roof.csg"}));
  EXPECT_EQ(run({"cells", "roof.csg", "-o", "x.png", "-q", "--imgsize", "16,16"}).err, refusal);
}

TEST_F(Render, StrictNamesWhatIsNotSupportedWhateverOtherWarningsSay) {
  write("roof.csg",
        "color(\"not supported\") cube(1);\ncube(1, 1, 1);\n  roof() square(1);\nroof();\n");
  const Ended strict = run({"roof.csg", "-o", "x.png", "--strict"});
  EXPECT_EQ(strict.exit_code, 1);
  EXPECT_EQ(strict.err, "roof.csg:3:3: error: roofs are not supported (--strict)\n");
}

TEST_F(Render, MistakesInTheFileHaveTheirPlace) {
  write("bad.csg", "cube(1);\nsphere(;\n");
  const Ended bad = run({"bad.csg", "-o", "x.png"});
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_EQ(bad.err.find("bad.csg:2:8: error: "), 0u) << bad.err;
  EXPECT_EQ(std::ranges::count(bad.err, '\n'), 1);
  const Ended absent = run({"absent.csg", "-o", "x.png"});
  EXPECT_EQ(absent.exit_code, 1);
  EXPECT_EQ(absent.err, "absent.csg: error: cannot be read: No such file or directory\n");
  EXPECT_EQ(files(), (std::vector<std::string>{"bad.csg", "part.csg"}));
}

TEST_F(Render, ACameraThatSeesNothingIsAWarning) {
  for (const char* camera : {"0,0,100,0,0,200", "0,0,-50,0,0,-50"}) {
    const Ended done = good({"part.csg", "-o", "x.png", "--imgsize", "8,8", "--camera", camera});
    EXPECT_EQ(done.err, "part.csg: warning: nothing is in view\n");
  }
  EXPECT_EQ(good({"part.csg", "-o", "x.png", "-q", "--camera", "0,0,99,0,0,100"}).err, "");
}

TEST_F(Render, WhatIsCutAwayToTheLastBitIsAnEmptySolid) {
  write("nothing.csg", "difference() { cube(1); cube(2); }");
  const Ended done = good({"nothing.csg", "-o", "x.png", "--imgsize", "8,8"});
  EXPECT_EQ(done.err, "nothing.csg: warning: the solid is empty\n");
}

TEST_F(Render, AnEmptySolidIsABackgroundAndAWarning) {
  write("empty.csg", "difference() { group(); cube(1); }");
  const Ended done = good({"empty.csg", "-o", "x.exr", "--imgsize", "8,8"});
  EXPECT_EQ(done.err, "empty.csg: warning: the solid is empty\n");
  const Frame frame = exr("x.exr");
  EXPECT_TRUE(std::ranges::none_of(frame.hits, [](const Hit& hit) { return hit.hit(); }));
}

TEST_F(Render, StatisticsTellWhatWasDone) {
  const Ended done = good({"part.csg", "-o", "x.png", "--stats", "--imgsize", "32,32"});
  EXPECT_EQ(done.out, "");
  for (const char* part : {"backend                cpu   (auto)\n",
                           "primitives               3   of 3 statements\n", "half-spaces", "cells",
                           "leaves", "rays", "disagreements            0\n", "time (ms)", "memory"})
    EXPECT_NE(done.err.find(part), std::string::npos) << part << "\n" << done.err;
  const Ended oracle =
      good({"part.csg", "-o", "x.png", "--stats", "--imgsize", "8,8", "--backend", "oracle"});
  EXPECT_NE(oracle.err.find("backend             oracle\n"), std::string::npos) << oracle.err;
}

TEST_F(Render, CurvesAreChosen) {
  write("ball.csg", "sphere(r = 10, $fn = 4);");
  const auto normals_of = [&](const char* curves, const char* file = "ball.csg",
                              const char* style = "studio") {
    good({file, "-o", "x.exr", "--curves", curves, "--style", style, "--imgsize", "64,64"});
    std::set<std::tuple<float, float, float>> normals;
    const Frame frame = exr("x.exr");
    for (const Hit& hit : frame.hits) {
      if (hit.hit()) normals.insert({hit.normal.x, hit.normal.y, hit.normal.z});
    }
    return normals.size();
  };
  EXPECT_LT(normals_of("auto"), 10u);
  EXPECT_LT(normals_of("facets"), 10u);
  EXPECT_GT(normals_of("smooth"), 100u);
  write("round.csg", "sphere(r = 1);");  // five meridians, by OpenSCAD's $fa and $fs
  EXPECT_GT(normals_of("auto", "round.csg"), 100u);
  EXPECT_LT(normals_of("auto", "round.csg", "openscad"), 20u);
  EXPECT_GT(normals_of("smooth", "round.csg", "openscad"), 100u);
  // From above, a pyramid's sides.
  write("sides.csg", "$vpr = [0, 0, 0]; cylinder(h = 5, r1 = 3, r2 = 0, $fn = 4.7);");
  EXPECT_EQ(normals_of("auto", "sides.csg"), 5u);
  EXPECT_EQ(normals_of("facets", "sides.csg"), 5u);
  EXPECT_EQ(normals_of("auto", "sides.csg", "openscad"), 4u);
  EXPECT_EQ(normals_of("facets", "sides.csg", "openscad"), 4u);
}

TEST_F(Render, ShadowsDarkenAndChangeNoFact) {
  write("shade.csg", "translate([0, 0, -1]) cube([40, 40, 1]); translate([20, 20, 10]) sphere(5);");
  const std::vector<std::string> view{"--style",  "blinn",     "--light",
                                      "60,20,80", "--imgsize", "64,64"};
  const auto draw = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"shade.csg", "-o", name};
    arguments.insert(arguments.end(), view.begin(), view.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    good(arguments);
  };
  draw("lit.png", {});
  draw("dark.png", {"--shadows"});
  draw("oracle.png", {"--shadows", "--backend", "oracle"});
  draw("lit.exr", {});
  draw("dark.exr", {"--shadows"});
  const Picture lit = png("lit.png"), dark = png("dark.png");
  size_t darker = 0;
  for (size_t i = 0; i < lit.rgba.size(); ++i) {
    EXPECT_LE(dark.rgba[i], lit.rgba[i]);
    darker += dark.rgba[i] + 20 < lit.rgba[i];
  }
  EXPECT_GT(darker, 200u);
  EXPECT_EQ(read("oracle.png"), read("dark.png"));
  EXPECT_EQ(run({"compare", "lit.exr", "dark.exr", "--distance", "0", "--normal", "0"}).exit_code,
            0);
  const Ended refused = run({"shade.csg", "-o", "x.png", "--shadows", "--style", "openscad"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("style openscad has no shadows"), std::string::npos) << refused.err;
}

}  // namespace
}  // namespace whittle
