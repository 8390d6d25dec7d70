// The window, as who sits before it meets it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "viewer/orbit_view.h"
#include "whittle/camera_text.h"
#include "window/driven_window.h"

namespace whittle {
namespace {

constexpr const char* kPart =
    "difference() {\n"
    "  cube([20, 20, 10]);\n"
    "  translate([10, 10, -1]) cylinder(h = 20, r = 6, $fn = 0);\n"
    "}\n";
constexpr const char* kOther =
    "union() { cube(15); translate([15, 0, 0]) sphere(r = 6, $fn = 0); }\n";

class WindowTest : public DrivenWindow {
 protected:
  void open_part(const std::vector<std::string>& more = {}) {
    write("part.csg", kPart);
    std::vector<std::string> words{"part.csg", "--imgsize=400,300"};
    words.insert(words.end(), more.begin(), more.end());
    open(words);
    // There is no camera before there is a picture.
    ASSERT_TRUE(comes_true([&] {
      key("ctrl+c");
      return !out().empty();
    }));
  }
  /// The camera, when the line that says it was copied has gone.
  std::string settled_camera() const {
    const std::string text = camera();
    expect_shown(of_camera(text));
    return text;
  }
  /// The point of the solid in the picture's pixel.
  Vec3 point_at(const std::string& camera_said, int x, int y) const {
    const std::string text =
        shell(fmt::format("{} pick part.csg --json --camera={} --imgsize={},{} --at {},{}",
                          WHITTLE_PROGRAM, camera_said, kWidth, kHeight, x, y));
    const auto json = nlohmann::json::parse(text);
    return {json["point"][0], json["point"][1], json["point"][2]};
  }
  static ViewOptions parsed(const std::string& text) { return *parse_camera(text); }
};

TEST_F(WindowTest, OpensWithTheCommandLinesPicture) {
  open_part();
  const std::string view = settled_camera();
  EXPECT_EQ(parsed(view).rotation_degrees, kDefaultRotationDegrees);
  EXPECT_EQ(quit(), 0);
  EXPECT_EQ(err(), "");
}

TEST_F(WindowTest, ACameraThatIsGivenIsShown) {
  open_part({"--camera=10,10,5,30,0,60,80", "--style", "plain", "--projection=o"});
  EXPECT_EQ(camera(), "10,10,5,30,0,60,80");
  expect_shown(of_camera("10,10,5,30,0,60,80", {"--style=plain", "--projection=o"}));
}

TEST_F(WindowTest, Orbits) {
  open_part();
  drag(1, 200, 150, 20, 10);
  EXPECT_EQ(parsed(settled_camera()).rotation_degrees, (Vec3{48, 0, 11}));
}

TEST_F(WindowTest, Pans) {
  open_part();
  const std::string before = camera();
  const Vec3 grabbed = point_at(before, 150, 160);
  drag(3, 150, 160, 40, -30);
  const std::string after = settled_camera();
  EXPECT_EQ(parsed(after).rotation_degrees, parsed(before).rotation_degrees);
  EXPECT_LT(length(point_at(after, 190, 130) - grabbed), 0.02);
}

TEST_F(WindowTest, ZoomsToTheCursor) {
  open_part();
  const std::string before = camera();
  const Vec3 pointed_at = point_at(before, 150, 160);
  hand("mousemove @ 150 160 click 4 click 4 click 4");
  const std::string after = settled_camera();
  EXPECT_NEAR(*parsed(after).distance, *parsed(before).distance * 0.729, 1e-3);
  EXPECT_LT(length(point_at(after, 150, 160) - pointed_at), 0.02);
}

TEST_F(WindowTest, KeysLookFromSides) {
  open_part();
  key("7");
  EXPECT_EQ(parsed(settled_camera()).rotation_degrees, (Vec3{0, 0, 0}));
  key("1");
  key("5");
  const std::string view = camera();
  EXPECT_EQ(parsed(view).rotation_degrees, (Vec3{90, 0, 0}));
  expect_shown(of_camera(view, {"--projection=ortho"}));
}

TEST_F(WindowTest, ADoubleClickSetsThePivot) {
  open_part();
  const Vec3 point = point_at(camera(), 150, 160);
  hand("mousemove @ 150 160 click 1 click 1");
  ASSERT_TRUE(comes_true([&] { return length(*parsed(camera()).target - point) < 0.05; }));
}

TEST_F(WindowTest, AClickSaysWhatIsThere) {
  open_part();
  const std::string view = camera();
  const Vec3 point = point_at(view, 150, 160);
  hand("mousemove @ 150 160 click 1");
  ASSERT_TRUE(comes_true([&] { return out().find("part.csg:2:3") != std::string::npos; }));
  const std::string line = out().substr(out().find("part.csg:2:3"));
  Vec3 said;
  ASSERT_EQ(std::sscanf(line.c_str(), "part.csg:2:3: %lf,%lf,%lf", &said.x, &said.y, &said.z), 3)
      << line;
  EXPECT_LT(length(said - point), 0.1);
  // The panel says it too, until it is told to forget.
  const Picture picture = of_camera(view);
  EXPECT_FALSE(std::ranges::equal(shot().rgba, picture.rgba));
  key("x");
  expect_shown(picture);
}

TEST_F(WindowTest, ReloadsWhatIsWrittenInPlace) {
  open_part();
  const std::string view = camera();
  write("part.csg", kOther);
  expect_shown(of_camera(view));
  EXPECT_EQ(camera(), view);
}

TEST_F(WindowTest, ReloadsWhatIsRenamedOver) {
  open_part();
  const std::string view = camera();
  write("part.csg~", kOther);
  std::filesystem::rename(path("part.csg~"), path("part.csg"));
  expect_shown(of_camera(view));
}

TEST_F(WindowTest, ShowsAnErrorOverTheLastPictureAndRecovers) {
  open_part();
  const std::string view = settled_camera();
  const Picture good = of_camera(view);
  write("part.csg", "cube(10);\ncube(10;\n");
  ASSERT_TRUE(comes_true([&] { return err().find("part.csg:2:8: error: ") != std::string::npos; }))
      << err();
  ASSERT_TRUE(comes_true([&] { return !std::ranges::equal(shot().rgba, good.rgba); }));
  // The words stand at the bottom; above them is the picture.
  const Picture seen = shot();
  const size_t half = seen.rgba.size() / 2;
  EXPECT_TRUE(
      std::equal(seen.rgba.begin(), seen.rgba.begin() + ptrdiff_t(half), good.rgba.begin()));
  write("part.csg", kPart);
  expect_shown(good);
}

TEST_F(WindowTest, AFileThatIsWrongFromTheStartIsShownWhenItIsRight) {
  write("part.csg", "cube(");
  open({"part.csg", "--imgsize=400,300"});
  ASSERT_TRUE(comes_true([&] { return err().find("part.csg:1:") != std::string::npos; }));
  write("part.csg", kPart);
  ASSERT_TRUE(comes_true([&] {
    key("ctrl+c");
    return !out().empty();
  }));
  settled_camera();
}

TEST_F(WindowTest, Resizes) {
  open_part();
  const std::string view = camera();
  resize(500, 350);
  expect_shown(command_line({"part.csg", "--camera=" + view, "--imgsize=500,350"}));
}

TEST_F(WindowTest, SavesWhatTheCommandLineWrites) {
  open_part();
  const std::string view = camera();
  of_camera(view);
  key("F12");
  ASSERT_TRUE(comes_true([&] { return err().find("saved part.png") != std::string::npos; }));
  EXPECT_EQ(read("part.png"), read("expected.png"));
  of_camera(view, {"--no-background"});
  key("ctrl+F12");
  ASSERT_TRUE(comes_true([&] { return err().find("saved part-2.png") != std::string::npos; }));
  EXPECT_EQ(read("part-2.png"), read("expected.png"));
}

TEST_F(WindowTest, SaysTheCommandThatMakesThePicture) {
  open_part({"--strict"});
  drag(1, 200, 150, 33, -8);
  key("s");
  key("l");
  key("5");
  const std::string command = answer_to("ctrl+shift+c");
  ASSERT_TRUE(command.starts_with("whittle part.csg --strict --camera=")) << command;
  shell(WHITTLE_PROGRAM + command.substr(command.find(' ')));
  key("F12");
  ASSERT_TRUE(comes_true([&] { return err().find("saved part-2.png") != std::string::npos; }))
      << err();
  EXPECT_EQ(read("part.png"), read("part-2.png"));
}

TEST_F(WindowTest, StylesKeepToTheCommandLine) {
  open_part();
  const std::string view = camera();
  for (const char* const style : {"plain", "blinn", "openscad"}) {
    key("s");
    expect_shown(of_camera(view, {std::string("--style=") + style}));
  }
}

TEST_F(WindowTest, TheHelpComesAndGoes) {
  open_part();
  const Picture picture = of_camera(settled_camera());
  key("h");
  ASSERT_TRUE(comes_true([&] { return !std::ranges::equal(shot().rgba, picture.rgba); }));
  key("h");
  expect_shown(picture);
}

TEST_F(WindowTest, ArrowsGoFromFileToFile) {
  write("other.csg", kOther);
  open_part({"other.csg"});
  const std::string first = camera();
  key("Right");
  // While it is read there is no camera.
  ASSERT_TRUE(comes_true([&] {
    key("ctrl+c");
    return !out().ends_with(first + "\n");
  }));
  const std::string second = camera();
  expect_shown(command_line({"other.csg", "--camera=" + second, "--imgsize=400,300"}));
  key("Left");
  expect_shown(of_camera(first));
}

TEST_F(WindowTest, ANewerSaveEndsOpenscad) {
  // It takes a minute for what is slow, and leaves a trace when it is done.
  write("fake",
        "#!/bin/sh\nfor last; do :; done\ncat \"$3\" >/dev/null\n"
        "while [ $# -gt 1 ]; do case $1 in -o) out=$2;; *.scad) in=$1;; esac; shift; done\n"
        "[ -n \"$in\" ] || in=$1\n"
        "if grep -q slow \"$in\"; then echo $$ >started; sleep 60; echo x >late; fi\ncp \"$in\" "
        "\"$out\"\n");
  std::filesystem::permissions(path("fake"), std::filesystem::perms::owner_all);
  write("part.scad", kPart);
  ::setenv("OPENSCAD", path("fake").c_str(), 1);
  open({"part.scad", "--imgsize=400,300"});
  ASSERT_TRUE(comes_true([&] {
    key("ctrl+c");
    return !out().empty();
  })) << err();
  const std::string view = camera();
  write("part.csg", kOther);
  const Picture expected = of_camera(view);
  write("part.scad", "// slow\n");
  ASSERT_TRUE(comes_true([&] { return !read("started").empty(); }));
  write("part.scad", kOther);
  expect_shown(expected);
  const pid_t slow = std::stoi(read("started"));
  EXPECT_TRUE(comes_true([&] { return ::kill(slow, 0) != 0; }));
  EXPECT_EQ(read("late"), "");
  ::unsetenv("OPENSCAD");
}

}  // namespace
}  // namespace whittle
