// The tree: grammar, modifiers, ids, what is simplified and what is not. Mistakes are in
// csg_mistakes_test.cpp, the meaning of arguments in csg_statements_test.cpp.
#include <gtest/gtest.h>

#include <string>

#include "csg/read_csg.h"
#include "csg/test_support.h"

namespace whittle {
namespace {

TEST(CsgReader, TheEmptyFileIsTheEmptyModel) {
  for (const char* text : {"", "\n", "// nothing", "\xef\xbb\xbf", ";"}) {
    const Read read = read_good(text);
    EXPECT_EQ(tree(read.model), "U()") << text;
    EXPECT_EQ(read.model.statement_count, 0u);
    EXPECT_TRUE(read.warnings.empty());
  }
}

TEST(CsgReader, StatementsOfAFileAreAUnion) {
  EXPECT_EQ(tree_of("cube();sphere();\ncylinder();halfspace();"), "U(c1 s2 y3 h4)");
}

TEST(CsgReader, ReadsTheFormOfADump) {
  EXPECT_EQ(
      tree_of("difference() {\n"
              "\tmultmatrix([[1, 0, 0, 8], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {\n"
              "\t\tcube(size = [24, 55, 28], center = false);\n"
              "\t}\n"
              "#\tcylinder($fn = 0, $fa = 12, $fs = 2, h = 1, r1 = 1, r2 = 2, center = true);\n"
              "%\tsphere($fn = 0, $fa = 12, $fs = 2, r = 1);\n"
              "\tintersection();\n"
              "}\n\n"),
      "U(D(T(c1) #y2 %s3 U()))");
}

TEST(CsgReader, ReadsOtherLineEndsAndAByteOrderMark) {
  EXPECT_EQ(tree_of("\xef\xbb\xbfunion() {\r\n\tcube();\r\n\tsphere();\r\n}\r\n"), "U(U(c1 s2))");
}

TEST(CsgReader, AChildNeedsNoBraces) {
  EXPECT_EQ(tree_of("translate([1,0,0]) color(\"red\") cube(); sphere();"), "U(T(P(c1)) s2)");
  EXPECT_EQ(tree_of("difference() { translate([1,0,0]) cube(); #mirror() sphere(); }"),
            "U(D(T(c1) #T(s2)))");
}

TEST(CsgReader, BracesAloneGroupNothing) {
  EXPECT_EQ(tree_of("{cube();}"), "U(c1)");
  EXPECT_EQ(tree_of("{} {{}} {cube(); {sphere();}} cylinder();"), "U(c1 s2 y3)");
  // OpenSCAD subtracts the sphere, too.
  EXPECT_EQ(tree_of("difference(){ {cube(); {sphere();}} cylinder(); }"), "U(D(c1 s2 y3))");
  EXPECT_EQ(tree_of("difference(){ {cube();} }"), "U(c1)");
  EXPECT_EQ(tree_of("translate([1,0,0]) {{cube();}{sphere();}}"), "U(T(c1 s2))");
  EXPECT_EQ(tree_of("*union(){ {cube();} } cube() {{sphere();}}"), "U(c2)");
  // Names in them are the file's; inside of a statement they are not.
  const Read named = read_good("{$fn = 7; x = 5;} cube(x); sphere();");
  EXPECT_TRUE(named.warnings.empty());
  EXPECT_EQ(std::get<Cube>(named.model.primitives[0].shape).size, (Vec3{5, 5, 5}));
  EXPECT_EQ(std::get<Sphere>(named.model.primitives[1].shape).facets, 7);
  EXPECT_TRUE(read_good("union(){{x = 5;} cube();}").unsupported);
}

TEST(CsgReader, NodesKnowTheirPlaces) {
  const Model model = read_good("union() {\n\t#cube();\n  sphere();}").model;
  ASSERT_EQ(tree(model), "U(U(#c1 s2))");
  EXPECT_EQ(model.nodes[1].where.line, 1u);
  EXPECT_EQ(model.nodes[1].where.column, 1u);
  EXPECT_EQ(model.nodes[2].where.line, 2u);
  EXPECT_EQ(model.nodes[2].where.column, 3u);
  EXPECT_EQ(model.nodes[3].where.line, 3u);
  EXPECT_EQ(model.nodes[3].where.column, 3u);
}

TEST(CsgReader, UnionsOfOneAreLeftOut) {
  EXPECT_EQ(tree_of("group(){group(){render(convexity=1){union(){cube();}}}}"), "U(c1)");
  EXPECT_EQ(tree_of("difference(){group(){cube();} group(){sphere();}}"), "U(D(c1 s2))");
  EXPECT_EQ(tree_of("difference(){cube();}"), "U(c1)");
  EXPECT_EQ(tree_of("intersection(){cube();}"), "U(c1)");
  EXPECT_EQ(tree_of("multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) cube();"), "U(c1)");
  EXPECT_EQ(tree_of("color([-1,-1,-1,-1]) cube();"), "U(c1)");
}

TEST(CsgReader, UnionsOfSeveralStay) {
  // Flattened, another operand could own a point where two surfaces coincide.
  EXPECT_EQ(tree_of("union(){union(){cube();sphere();} cube();}"), "U(U(U(c1 s2) c3))");
}

TEST(CsgReader, MarkedUnionsStay) {
  EXPECT_EQ(tree_of("#group(){cube();} %group(){cube();}"), "U(#U(c1) %U(c2))");
}

TEST(CsgReader, AnEmptyChildIsAnOperand) {
  EXPECT_EQ(tree_of("difference(){group(); cube(1);}"), "U(D(U() c1))");
  EXPECT_EQ(tree_of("difference(){group(){group(); group(){}} cube(1);}"), "U(D(U() c1))");
  EXPECT_EQ(tree_of("difference(){color([1,0,0,1]); cube(1);}"), "U(D(U() c1))");
  EXPECT_EQ(tree_of("difference(){hull(){} cube(1);}"), "U(D(U() c2))") << "hull counts";
  EXPECT_EQ(tree_of("difference(){cube([0,1,1]); cube(1);}"), "U(D(c1 c2))");
  EXPECT_EQ(tree_of("intersection(){group(); cube(1);}"), "U(I(U() c1))");
  EXPECT_EQ(tree_of("intersection(){translate([1,2,3]); cube(1);}"), "U(I(U() c1))");
  EXPECT_EQ(tree_of("intersection(){difference(); cube(1);}"), "U(I(U() c1))");
}

TEST(CsgReader, EmptyChildrenOfUnionsAreLeftOut) {
  const Model model =
      read_good("group(); translate([1,0,0]){group(); cube(); color(\"red\");}").model;
  EXPECT_EQ(tree(model), "U(T(c1))");
  EXPECT_EQ(model.transforms.size(), 1u);
  EXPECT_TRUE(model.colors.empty());
}

TEST(CsgReader, BackgroundIsNoOperand) {
  EXPECT_EQ(tree_of("difference(){%sphere(); cube(); cube();}"), "U(D(%s1 c2 c3))");
  EXPECT_EQ(tree_of("difference(){%sphere(); cube();}"), "U(%s1 c2)");
  EXPECT_EQ(tree_of("translate([1,0,0]){%sphere();}"), "U(T(%s1))");
  EXPECT_EQ(tree_of("difference(){group(){%sphere();} cube();}"), "U(D(U(%s1) c2))");
}

TEST(CsgReader, DisabledStatementsAreGoneButCount) {
  const Model model =
      read_good("*cube(); sphere(); *group(){cube(); translate([1,0,0]) cube();} cube();").model;
  EXPECT_EQ(tree(model), "U(s2 c5)");
  EXPECT_EQ(model.statement_count, 5u);
  EXPECT_EQ(tree_of("difference(){*cube(); sphere(); cube();}"), "U(D(s2 c3))");
  EXPECT_EQ(tree_of("translate([1,0,0]) *cube(); sphere();"), "U(s2)");
  EXPECT_EQ(tree_of("*#!%cube(); sphere();"), "U(s2)");
}

TEST(CsgReader, DisabledStatementsAreNotJudged) {
  const Read read = read_good("*polyhedron(points=[1],faces=[[9,9,9]]); *hull(){cube(foo=1);}");
  EXPECT_TRUE(read.warnings.empty());
  EXPECT_FALSE(read.unsupported);
  EXPECT_EQ(read.model.statement_count, 3u);
}

TEST(CsgReader, RootLeavesNothingElseNotEvenItsAncestors) {
  const Read read = read_good(
      "color(\"red\") cube(9);\n"
      "scale(3) { group() { !difference(){ cube(2); translate([1,0,0]) color(\"blue\") sphere(); } "
      "} }\n"
      "color(\"lime\") cube(3);");
  EXPECT_EQ(tree(read.model), "U(D(c2 T(P(s3))))");
  EXPECT_EQ(read.model.statement_count, 4u);
  ASSERT_EQ(read.model.transforms.size(), 1u);
  EXPECT_EQ(read.model.transforms[0], translation({1, 0, 0}));
  ASSERT_EQ(read.model.colors.size(), 1u);
  EXPECT_EQ(read.model.colors[0], (Rgba{0, 0, 1, 1}));
  ASSERT_EQ(read.model.primitives.size(), 2u);
  EXPECT_TRUE(read.warnings.empty());
}

TEST(CsgReader, TheFirstOfSeveralRootsCounts) {
  const Read read = read_good("group(){ !difference(){cube(); !sphere();} } !cube(3);");
  EXPECT_EQ(tree(read.model), "U(D(c1 s2))");
  ASSERT_EQ(read.warnings.size(), 2u);
  EXPECT_EQ(read.warnings[1],
            "t.csg:1:47: warning: '!' is given more than once; the first one counts");
}

TEST(CsgReader, ARootMayBeAnythingOrEmpty) {
  EXPECT_EQ(tree_of("cube(); !group(); sphere();"), "U(U())");
  EXPECT_EQ(tree_of("cube(); !group(){sphere();}"), "U(U(s2))");
  EXPECT_EQ(tree_of("group(){group(){!sphere();}} cube();"), "U(s1)");
  EXPECT_EQ(tree_of("difference(){cube(); !group(){union(){sphere();} group(){cube();cube();}}}"),
            "U(U(s2 U(c3 c4)))");
}

TEST(CsgReader, ChildrenOfAPrimitiveAreIgnoredButCount) {
  const Read read = read_good("cube() sphere(); sphere(){cube(); hull();} cube(){}");
  EXPECT_EQ(tree(read.model), "U(c1 s3 c6)");
  ASSERT_EQ(read.warnings.size(), 2u);
  EXPECT_EQ(read.warnings[0],
            "t.csg:1:8: warning: cube takes no children; they are ignored (is a ';' missing?)");
  EXPECT_EQ(read.warnings[1], "t.csg:1:26: warning: sphere takes no children; they are ignored");
}

TEST(CsgReader, WhatIsNotSupportedIsNamed) {
  const Read read = read_good("\ncube(); projection() cube();\n roof() square();");
  EXPECT_EQ(tree(read.model), "U(c1 U() U())");
  ASSERT_TRUE(read.unsupported);
  EXPECT_EQ(read.unsupported->message, "roofs are not supported");
  EXPECT_EQ(read.unsupported->where, (SourceLocation{3, 2}));
  ASSERT_EQ(read.warnings.size(), 2u);
  EXPECT_EQ(read.warnings[1],
            "t.csg:3:2: warning: roofs are not supported; nothing is shown for it");
}

TEST(CsgReader, WhatIsNotSupportedDoesNotCountInTheBackground) {
  for (const char* text : {"%roof() square(); cube();", "%group(){Cube() sphere(); x = 1;} cube();",
                           "%import(file = \"part.xyz\"); cube();",
                           "%group(){polyhedron([[0,0,0],[1,0,0],[0,1,0]],[[0,1,2]]);} cube();"}) {
    EXPECT_FALSE(read_good(text).unsupported) << text;
  }
}

TEST(CsgReader, AMisspeltNameIsNotCalledUnsupported) {
  const Read read = read_good("Cube(3) sphere();");
  EXPECT_EQ(tree(read.model), "U(s1)");
  ASSERT_TRUE(read.unsupported);
  ASSERT_EQ(read.warnings.size(), 1u);
  EXPECT_EQ(read.warnings[0],
            "t.csg:1:1: warning: 'Cube' is not known, shown as the union of its children");
}

TEST(CsgReader, ManyWarningsOfAKindAreSummedUp) {
  std::string text;
  for (int i = 0; i < 50; ++i) text += "roof() cube(foo = 1);\n";
  const Read read = read_good(text);
  ASSERT_EQ(read.warnings.size(), 42u);
  EXPECT_EQ(read.warnings[40],
            "t.csg: warning: 30 more times: cube: an argument is not known; it is ignored");
  EXPECT_EQ(read.warnings[41],
            "t.csg: warning: 30 more times: roofs are not supported; nothing is shown for it");
}

TEST(CsgReader, InventedNamesCannotFloodTheWarnings) {
  std::string text;
  for (int i = 0; i < 5000; ++i) text += "n" + std::to_string(i) + "();";
  EXPECT_LT(read_good(text).warnings.size(), 200u);
}

TEST(CsgReader, DumpedTextMayHoldQuotes) {
  const Read read = read_good(
      "text(text = \"A\"b\", size = 10, spacing = 1, font = \"\");\n"
      "text(text = \"C:\\\", size = 10);\ncube();");
  EXPECT_EQ(read.model.statement_count, 3u);
}

TEST(CsgReader, ReadsTheViewOfTheFile) {
  const FileView view =
      read_good("$vpt = [1, 2, -3];\n$vpr=[55,0,25];$vpd=140;$vpf = 22.5;\ncube();").model.view;
  EXPECT_EQ(view.target, (Vec3{1, 2, -3}));
  EXPECT_EQ(view.rotation_degrees, (Vec3{55, 0, 25}));
  EXPECT_EQ(view.distance, 140);
  EXPECT_EQ(view.fov_degrees, 22.5);
}

TEST(CsgReader, AFileWithoutAViewHasNone) {
  const Read read = read_good("$vpt = [1, 2]; $vpd = inf; cube();");
  EXPECT_FALSE(read.model.view.target || read.model.view.rotation_degrees ||
               read.model.view.distance || read.model.view.fov_degrees);
  EXPECT_EQ(read.warnings.size(), 2u);
}

TEST(CsgReader, AssignedNamesAreConstants) {
  const Model model = read_good(
                          "w = 4; v = [w, -w, +5]; b = true; translate(v) cube(w, b);"
                          "translate(-v) cube([w, w, 1]);")
                          .model;
  ASSERT_EQ(tree(model), "U(T(c1) T(c2))");
  EXPECT_EQ(model.transforms[0].translation, (Vec3{4, -4, 5}));
  EXPECT_EQ(model.transforms[1].translation, (Vec3{-4, 4, -5}));
  EXPECT_EQ(std::get<Cube>(model.primitives[0].shape).size, (Vec3{4, 4, 4}));
  EXPECT_TRUE(std::get<Cube>(model.primitives[0].shape).center);
}

TEST(CsgReader, ALateAssignmentIsReported) {
  // OpenSCAD gives the last value to every use.
  EXPECT_TRUE(read_good("x = 1; cube(x); x = 2;").unsupported);
  EXPECT_TRUE(read_good("cube(x); x = 2;").unsupported);
  EXPECT_FALSE(read_good("x = 1; x = 2; cube(x);").unsupported);
  EXPECT_TRUE(read_good("group(){ x = 1; cube(); }").unsupported);
}

TEST(CsgReader, ConstantsInsideConstantsCannotGrowWithoutEnd) {
  std::string text = "x0 = [1, 1];";
  for (int i = 1; i < 60; ++i) {
    const std::string last = "x" + std::to_string(i - 1);
    text += "x" + std::to_string(i) + " = [" + last + ", " + last + "];";
  }
  EXPECT_EQ(tree_of(text + "cube(x59);"), "U(c1)");
}

TEST(CsgReader, ReadsDeepNesting) {
  for (const int depth : {10'000, 200'000}) {
    std::string text;
    for (int i = 0; i < depth; ++i) text += "translate([1,0,0])";
    text += "cube();";
    const Model single = read_good(text).model;
    EXPECT_EQ(single.nodes.size(), depth + 2u);
    EXPECT_EQ(single.nodes[depth].end, depth + 2u);
  }
  constexpr int kDepth = 200'000;
  std::string text;
  for (int i = 0; i < kDepth; ++i) text += "difference(){cube();group(){";
  for (int i = 0; i < kDepth; ++i) text += "}}";
  EXPECT_EQ(read_good(text).model.statement_count, kDepth + 0u);
  EXPECT_EQ(tree_of(std::string(kDepth, '#') + "cube(" + std::string(kDepth, '[') +
                    std::string(kDepth, ']') + ");"),
            "U(#c1)");
}

TEST(CsgReader, ReadsManyOperands) {
  std::string text = "difference(){";
  for (int i = 0; i < 100'000; ++i) text += "cube();";
  const Model model = read_good(text + "}").model;
  EXPECT_EQ(model.nodes.size(), 100'002u);
  EXPECT_EQ(model.nodes[1].end, 100'002u);
  EXPECT_EQ(model.primitives.back().id, 100'000u);
}

}  // namespace
}  // namespace whittle
