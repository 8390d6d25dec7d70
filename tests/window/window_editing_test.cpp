// The panel of statements: what is edited is seen, undone, and saved to the byte.
#include <string>

#include "window/driven_window.h"

namespace whittle {
namespace {

constexpr const char* kText =
    "// a part\n"
    "cube([20, 20, 10]);   // plate\n"
    "translate([30, 0, 0]) sphere(r = 6);\n";

// Where things are in the panel, pixels; rows and numbers are one below the other.
constexpr int kRowX = 110, kFirstRowY = 75, kRowHeight = 17;
constexpr int kHideX = 36, kCopyX = 130, kDeleteX = 306, kButtonsY = 235;
constexpr int kNumberX = 120, kFirstNumberY = 281;

class WindowEditingTest : public DrivenWindow {
 protected:
  void open_panel() {
    write("part.csg", kText);
    open({"part.csg", "--imgsize=500,400", "--camera=-20,10,5,0,0,0,200"});
    ASSERT_TRUE(comes_true([&] {
      key("ctrl+c");
      return !out().empty();
    }));
    const Picture before = shot();
    key("e");
    ASSERT_TRUE(comes_true([&] { return shot().rgba != before.rgba; }));
  }
  void move_to(int x, int y) const {
    hand("mousemove @ " + std::to_string(x) + " " + std::to_string(y));
  }
  void click(int x, int y) const {
    move_to(x, y);
    hand("click 1");
  }
  void choose(int row) const { click(kRowX, kFirstRowY + row * kRowHeight); }

  /// What is in the file after Ctrl+S, once it is what is expected; else what it is at last.
  std::string saved(const std::string& expected) {
    comes_true([&] {
      key("ctrl+s");
      return read("part.csg") == expected;
    });
    return read("part.csg");
  }
  static std::string with(const std::string& old_part, const std::string& new_part) {
    std::string text = kText;
    return text.replace(text.find(old_part), old_part.size(), new_part);
  }
};

TEST_F(WindowEditingTest, WhatIsHiddenAndUndoneIsSavedToTheByte) {
  open_panel();
  choose(0);
  click(kHideX, kButtonsY);
  EXPECT_EQ(saved(with("cube", "*cube")), with("cube", "*cube"));
  key("ctrl+z");
  EXPECT_EQ(saved(kText), kText);
  key("ctrl+shift+z");
  EXPECT_EQ(saved(with("cube", "*cube")), with("cube", "*cube"));
  EXPECT_EQ(quit(), 0);
  EXPECT_EQ(err(), "");
}

TEST_F(WindowEditingTest, ADragOfANumberIsOneStep) {
  open_panel();
  choose(2);
  const Picture before = shot();
  move_to(kNumberX, kFirstNumberY);
  hand("mousedown 1");
  for (int right = 20; right <= 80; right += 20) move_to(kNumberX + right, kFirstNumberY);
  hand("mouseup 1");
  ASSERT_TRUE(comes_true([&] { return shot().rgba != before.rgba; }));
  ASSERT_TRUE(comes_true([&] {
    key("ctrl+s");
    return read("part.csg") != kText;
  }));
  const std::string text = read("part.csg"), start = with("r = 6);\n", "r = ");
  ASSERT_TRUE(text.starts_with(start)) << text;
  EXPECT_GT(std::stod(text.substr(start.size())), 6);
  EXPECT_TRUE(text.ends_with(");\n")) << text;
  key("ctrl+z");
  EXPECT_EQ(saved(kText), kText);
}

TEST_F(WindowEditingTest, AClickChoosesWhatIsThere) {
  open_panel();
  click(400, 200);
  ASSERT_TRUE(comes_true([&] { return out().find("part.csg:2:1") != std::string::npos; }));
  click(kDeleteX, kButtonsY);
  const std::string without = with("cube([20, 20, 10]);", "");
  EXPECT_EQ(saved(without), without);
}

TEST_F(WindowEditingTest, CopiesStandBesideWhatTheyAreOf) {
  open_panel();
  choose(1);
  click(kCopyX, kButtonsY);
  const std::string line = "translate([30, 0, 0]) sphere(r = 6);\n";
  EXPECT_EQ(saved(kText + line), kText + line);
}

TEST_F(WindowEditingTest, AnotherEditorsChangesAreTaken) {
  open_panel();
  const Picture before = shot();
  write("part.csg", "/* new */ sphere(r = 9);\n");
  ASSERT_TRUE(comes_true([&] { return shot().rgba != before.rgba; }));
  choose(0);
  click(kHideX, kButtonsY);
  const std::string hidden = "/* new */ *sphere(r = 9);\n";
  EXPECT_EQ(saved(hidden), hidden);
}

}  // namespace
}  // namespace whittle
