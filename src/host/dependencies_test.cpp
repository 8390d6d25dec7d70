#include "host/dependencies.h"

#include <gtest/gtest.h>

namespace whittle {
namespace {

using Names = std::vector<std::string>;

TEST(Dependencies, OpenscadsAreRead) {
  EXPECT_EQ(read_dependencies("o ut.csg: \\\n\t/a\\ b/h.dat \\\n\t/c$\\ #.scad \\\n\tmain.scad\n"),
            (Names{"/a b/h.dat", "/c$ #.scad", "main.scad"}));
  EXPECT_EQ(read_dependencies(""), Names{});
  EXPECT_EQ(read_dependencies("x:\n\t\n\t \\\n\ta\\\\b"), (Names{"a\\\\b"}));
}

TEST(Dependencies, NamesAreEscapedForMake) {
  const Names targets{"a b.png", "c.exr"}, files{"x$y#z.scad", "/p q/r"};
  EXPECT_EQ(write_dependencies(targets, files),
            "a\\ b.png c.exr: \\\n\tx$$y\\#z.scad \\\n\t/p\\ q/r\n");
  EXPECT_EQ(write_dependencies(targets, {}), "a\\ b.png c.exr:\n");
}

}  // namespace
}  // namespace whittle
