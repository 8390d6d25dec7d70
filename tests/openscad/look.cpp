#include "look.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "base/folder_for_test.h"
#include "display.h"
#include "image/exr.h"
#include "image/png.h"

namespace whittle {
namespace {

std::string read_log(const std::string& path) {
  std::ifstream log(path);
  return {std::istreambuf_iterator<char>(log), {}};
}

/// Runs a command line of the shell; what it says is shown if it fails.
bool run(const std::string& command, const std::string& log) {
  if (std::system((command + " >'" + log + "' 2>&1 </dev/null").c_str()) == 0) return true;
  ADD_FAILURE() << command << "\n" << read_log(log);
  return false;
}

/// The start of OpenSCAD's command line.
std::string openscad(const std::string& home) {
  static const Display display;
  EXPECT_FALSE(display.name().empty()) << WHITTLE_XVFB " did not start";
  // The word after a bare --render would be its value.
  return "HOME='" + home + "' DISPLAY=" + display.name() +
         " LIBGL_ALWAYS_SOFTWARE=1 timeout 120 '" WHITTLE_OPENSCAD "' --render=force ";
}

/// whittle's picture and facts, by way of files in the folder.
void look_at_ours(const std::string& file, const std::string& options, const TestFolder& folder,
                  Look& look) {
  const std::string log = folder / "log", ours = folder / "ours.png", facts = folder / "facts.exr";
  ASSERT_TRUE(run("'" WHITTLE_PROGRAM "' -q --lenient --style openscad -o '" + ours + "' -o '" +
                      facts + "' " + options + " '" + file + "'",
                  log));
  Result<Picture> picture = read_png(ours);
  Result<Frame> frame = read_exr(facts);
  ASSERT_TRUE(picture) << picture.error().message;
  ASSERT_TRUE(frame) << frame.error().message;
  look.ours = std::move(*picture);
  look.facts = std::move(*frame);
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
  size_t pixels = 0;        ///< of the picture
  size_t hits = 0;          ///< pixels where we see the solid
  size_t inner_hits = 0;    ///< of them, those compared
  size_t edges = 0;         ///< pixels not compared
  size_t wrong = 0;         ///< compared, and off by more than one level
  size_t unequal = 0;       ///< at edges: another colour than ours
  size_t unexplained = 0;   ///< and nowhere around in ours
  int largest = 0;          ///< of all that are compared
  std::string first_wrong;  ///< place and values
};

Differences compare(const Look& look) {
  Differences d;
  d.pixels = look.facts.hits.size();
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
        d.unequal += difference(theirs, look.ours.at(x, y)) > 1;
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

}  // namespace

void look_at(const std::string& file, const std::string& options, Look& look) {
  const TestFolder folder;
  const std::string theirs = folder / "theirs.png";
  ASSERT_TRUE(run(openscad(folder / "") + "-o '" + theirs + "' " + options + " '" + file + "'",
                  folder / "log"));
  Result<Picture> picture = read_png(theirs);
  ASSERT_TRUE(picture) << picture.error().message;
  look.theirs = std::move(*picture);
  look_at_ours(file, options, folder, look);
}

void look_at_ours(const std::string& file, const std::string& options, Look& look) {
  const TestFolder folder;
  look_at_ours(file, options, folder, look);
}

size_t hits(const Frame& facts) {
  return static_cast<size_t>(std::ranges::count_if(facts.hits, &Hit::hit));
}

namespace {

/// Of both pictures, once they are made; what must hold of any.
Differences expect_alike(const std::string& file, const std::string& options) {
  Look look;
  look_at(file, options, look);
  if (testing::Test::HasFatalFailure()) return {};
  EXPECT_EQ(look.theirs.width, look.ours.width);
  EXPECT_EQ(look.theirs.height, look.ours.height);
  if (testing::Test::HasFailure()) return {};
  const Differences d = compare(look);
  std::printf(
      "%s %s: %zu of %zu hits compared, off by %d at most; %zu edge pixels, %zu of them not equal, "
      "%zu unexplained\n",
      std::filesystem::path(file).filename().c_str(), options.c_str(), d.inner_hits, d.hits,
      d.largest, d.edges, d.unequal, d.unexplained);
  EXPECT_EQ(d.wrong, 0u) << d.first_wrong;
  EXPECT_GT(d.hits, look.facts.hits.size() / 100) << "hardly anything is seen";
  return d;
}

}  // namespace

void expect_the_same(const std::string& file, const std::string& options) {
  SCOPED_TRACE(file + " " + options);
  const Differences d = expect_alike(file, options);
  EXPECT_GT(d.inner_hits, d.hits / 2) << "too little was compared";
  EXPECT_LT(d.edges, d.pixels / 8);
  // Slivers narrower than a pixel, at corners.
  EXPECT_LE(d.unexplained, d.edges / 500);
}

void expect_the_same_drawing(const std::string& file, const std::string& options) {
  SCOPED_TRACE(file + " " + options);
  const Differences d = expect_alike(file, options);
  // Where a corner lies so that the last bit of a float decides.
  EXPECT_LE(d.unequal, std::max<size_t>(3, d.edges / 200));
  EXPECT_LE(d.unexplained, d.edges / 500);
}

void expect_empty_to_openscad(const std::string& file) {
  const TestFolder folder;
  const std::string picture = folder / "theirs.png", log = folder / "log";
  // What its exit code says of an empty solid is not the same for every kind of file.
  const int code = std::system((openscad(folder / "") + "--imgsize=100,100 -o '" + picture + "' '" +
                                file + "' >'" + log + "' 2>&1 </dev/null")
                                   .c_str());
  const std::string said = read_log(log);
  EXPECT_NE(said.find("Geometries in cache"), std::string::npos) << said;
  if (code != 0) {
    EXPECT_NE(said.find("empty"), std::string::npos) << said;
    return;
  }
  const Result<Picture> theirs = read_png(picture);
  ASSERT_TRUE(theirs) << theirs.error().message;
  for (int y = 0; y < theirs->height; ++y)
    for (int x = 0; x < theirs->width; ++x)
      ASSERT_LE(difference(theirs->at(x, y), theirs->at(0, 0)), 1) << x << ", " << y;
}

}  // namespace whittle
