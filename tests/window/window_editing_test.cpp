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
constexpr int kHideX = 36, kCopyX = 130, kDeleteX = 306, kButtonsY = 335;
constexpr int kNumberX = 120, kFirstNumberY = 381;

class WindowEditingTest : public DrivenWindow {
 protected:
  void open_panel() {
    write("part.csg", kText);
    open({"part.csg", "--imgsize=800,600", "--camera=10,10,5,55,0,25,200"});
    ASSERT_TRUE(comes_true([&] {
      key("ctrl+c");
      return !out().empty();
    }));
    const Picture before = shot();
    key("e");
    ASSERT_TRUE(comes_true([&] { return shot().rgba != before.rgba; }));
  }
  void click(int x, int y) const {
    hand("mousemove @ " + std::to_string(x) + " " + std::to_string(y));
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
  drag(1, kNumberX, kFirstNumberY, 60, 0);
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
  key("7");
  click(400, 300);
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
  const std::string other = "/* new */ sphere(r = 9);\n";
  write("part.csg", other);
  ASSERT_TRUE(comes_true([&] {
    choose(0);
    click(kHideX, kButtonsY);
    key("ctrl+s");
    return read("part.csg").find('*', 3) != std::string::npos &&
           read("part.csg").find("*sphere") != std::string::npos;
  }));
  EXPECT_EQ(read("part.csg"), "/* new */ *sphere(r = 9);\n");
}

}  // namespace
}  // namespace whittle
