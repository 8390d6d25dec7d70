// What evaluating may cost: files, facets, depth.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <random>
#include <utility>

#include <fmt/format.h>

#include "base/folder_for_test.h"
#include "base/limit_hint.h"
#include "evaluate/budget.h"
#include "evaluate/evaluate_test_support.h"
#include "host/named_files.h"

namespace whittle {
namespace {

namespace fs = std::filesystem;

class NamedFileTest : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& content) {
    fs::create_directories((folder_.path() / name).parent_path());
    std::ofstream(folder_.path() / name, std::ios::binary) << content;
  }
  ReadOptions options(const std::string& inside = "", std::optional<std::string> root = {},
                      size_t most_bytes = 1'000'000) {
    ReadOptions options;
    options.named_files =
        named_files((folder_.path() / inside).string(), std::move(root), most_bytes);
    return options;
  }

  const TestFolder folder_;
  const std::string tetrahedron_ =
      "OFF\n4 4 0\n0 0 0\n3 0 0\n0 3 0\n0 0 3\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
};

TEST_F(NamedFileTest, AreRelativeToTheFolder) {
  write("sub/part.off", tetrahedron_);
  const std::string solid =
      "polyhedron([[0,0,0],[3,0,0],[0,3,0],[0,0,3]], [[0,1,2],[0,3,1],[1,3,2],[2,3,0]]);";
  const Model known = evaluated(solid).model;
  const Read read = evaluated("import(file = \"sub/part.off\");", options());
  EXPECT_TRUE(read.warnings.empty());
  EXPECT_EQ(differing_points(read.model, known, {{0, 0, 0}, {3, 3, 3}}), 0);
  EXPECT_FALSE(bounds(evaluated("import(\"part.off\");", options("sub")).model).box.is_empty());
  EXPECT_TRUE(evaluated("hull() import(\"part.off\");", options("sub")).warnings.empty());
}

TEST_F(NamedFileTest, AMissingFileIsAWarningAndAnOperand) {
  const Read read = evaluated("difference() { import(\"none.stl\"); cube(); }", options());
  EXPECT_TRUE(bounds(read.model).box.is_empty());
  ASSERT_EQ(read.warnings.size(), 1u);
  EXPECT_EQ(read.warnings[0],
            "t.csg:1:16: warning: there is no file none.stl; nothing is shown for it");
  EXPECT_FALSE(read.unsupported);
}

TEST_F(NamedFileTest, WhatCannotBeReadIsSaid) {
  write("part.xyz", "what");
  write("part.off", "OFF\nwhat");
  write("part.obj", "what");
  write("part.stl", tetrahedron_);
  fs::create_directories(folder_.path() / "folder.stl");
  for (const char* name : {"part.xyz", "part.off", "part.obj", "folder.stl", ""}) {
    const Read read = evaluated("import(\"" + std::string(name) + "\"); cube();", options());
    EXPECT_EQ(read.warnings.size(), 1u) << name;
    EXPECT_TRUE(read.unsupported) << name;
  }
  const Read without = evaluated("import(\"part.stl\");");
  EXPECT_EQ(without.warnings[0],
            "t.csg:1:1: warning: part.stl: files are not read here; nothing is shown for it");
}

TEST_F(NamedFileTest, TheRootConfinesThem) {
  write("outside.off", tetrahedron_);
  write("root/inside.off", tetrahedron_);
  fs::create_symlink("../outside.off", folder_.path() / "root/link.off");
  const ReadOptions confined = options("root", (folder_.path() / "root").string());
  const auto is_read = [&](const std::string& name) {
    const Read read = evaluated("import(\"" + name + "\");", confined);
    return !bounds(read.model).box.is_empty();
  };
  EXPECT_TRUE(is_read("inside.off"));
  EXPECT_TRUE(is_read("../root/inside.off"));
  EXPECT_FALSE(is_read("../outside.off"));
  EXPECT_FALSE(is_read((folder_.path() / "outside.off").string()));
  EXPECT_FALSE(is_read("link.off"));
  // Nor does it say what there is outside.
  EXPECT_EQ(evaluated("import(\"../none.off\");", confined).warnings[0],
            "t.csg:1:1: warning: ../none.off: cannot be read: it lies outside the root of imports; "
            "nothing is shown for it");
}

TEST_F(NamedFileTest, BytesAreLimitedTogether) {
  write("a.off", tetrahedron_);
  write("b.off", tetrahedron_);
  const auto limited = [&](size_t most_bytes) { return options("", {}, most_bytes); };
  const size_t size = tetrahedron_.size();
  EXPECT_TRUE(evaluated("import(\"a.off\");", limited(size)).warnings.empty());
  EXPECT_TRUE(evaluated("import(\"a.off\");import(\"a.off\");", limited(size)).warnings.empty())
      << "read once";
  const Read read = evaluated("import(\"a.off\");import(\"b.off\");", limited(2 * size - 1));
  ASSERT_EQ(read.warnings.size(), 1u);
  EXPECT_NE(read.warnings[0].find(limit_hint("bytes")), std::string::npos);
}

TEST(EvaluationLimits, FacetsAreCountedBeforeTheyAreMade) {
  ReadOptions options;
  options.limits.facets = 1000;
  for (const char* text :
       {"linear_extrude(1) offset(1) circle(3, $fn = 1e9);",
        "linear_extrude(1) circle(3, $fn = 1500);", "linear_extrude(1, twist = 1e9) square(3);",
        "linear_extrude(1, twist = 9, slices = 1e9) square(3);",
        "linear_extrude(1, twist = 9, segments = 1e9) square(3);",
        "linear_extrude(1) offset(r = 1e9, $fn = 1e9) square(3);",
        "rotate_extrude($fn = 2000) offset(1) square(3);", "hull() sphere(3, $fn = 1000);",
        "minkowski() { sphere(3, $fn = 20); sphere(3, $fn = 20); sphere(3, $fn = 20); }",
        "linear_extrude(1) minkowski() { circle(3, $fn = 900); circle(3, $fn = 900); circle(3, $fn "
        "= "
        "900); }"}) {
    const std::string message = evaluation_error(text, options);
    EXPECT_TRUE(message.starts_with("t.csg:1:")) << text << ": " << message;
    EXPECT_NE(message.find(limit_hint("facets")), std::string::npos) << text;
  }
}

TEST(EvaluationLimits, TanglesAreRefusedBeforeTheyAreTakenApart) {
  const auto tangle = [](int corners) {
    std::string text = "polygon([";
    for (int i = 0; i < corners; ++i)
      text += fmt::format("{}[{}, {}]", i > 0 ? ", " : "", i * 7919 % 2003, i * 104'729 % 1009);
    return text + "]);";
  };
  EXPECT_EQ(evaluation_error("cube(); linear_extrude(1) " + tangle(2000), {}),
            "t.csg:1:27: error: flat shapes up to this one have too many lines across one "
            "another");
  evaluated("linear_extrude(1) " + tangle(50));
}

TEST(EvaluationLimits, TanglesAreCountedTogether) {
  std::minstd_rand random;
  Contour tangle;
  for (int i = 0; i < 700; ++i) tangle.push_back({double(random()), double(random())});
  Budget budget(1000);
  EXPECT_TRUE(budget.sweep(std::span(&tangle, 1)));
  EXPECT_FALSE(budget.is_spent());
  EXPECT_FALSE(budget.sweep(std::span(&tangle, 1)));
  EXPECT_TRUE(budget.is_spent());
}

constexpr int kDeep = 5000;

TEST(EvaluationLimits, DepthTakesNoStack) {
  const auto nested = [&](const std::string& outer, const std::string& inner, int deep = kDeep) {
    std::string text;
    for (int i = 0; i < deep; ++i) text += outer;
    return text + inner;
  };
  EXPECT_FALSE(bounds(evaluated(nested("hull() ", "cube(1);")).model).box.is_empty());
  EXPECT_FALSE(bounds(evaluated(nested("minkowski() ", "cube(1);")).model).box.is_empty());
  evaluated("linear_extrude(1) " + nested("offset(delta = 0.001) ", "square(1);"));
  evaluated(nested("linear_extrude(1) ", "square(1);"));
  evaluated(nested("minkowski() { cube(2); ", "cube(1);") + std::string(kDeep, '}'));
  const std::string cuts = nested("hull() { difference() { ", "cube(9);", 1000) +
                           nested("translate([1, 1, 1]) cube(9); } } ", "", 1000);
  const Model cut = evaluated(cuts).model;
  EXPECT_NEAR(bounds(cut).box.hi.x, 9, 1e-6);
  const std::string sums = nested("minkowski() { difference() { cube(2); cube(1); } ", "cube(1);") +
                           std::string(kDeep, '}');
  EXPECT_NE(evaluation_error(sums, with_boundaries()).find(limit_hint("facets")),
            std::string::npos);
  EXPECT_NE(
      evaluation_error(nested("resize([2, 0, 0]) ", "cube(1);"), {}).find(limit_hint("facets")),
      std::string::npos);
  evaluated("linear_extrude(1) " + nested("translate([0.001, 0]) offset(0) ", "square(1);"));
}

TEST(EvaluationLimits, AModelPassesThrough) {
  const std::string text =
      "cube(); difference() { sphere(); %cylinder(); } translate([1, 0, 0]) cube();";
  const Model model = evaluated(text).model;
  EXPECT_EQ(model.primitives.size(), 4u) << "with what is under %";
}

}  // namespace
}  // namespace whittle
