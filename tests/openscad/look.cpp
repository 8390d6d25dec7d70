#include "look.h"

#include <gtest/gtest.h>

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
  EXPECT_TRUE(d.same()) << d.wrong << " wrong, the first " << d.first_wrong;
  EXPECT_TRUE(d.enough_seen()) << "hardly anything is seen";
  return d;
}

}  // namespace

void expect_the_same(const std::string& file, const std::string& options) {
  SCOPED_TRACE(file + " " + options);
  EXPECT_TRUE(expect_alike(file, options).enough_compared()) << "too little was compared";
}

void expect_the_same_drawing(const std::string& file, const std::string& options) {
  SCOPED_TRACE(file + " " + options);
  const Differences d = expect_alike(file, options);
  EXPECT_TRUE(d.same_drawing()) << d.unequal << " of " << d.edges << " pixels at edges";
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
