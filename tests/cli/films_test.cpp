// --turntable, --from, films and the names of their outputs.
#include <algorithm>
#include <string>
#include <vector>

#include "image/png.h"
#include "support/program.h"

namespace whittle {
namespace {

class Films : public ProgramTest {
 protected:
  void SetUp() override {
    write("part.csg",
          "difference() { cube(size = [8, 5, 3], center = true);\n"
          "  multmatrix([[1, 0, 0, 2], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])\n"
          "    cylinder(h = 9, r1 = 1, r2 = 1, center = true); }\n");
    write("flat.csg", "square(size = [3, 2], center = false);\n");
  }

  Ended draw(std::vector<std::string> more) const {
    std::vector<std::string> arguments{"part.csg", "--imgsize", "90,70"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
  void expect_done(const std::vector<std::string>& more) const {
    const Ended ended = draw(more);
    EXPECT_EQ(ended.exit_code, 0);
    EXPECT_EQ(ended.err, "");
  }
  void expect_refused(const std::vector<std::string>& more, const std::string& why) const {
    const std::vector<std::string> before = files();
    const Ended ended = draw(more);
    EXPECT_EQ(ended.exit_code, 2);
    EXPECT_TRUE(ended.err.starts_with("whittle: " + why)) << ended.err;
    EXPECT_EQ(files(), before);
  }
  Picture picture(const std::string& name) const {
    Result<Picture> read = read_png(path(name));
    EXPECT_TRUE(read) << name;
    return read ? *std::move(read) : Picture(1, 1);
  }
};

TEST_F(Films, FramesOfATurntableAreThePicturesOfThatCamera) {
  expect_done({"--camera", "0,0,0,60,0,30,40", "--turntable", "4", "-o", "{name}-{n}.png"});
  for (int k = 0; k < 4; ++k) {
    const std::string camera = "0,0,0,60,0," + std::to_string(30 + 90 * k) + ",40";
    expect_done({"--camera", camera, "-o", "single.png"});
    EXPECT_EQ(read("part-0000" + std::to_string(k) + ".png"), read("single.png")) << k;
  }
  EXPECT_NE(read("part-00000.png"), read("part-00001.png"));
}

TEST_F(Films, AllOfThePartIsInEveryFrame) {
  expect_done({"--turntable", "7", "--no-background", "--no-ground", "-o", "t.png"});
  int widest = 0;
  for (int k = 0; k < 7; ++k) {
    const Picture frame = picture("t0000" + std::to_string(k) + ".png");
    int first = frame.width, last = 0;
    for (int y = 0; y < frame.height; ++y) {
      for (int x = 0; x < frame.width; ++x) {
        if (frame.at(x, y)[3] == 0) continue;
        first = std::min(first, x), last = std::max(last, x);
        EXPECT_TRUE(x > 1 && y > 1 && x + 2 < frame.width && y + 2 < frame.height);
      }
    }
    widest = std::max(widest, last - first + 1);
  }
  EXPECT_GT(widest, 0.75 * 90) << "and it fills them";
}

TEST_F(Films, AFilmHasTheSameFrames) {
  expect_done(
      {"--turntable", "3", "--fps", "10", "-o", "film.apng", "-o", "film.gif", "-o", "f{n}.png"});
  // Who knows no animation sees the first frame of an APNG.
  EXPECT_EQ(picture("film.apng").rgba, picture("f00000.png").rgba);
  EXPECT_EQ(read("film.gif").substr(0, 6), "GIF89a");
  const std::string apng = read("film.apng");
  size_t controls = 0;
  for (size_t at = 0; (at = apng.find("fcTL", at)) != std::string::npos; ++at) ++controls;
  EXPECT_EQ(controls, 3u);
  EXPECT_EQ(draw({"--turntable", "3", "--fps", "10", "-o", "-", "--export-format", "apng"}).out,
            apng);
  EXPECT_EQ(draw({"--turntable", "3", "--fps", "10", "-o", "one.apng", "--threads", "1"}).exit_code,
            0);
  EXPECT_EQ(read("one.apng"), apng);
}

TEST_F(Films, VideosAreMadeByFfmpeg) {
  expect_done({"--turntable", "4", "-o", "film.mp4", "-o", "film.webm"});
  EXPECT_EQ(read("film.mp4").substr(4, 4), "ftyp");
  EXPECT_EQ(read("film.webm").substr(0, 4), "\x1a\x45\xdf\xa3");
  EXPECT_EQ(files().size(), 4u) << "nothing else is left";
}

TEST_F(Films, AnAnimationMakesThemToo) {
  write("moving.scad", "translate([4 * $t, 0, 0]) cube(1);\n");
  const Ended ended = run({"moving.scad", "--animate", "3", "-o", "a.apng", "-o", "a{n}.png",
                           "--imgsize", "40,30", "--camera", "2,0,0,90,0,0,20"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(picture("a.apng").rgba, picture("a00000.png").rgba);
  EXPECT_NE(read("a00001.png"), read("a00002.png"));
}

TEST_F(Films, NamedViewsLookFromThere) {
  const std::vector<std::string> ortho{"--projection", "ortho", "--style", "plain"};
  const auto drawn = [&](const std::string& option, const std::string& value,
                         std::vector<std::string> more) {
    more.insert(more.end(), ortho.begin(), ortho.end());
    more.insert(more.end(), {option, value, "-o", "x.png"});
    expect_done(more);
    return read("x.png");
  };
  EXPECT_EQ(drawn("--from", "front", {}),
            drawn("--camera", "0,0,0,90,0,0,9", {"--viewall", "--autocenter"}));
  EXPECT_EQ(drawn("--from", "bottom", {}),
            drawn("--camera", "0,0,0,180,0,0,9", {"--viewall", "--autocenter"}));
  expect_done({"--from", "iso", "-o", "{name}-{view}.png"});
  EXPECT_FALSE(read("part-iso.png").empty());
}

TEST_F(Films, WhatCannotBeIsRefused) {
  for (const char* count : {"0", "-1", "100000", "1e9", "nan", "x", ""})
    expect_refused({"--turntable", count, "-o", "x.png"}, "--turntable: ");
  for (const char* fps : {"0", "-5", "241", "1e300", "nan", "inf", "x"})
    expect_refused({"--turntable", "2", "--fps", fps, "-o", "x.gif"}, "--fps: ");
  expect_refused({"--turntable", "2", "--fps", "60", "-o", "x.gif"},
                 "--fps 60: a .gif shows at most 50 pictures a second");
  expect_refused({"--fps", "5", "-o", "x.png"}, "--fps is for --animate N and --turntable N");
  for (const char* film : {"x.gif", "x.apng", "x.mp4", "x.webm"})
    expect_refused({"-o", film}, std::string("-o ") + film + ": a film has frames");
  expect_refused({"--turntable", "2", "--no-background", "-o", "x.mp4"}, "--no-background: ");
  expect_refused({"--turntable", "2", "-o", "-", "--export-format", "webm"}, "-o -: ");
  expect_refused({"--turntable", "2", "-o", "-", "--export-format", "png"},
                 "--turntable makes many files; -o - is one");
  expect_refused({"--turntable", "2", "-o", "x.stl"}, "--turntable makes pictures");
  expect_refused({"--turntable", "2", "--reference", "x.png"}, "--reference is for one picture");
  expect_refused({"--turntable", "2", "-o", "{n}.gif"},
                 "-o '{n}.gif': {n} is the number of a frame");
  expect_refused({"--from", "front", "--camera", "0,0,0,0,0,0,9", "-o", "x.png"},
                 "--from and --camera each say where the eye is");
  expect_refused({"--from", "above", "-o", "x.png"}, "--from: unknown view 'above'");
}

}  // namespace
}  // namespace whittle
