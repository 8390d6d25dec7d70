// What is wrong with a file is said in one line, with the place.
#include <gtest/gtest.h>

#include <cctype>
#include <string>
#include <utility>

#include "base/limit_hint.h"
#include "csg/read_csg.h"
#include "csg/test_support.h"

namespace whittle {
namespace {

TEST(CsgMistakes, AreNamedWithTheirPlaces) {
  const std::pair<std::string, std::string> cases[] = {
      {"cube(1;", "1:7: error: expected ',' or ')' before ';'"},
      {"cube(1", "1:7: error: expected ',' or ')' before the end of the file"},
      {"cube(1)", "1:8: error: expected ';', '{' or a statement before the end of the file"},
      {"cube(1)}", "1:8: error: expected ';', '{' or a statement before '}'"},
      {"cube 3;", "1:6: error: expected '(' after 'cube' before '3'"},
      {"cube([1,,2]);", "1:9: error: expected a value before ','"},
      {"cube([1 2]);", "1:9: error: expected ',' or ']' before '2'"},
      {"cube(size=);", "1:11: error: expected a value before ')'"},
      {"cube();\n\n  }", "3:3: error: no '{' is open for this '}'"},
      {"union() {\n cube();\n",
       "3:1: error: expected the '}' for the '{' of line 1, column 9 before the end of the file"},
      {"translate([1,0,0])",
       "1:19: error: expected ';', '{' or a statement before the end of the file"},
      {"translate([1,0,0]) #", "1:21: error: expected a statement before the end of the file"},
      {"translate([1,0,0]) x = 3;", "1:20: error: expected a statement, not an assignment"},
      {"%", "1:2: error: expected a statement before the end of the file"},
      {"\n(", "2:1: error: expected a statement before '('"},
      {"x = 3 + 4;",
       "1:7: error: expected ';' before '+' (values must be constants here; only a .scad file may "
       "have expressions)"},
      {"cube(\xe2\x80\x9c);", "1:6: error: expected a value before '\xe2\x80\x9c'"},
      {"cube(\xc3\x28);", "1:6: error: expected a value before the byte 0xc3"},
      {"cube(\xed\xa0\x80);", "1:6: error: expected a value before the byte 0xed"},
      {"cube(\xc2\x85);", "1:6: error: expected a value before the byte 0xc2"},
      {"cube(\xe2\x80", "1:6: error: expected a value before the byte 0xe2"},
      {"x = 3 cube();", "1:7: error: expected ';' before 'cube'"},
      {"cube(1); /* no end",
       "1:10: error: the comment is not closed: expected '*/' before the end "
       "of the file"},
      {"text(\"no end);",
       "1:6: error: the string is not closed: expected '\"' before the end of "
       "the file"},
      {"cube(1x);", "1:6: error: malformed number '1x'"},
      {"\x89PNG", "1:1: error: expected a statement before the byte 0x89"},
      {std::string("ab\nc\0", 5), "2:2: error: a NUL byte; this is not a text file"},
      {"\xff\xfe"
       "c",
       "1:1: error: the file is UTF-16 text; save it as UTF-8"},
      {"cube(1/2);",
       "1:7: error: expected ',' or ')' before '/' (values must be constants here; only "
       "a .scad file may have expressions)"},
      {"for (i = [0:3]) cube(i);",
       "1:1: error: 'for' is for OpenSCAD to evaluate; give the file a name that ends in .scad"},
      {"use <a.scad>",
       "1:1: error: 'use' is for OpenSCAD to evaluate; give the file a name that ends in .scad"},
      {" polyhedron(points = [1], faces = []);",
       "1:2: error: polyhedron: points[0] is not a vector of three numbers"},
      {"polyhedron(points = [[0,0,0]], faces = [[0, 0, 0], [0, 1, 0]]);",
       "1:1: error: polyhedron: faces[1] names point 1; there are 1 points, counted from 0"},
      {"polyhedron(points = [[0,0,0]], faces = [[0, 0, -1]]);",
       "1:1: error: polyhedron: faces[0] names point -1; there are 1 points, counted from 0"},
      {"polyhedron(points = [[0,0,0]], faces = [0]);",
       "1:1: error: polyhedron: faces[0] is not a vector"},
  };
  for (const auto& [text, expected] : cases) EXPECT_EQ(read_bad(text), "t.csg:" + expected) << text;
}

// A cube with one corner pushed to its middle.
constexpr std::string_view kDented =
    "polyhedron(points = [[0,0,0],[9,0,0],[9,9,0],[0,9,0],[0,0,9],[9,0,9],[5,5,5],[0,9,9]], faces "
    "= [[0,1,2,3],[4,5,1,0],[5,6,2],[5,2,1],[6,7,3],[6,3,2],[7,4,0,3],[4,7,6],[4,6,5]]);";
constexpr std::string_view kOpen =
    "polyhedron(points = [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], faces = [[0,1,2],[0,3,1],[1,3,2]]);";
/// A cube whose top is bent.
constexpr std::string_view kBent =
    "polyhedron(points = [[0,0,0],[9,0,0],[9,9,0],[0,9,0],[0,0,9],[9,0,9],[9,9,9.5],[0,9,9]], "
    "faces = [[0,1,2,3],[4,5,1,0],[7,6,5,4],[5,6,2,1],[6,7,3,2],[7,4,0,3]]);";

TEST(CsgMistakes, APolyhedronThatIsNotConvexIsAMesh) {
  const Read read = read_good("cube();" + std::string(kDented) + "sphere();");
  EXPECT_EQ(tree(read.model), "U(c1 m2 s3)");
  EXPECT_FALSE(is_empty(read.model.primitives[1].shape));
  EXPECT_TRUE(read.warnings.empty());
  EXPECT_FALSE(read.unsupported);
}

TEST(CsgMistakes, APolyhedronThatStaysOpenIsLeftOut) {
  const Read read = read_good("cube(); " + std::string(kOpen));
  EXPECT_EQ(tree(read.model), "U(c1 m2)");
  EXPECT_TRUE(is_empty(read.model.primitives[1].shape));
  ASSERT_EQ(read.warnings.size(), 1u);
  EXPECT_TRUE(read.warnings[0].starts_with(
      "t.csg:1:9: warning: polyhedron: 3 edges are open, the first at ["))
      << read.warnings[0];
  ASSERT_TRUE(read.unsupported);
  EXPECT_EQ(read.unsupported->where.column, 9u);
  // It is an operand all the same.
  EXPECT_EQ(tree(read_good("difference() { " + std::string(kOpen) + " cube(); }").model),
            "U(D(m1 c2))");
  // What is not drawn needs no word.
  EXPECT_TRUE(read_good("*" + std::string(kOpen) + "cube();").warnings.empty());
  EXPECT_TRUE(read_good("!cube();" + std::string(kOpen)).warnings.empty());
}

TEST(CsgMistakes, PolyhedraThatAreLeftOutAreCounted) {
  std::string text;
  for (int i = 0; i < 25; ++i) text += std::string(kOpen) + "\n";
  const Read read = read_good(text);
  ASSERT_EQ(read.warnings.size(), 21u);
  EXPECT_EQ(read.warnings[20], "t.csg: warning: 5 more times: a polyhedron is not closed");
}

TEST(CsgMistakes, APolyhedronWithABentFaceIsDrawnWithAWarning) {
  const Read read = read_good(kBent);
  EXPECT_FALSE(read.unsupported);
  EXPECT_FALSE(is_empty(read.model.primitives[0].shape));
  ASSERT_EQ(read.warnings.size(), 1u);
  EXPECT_TRUE(read.warnings[0].starts_with("t.csg:1:1: warning: polyhedron: face 2 is not flat: "))
      << read.warnings[0];
  EXPECT_TRUE(read.warnings[0].ends_with("; it is cut so that the solid is convex"));
}

TEST(CsgMistakes, TrianglesOfBentFacesCountAsFacets) {
  EXPECT_FALSE(is_empty(read_good(kBent, {.limits = {.facets = 7}}).model.primitives[0].shape));
  EXPECT_TRUE(read_bad(kBent, {.limits = {.facets = 6}})
                  .starts_with("t.csg:1:1: error: with this shape the model has 7 facets"));
}

TEST(CsgMistakes, BracesAloneArePaired) {
  EXPECT_EQ(read_bad("{cube();\n{"),
            "t.csg:2:2: error: expected the '}' for the '{' of line 2, column 1 before the end of "
            "the file");
  EXPECT_EQ(read_bad("{cube();}}"), "t.csg:1:10: error: no '{' is open for this '}'");
  EXPECT_EQ(read_bad("%{cube();}"), "t.csg:1:2: error: expected a statement before '{'");
}

TEST(CsgMistakes, LimitsAreNamed) {
  EXPECT_EQ(
      read_bad("{{{", {.limits = {.depth = 2}}),
      "t.csg:1:3: error: statements are nested deeper than the limit of 2" + limit_hint("depth"));
  EXPECT_EQ(
      read_bad("group(){group(){group(){}}}", {.limits = {.depth = 2}}),
      "t.csg:1:24: error: statements are nested deeper than the limit of 2" + limit_hint("depth"));
  EXPECT_EQ(tree(read_good("group(){group(){cube();}}", {.limits = {.depth = 2}}).model), "U(c1)");
  EXPECT_EQ(
      read_bad("cube();cube();cube();", {.limits = {.nodes = 2}}),
      "t.csg:1:15: error: there are more statements than the limit of 2" + limit_hint("nodes"));
  EXPECT_EQ(read_bad("cube();\ncube([1, 2, [3]]);", {.limits = {.values = 4}}),
            "t.csg:2:14: error: the statement has more values than the limit of 4" +
                limit_hint("values"));
  EXPECT_EQ(read_bad("v = [1, 2, 3]; cube([v, v]);", {.limits = {.values = 8}}),
            "t.csg:1:25: error: the statement has more values than the limit of 8" +
                limit_hint("values"));
  EXPECT_EQ(read_good("v = [1, 2, 3]; cube([v, v]);", {.limits = {.values = 9}}).warnings.size(),
            1u);
  EXPECT_EQ(
      read_bad("cylinder($fn=8);\nsphere($fn=4);", {.limits = {.facets = 15}}),
      "t.csg:2:1: error: with this shape the model has 16 facets, more than the limit of 15; a "
      "smaller $fn gives fewer, smooth curves none" +
          limit_hint("facets"));
  EXPECT_EQ(tree(read_good("cylinder($fn=8);sphere($fn=4);", {.limits = {.facets = 16}}).model),
            "U(y1 s2)");
}

TEST(CsgMistakes, TheDefaultLimitsLetAMillionLevelsPassAndNoMore) {
  const auto nested = [](int depth) {
    std::string text;
    for (int i = 0; i < depth; ++i) text += "group()";
    return text + "cube();";
  };
  EXPECT_EQ(tree_of(nested(1'000'000)), "U(c1)");
  EXPECT_EQ(read_bad(nested(1'000'001)),
            "t.csg:1:7000008: error: statements are nested deeper than the limit of 1000000" +
                limit_hint("depth"));
}

// A file with some of everything.
constexpr std::string_view kSample =
    "$vpd = 140; /* c */ x = [1, 2.5e-3, -.5]; // d\n"
    "%difference() { #translate(x) cube([1, 2, 3], center = true);\n"
    " multmatrix([[1, 0, 0, 8], [0, 1, 0, 0], [0, 0, 1, 0]]) { sphere(d = 0x1F, $fn = 5); group(); "
    "}\n"
    " *cylinder(h = 1, r1 = inf, r2 = -nan); !color(\"red\", 0.5) halfspace(n = [0, 0, 1], d = 1); "
    "}\n"
    "text(text = \"A\"b\", size = 1); hull() { polyhedron(points = "
    "[[0,0,0],[1,0,0],[0,1,0],[0,0,1]], "
    "faces = [[0,1,2],[0,3,1],[1,3,2],[2,3,0]]); }\n";

TEST(CsgMistakes, ATextCutOffAnywhereIsReadOrRefusedWithAPlace) {
  EXPECT_EQ(tree_of(kSample), "U(P(h4))");
  for (size_t size = 0; size < kSample.size(); ++size) {
    const std::string_view text = kSample.substr(0, size);
    const Result<Read> read = read_csg(text, "t.csg");
    if (read) continue;
    const std::string& message = read.error().message;
    ASSERT_TRUE(message.starts_with("t.csg:")) << message;
    ASSERT_TRUE(std::isdigit(message[6])) << message;
    ASSERT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace whittle
