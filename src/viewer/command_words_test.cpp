#include "viewer/command_words.h"

#include <gtest/gtest.h>

namespace whittle {
namespace {

using Words = std::vector<std::string>;

TEST(CommandWordsTest, WhatAWindowChangesIsNotKept) {
  const std::vector<const char*> arguments{
      "part.csg", "--camera", "0,0,0,1,2,3,4", "-D",        "x=1", "--style=plain",
      "--aa",     "2",        "--shadows",     "--imgsize", "1,1", "--strict"};
  const Words files{"part.csg"};
  EXPECT_EQ(kept_words(arguments, files), (Words{"-D", "x=1", "--aa", "2", "--strict"}));
}

TEST(CommandWordsTest, TheCommandSaysViewAndSize) {
  const OrbitView view{{1, 2.5, 0}, {55, 0, 25}, 140, kDefaultFovDegrees, false};
  EXPECT_EQ(command_text({}, "part.csg", view, {800, 600}, {}, "part.png"),
            "whittle part.csg --camera=1,2.5,0,55,0,25,140 --imgsize=800,600 -o part.png");
}

TEST(CommandWordsTest, WhatIsNotUsualIsSaid) {
  const OrbitView view{{0, 0, 0}, {0, 0, 0}, 10, 30, true};
  Look look;
  look.shading.style = Style::kPlain;
  look.shading.quality = Quality::kBest;
  look.shading.ground = false;
  look.shading.shadows = true;
  look.shading.scheme = find_color_scheme("Tomorrow Night");
  look.pass = Pass::kDepth;
  const Words kept{"-D", "name=\"it's\""};
  EXPECT_EQ(command_text(kept, "my part.scad", view, {8, 6}, look, "my part.png"),
            "whittle 'my part.scad' -D 'name=\"it'\\''s\"' --camera=0,0,0,0,0,0,10 --imgsize=8,6 "
            "--projection=ortho --fov=30 --style=plain --quality=best --no-ground --shadows "
            "'--colorscheme=Tomorrow Night' --pass=depth -o 'my part.png'");
}

TEST(CommandWordsTest, CellsAreDrawnByTheirCommand) {
  const OrbitView view{{0, 0, 0}, {0, 0, 0}, 10, kDefaultFovDegrees, false};
  Look look;
  look.cells = CellView::kFaces;
  EXPECT_EQ(command_text({}, "a.csg", view, {8, 6}, look, "a.png"),
            "whittle cells a.csg --camera=0,0,0,0,0,0,10 --imgsize=8,6 --style=studio --show=faces "
            "-o a.png");
}

}  // namespace
}  // namespace whittle
