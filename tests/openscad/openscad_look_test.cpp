// `whittle --style openscad` beside `openscad --render`, given the same command line: the same
// picture to a level of 255, away from edges.
//
// What an edge is, whittle's own facts say: a pixel is compared if it and its eight neighbours see
// one face of one primitive (or all see nothing) in one colour. At edges each pixel of OpenSCAD's
// must be found in ours at most one pixel away.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>
#include <vector>

#include "base/folder_for_test.h"
#include "display.h"
#include "image/exr.h"
#include "image/png.h"

namespace whittle {
namespace {

struct Look {
  Picture theirs, ours;
  Frame facts;
};

/// Runs a command line of the shell; what it says is shown if it fails.
bool run(const std::string& command, const std::string& log) {
  if (std::system((command + " >'" + log + "' 2>&1 </dev/null").c_str()) == 0) return true;
  std::ifstream said(log);
  ADD_FAILURE() << command << "\n" << std::string((std::istreambuf_iterator<char>(said)), {});
  return false;
}

/// Both programs' pictures of a file. `options` are for both.
void look_at(const std::string& file, const std::string& options, Look& look) {
  static const Display display;
  ASSERT_FALSE(display.name().empty()) << WHITTLE_XVFB " did not start";
  const TestFolder folder;
  const std::string log = folder / "log", theirs = folder / "theirs.png",
                    ours = folder / "ours.png", facts = folder / "facts.exr";
  // The word after a bare --render would be its value.
  ASSERT_TRUE(run("HOME='" + (folder / "") + "' DISPLAY=" + display.name() +
                      " LIBGL_ALWAYS_SOFTWARE=1 timeout 120 '" WHITTLE_OPENSCAD
                      "' --render=force -o '" +
                      theirs + "' " + options + " '" + file + "'",
                  log));
  ASSERT_TRUE(run("'" WHITTLE_PROGRAM "' -q --style openscad -o '" + ours + "' -o '" + facts +
                      "' " + options + " '" + file + "'",
                  log));
  Result<Picture> their_picture = read_png(theirs), our_picture = read_png(ours);
  Result<Frame> frame = read_exr(facts);
  ASSERT_TRUE(their_picture) << their_picture.error().message;
  ASSERT_TRUE(our_picture) << our_picture.error().message;
  ASSERT_TRUE(frame) << frame.error().message;
  look = {std::move(*their_picture), std::move(*our_picture), std::move(*frame)};
}

/// The largest difference of a channel.
int difference(const uint8_t* a, const uint8_t* b) {
  return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

/// Calls visit(x, y) for the pixel and those of its eight neighbours that are in the picture.
template <class Visit>
void for_around(const Picture& picture, int x, int y, const Visit& visit) {
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, picture.height - 1); ++v)
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, picture.width - 1); ++u) visit(u, v);
}

bool is_edge(const Look& look, int x, int y) {
  const Hit& here = look.facts.at(x, y);
  bool edge = false;
  for_around(look.ours, x, y, [&](int u, int v) {
    const Hit& there = look.facts.at(u, v);
    const bool one_face =
        there.id == here.id &&
        (!here.hit() || dot(here.normal - there.normal, here.normal - there.normal) < 1e-8f);
    edge = edge || !one_face || difference(look.ours.at(x, y), look.ours.at(u, v)) > 2;
  });
  return edge;
}

struct Differences {
  size_t hits = 0;          ///< pixels where we see the solid
  size_t inner_hits = 0;    ///< of them, those compared
  size_t edges = 0;         ///< pixels not compared
  size_t wrong = 0;         ///< compared, and off by more than one level
  size_t unexplained = 0;   ///< at edges: nowhere around in ours
  int largest = 0;          ///< of all that are compared
  std::string first_wrong;  ///< place and values
};

Differences compare(const Look& look) {
  Differences d;
  for (int y = 0; y < look.ours.height; ++y) {
    for (int x = 0; x < look.ours.width; ++x) {
      const bool hit = look.facts.at(x, y).hit();
      const uint8_t* theirs = look.theirs.at(x, y);
      d.hits += hit;
      if (is_edge(look, x, y)) {
        ++d.edges;
        int least = 255;
        for_around(look.ours, x, y, [&](int u, int v) {
          least = std::min(least, difference(theirs, look.ours.at(u, v)));
        });
        d.unexplained += least > 1;
        continue;
      }
      d.inner_hits += hit;
      const uint8_t* ours = look.ours.at(x, y);
      const int off = difference(theirs, ours);
      d.largest = std::max(d.largest, off);
      if (off > 1 && d.wrong++ == 0) {
        char text[120];
        std::snprintf(text, sizeof text, "at (%d, %d): theirs %d %d %d, ours %d %d %d, id %u", x, y,
                      theirs[0], theirs[1], theirs[2], ours[0], ours[1], ours[2],
                      look.facts.at(x, y).id);
        d.first_wrong = text;
      }
    }
  }
  return d;
}

/// All that is asked of one picture.
void expect_the_same(const std::string& file, const std::string& options) {
  SCOPED_TRACE(file + " " + options);
  Look look;
  look_at(file, options, look);
  if (testing::Test::HasFatalFailure()) return;
  ASSERT_EQ(look.theirs.width, look.ours.width);
  ASSERT_EQ(look.theirs.height, look.ours.height);
  const Differences d = compare(look);
  const size_t pixels = look.facts.hits.size();
  std::printf(
      "%s %s: %zu of %zu hits compared, off by %d at most; %zu edge pixels, %zu of them "
      "unexplained\n",
      std::filesystem::path(file).filename().c_str(), options.c_str(), d.inner_hits, d.hits,
      d.largest, d.edges, d.unexplained);
  EXPECT_EQ(d.wrong, 0u) << d.first_wrong;
  EXPECT_GT(d.hits, pixels / 100) << "hardly anything is seen";
  EXPECT_GT(d.inner_hits, d.hits / 2) << "too little was compared";
  EXPECT_LT(d.edges, pixels / 8);
  // Slivers narrower than a pixel, at corners.
  EXPECT_LE(d.unexplained, d.edges / 500);
}

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

TEST(Openscad, ColorSchemes) {
  for (const char* scheme :
       {"Cornfield", "Metallic", "Sunset", "Starnight", "BeforeDawn", "Nature", "DeepOcean",
        "Solarized", "Tomorrow", "'Tomorrow Night'", "Monotone"}) {
    const std::string options = std::string("--imgsize=128,128 --colorscheme=") + scheme;
    expect_the_same(WHITTLE_MODELS "/flush_pocket.csg", options);
    expect_the_same(WHITTLE_MODELS "/cube.csg", options);
  }
}

}  // namespace
}  // namespace whittle
