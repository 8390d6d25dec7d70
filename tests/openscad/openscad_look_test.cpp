// `whittle --style openscad` beside `openscad --render`, given the same command line.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>

#include "look.h"

namespace whittle {
namespace {

struct File {
  const char* name;
};
std::ostream& operator<<(std::ostream& out, const File& file) {
  return out << file.name;
}
std::string test_name(const testing::TestParamInfo<File>& info) {
  std::string name = info.param.name;
  std::ranges::replace_if(
      name, [](char c) { return c == '.' || c == '-'; }, '_');
  return name;
}

class Models : public testing::TestWithParam<File> {};

TEST_P(Models, LookAsInOpenscad) {
  const std::string file = std::string(WHITTLE_MODELS "/") + GetParam().name;
  for (const char* options : {
           "--imgsize=256,256",
           "--imgsize=320,200 --projection=ortho --colorscheme=Sunset",
           "--imgsize=256,256 --camera=2,1,3,60,15,200,45 --viewall",
           "--imgsize=200,300 --camera=2,1,3,130,0,40,45 --viewall --autocenter --projection=o",
           "--imgsize=256,256 --camera=-30,50,20,1,2,3 --viewall --autocenter "
           "--colorscheme=Tomorrow",
           "--imgsize=300,256 --camera=40,-35,-30,1,2,3 --viewall",
       })
    expect_the_same(file, options);
}

INSTANTIATE_TEST_SUITE_P(
    Openscad, Models,
    testing::Values(File{"background.csg"}, File{"bracket.scad"}, File{"coincident_signs.csg"},
                    File{"coincident_walls.csg"}, File{"colors.csg"}, File{"cones.csg"},
                    File{"cube.csg"}, File{"cylinder.csg"}, File{"disabled.csg"},
                    File{"end_cut_off.csg"}, File{"flush_pocket.csg"}, File{"half_ball.csg"},
                    File{"highlight.csg"}, File{"intersection.csg"}, File{"menger1.csg"},
                    File{"mirrored.csg"}, File{"nested.csg"}, File{"polyhedron.csg"},
                    File{"ring.scad"}, File{"rotated.csg"}, File{"scaled.csg"}, File{"several.csg"},
                    File{"sheared.csg"}, File{"sphere.csg"}, File{"sphere_default.csg"},
                    File{"view_in_file.csg"}),
    test_name);

class Examples : public testing::TestWithParam<File> {};

TEST_P(Examples, LookAsInOpenscad) {
  expect_the_same(std::string(WHITTLE_EXAMPLES "/") + GetParam().name, "--imgsize=512,512");
}

// Those that OpenSCAD renders in a few seconds.
INSTANTIATE_TEST_SUITE_P(Openscad, Examples,
                         testing::Values(File{"lantern.csg"}, File{"r9.csg"}, File{"rook.csg"},
                                         File{"widget.csg"}),
                         test_name);

TEST(Openscad, FarFromTheOrigin) {
  for (const char* options :
       {"--imgsize=256,256", "--imgsize=256,256 --projection=ortho",
        "--imgsize=256,256 --camera=5000,-3000,1000,55,0,25,60",
        "--imgsize=256,256 --camera=5020,-2960,1030,5000,-3000,1000 --projection=ortho",
        "--imgsize=256,256 --camera=1,2,3,60,0,200,10 --viewall --autocenter"})
    expect_the_same(WHITTLE_MODELS "/far_away.csg", options);
}

TEST(Openscad, CamerasGivenToTheLastNumber) {
  const std::string file = WHITTLE_MODELS "/nested.csg";
  for (const char* options : {
           "--imgsize=256,256 --camera=0,0,0,55,0,25,90",
           "--imgsize=256,256 --camera=1,-2,3,0,0,0,70 --autocenter",
           "--imgsize=256,256 --camera=1,2,3,400,-70,33.5,80 --projection=ortho",
           "--imgsize=256,256 --camera=40,-50,60,0,0,0",
           "--imgsize=256,256 --camera=0,0,70,0,0,0",
           "--imgsize=256,256 --camera=0,0,-70,0,0,0 --projection=ortho",
           "--imgsize=256,256 --viewall",
           "--imgsize=256,256 --autocenter",
           "--imgsize=100,400",
       })
    expect_the_same(file, options);
}

TEST(Openscad, Drawings) {
  const std::string file = WHITTLE_MODELS "/drawing.csg";
  for (const char* options : {
           "--imgsize=256,256",
           "--imgsize=320,200 --projection=ortho",
           "--imgsize=256,256 --camera=2,1,3,60,15,200,45 --viewall",
           "--imgsize=200,300 --camera=2,1,3,130,0,40,45 --viewall --autocenter --projection=o",
           "--imgsize=256,256 --camera=-30,50,20,1,2,3 --viewall --autocenter",
           "--imgsize=256,256 --camera=0,0,0,0,0,0,90",
           "--imgsize=256,256 --camera=4,2,0,80,0,25,7",
       })
    expect_the_same_drawing(file, options);
}

TEST(Openscad, ColorSchemes) {
  for (const char* scheme :
       {"Cornfield", "Metallic", "Sunset", "Starnight", "BeforeDawn", "Nature", "DeepOcean",
        "Solarized", "Tomorrow", "'Tomorrow Night'", "Monotone"}) {
    const std::string options = std::string("--imgsize=128,128 --colorscheme=") + scheme;
    expect_the_same(WHITTLE_MODELS "/flush_pocket.csg", options);
    expect_the_same(WHITTLE_MODELS "/cube.csg", options);
    expect_the_same_drawing(WHITTLE_MODELS "/drawing.csg", options);
  }
}

}  // namespace
}  // namespace whittle
