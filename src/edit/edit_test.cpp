// What each way to edit writes, and what it refuses.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <numbers>
#include <string>

#include "edit/document_for_test.h"
#include "edit/marks.h"
#include "edit/parameters.h"
#include "edit/structure.h"
#include "edit/wraps.h"

namespace whittle {
namespace {

using Edit = std::function<Result<uint32_t>(SourceDocument&)>;

/// The text after an edit, which must have the right tree and be undone by one step; or why there
/// is no edit. `at`, if given, is told the text of the node that the edit returns.
std::string edited(std::string_view text, const Edit& edit, std::string* at = nullptr) {
  SourceDocument document = open_good(text);
  const Result<uint32_t> node = edit(document);
  if (!node) {
    EXPECT_EQ(document.text(), text);
    return node.error().message;
  }
  EXPECT_TRUE(has_right_tree(document));
  if (at) *at = text_at(document, *node);
  std::string after = document.text();
  document.undo();
  EXPECT_EQ(document.text(), text);
  EXPECT_TRUE(has_right_tree(document));
  EXPECT_FALSE(document.can_undo());
  document.redo();
  EXPECT_EQ(document.text(), after);
  return after;
}

Edit number(const char* name, NumberPlace place, double value) {
  return [=](SourceDocument& d) { return set_number(d, node_named(d, name), place, value); };
}

TEST(Edit, SetsNumbers) {
  EXPECT_EQ(edited("sphere($fn = 0, r = 1 /* r */);", number("sphere", {"r"}, 2.5)),
            "sphere($fn = 0, r = 2.5 /* r */);");
  EXPECT_EQ(edited("sphere(1);", number("sphere", {"r"}, -1e-7)), "sphere(-1e-07);");
  EXPECT_EQ(edited("sphere(1);", number("sphere", {"r"}, 0.1 + 0.2)),
            "sphere(0.30000000000000004);");
  EXPECT_EQ(edited("cube(size = [1, 2,\n 3 ]);", number("cube", {"size", {2}}, 4)),
            "cube(size = [1, 2,\n 4 ]);");
  EXPECT_EQ(edited("multmatrix([[1, 0, 0, 5], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) cube();",
                   number("multmatrix", {"m", {0, 3}}, 6)),
            "multmatrix([[1, 0, 0, 6], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) cube();");
  EXPECT_EQ(edited("$fn = 5; cube();", number("$fn", {"$fn"}, 50)), "$fn = 50; cube();");
  EXPECT_EQ(edited("sphere(r = x);", number("sphere", {"r"}, 5)), "sphere(r = 5);");
}

TEST(Edit, AddsNumbersThatAreNotGiven) {
  EXPECT_EQ(edited("sphere();", number("sphere", {"r"}, 3)), "sphere(r = 3);");
  EXPECT_EQ(edited("sphere( /* d */ $fn = 5);", number("sphere", {"r"}, 3)),
            "sphere(r = 3,  /* d */ $fn = 5);");
  EXPECT_EQ(edited("cylinder(10, 2);", number("cylinder", {"r2"}, 3)), "cylinder(r2 = 3, 10, 2);");
  EXPECT_EQ(edited("sphere(1);", number("sphere", {"$fn"}, 30)), "sphere($fn = 30, 1);");
}

TEST(Edit, OneNumberForThreeBecomesThree) {
  EXPECT_EQ(edited("cube(5);", number("cube", {"size", {1}}, 2)), "cube([5, 2, 5]);");
  EXPECT_EQ(edited("scale(2) cube();", number("scale", {"v", {0}}, 3)), "scale([3, 2, 2]) cube();");
  EXPECT_EQ(edited("sphere(5);", number("sphere", {"r", {0}}, 2)), "'r' has no element 0");
}

TEST(Edit, ANumberThatIsThereAlreadyIsLeftAsItIsWritten) {
  SourceDocument document = open_good("sphere(1.50);");
  ASSERT_TRUE(set_number(document, 1, {"r"}, 1.5));
  EXPECT_EQ(document.text(), "sphere(1.50);");
  EXPECT_FALSE(document.can_undo());
}

TEST(Edit, RefusesNumbersThatCannotBe) {
  EXPECT_EQ(edited("cube([1, 2]);", number("cube", {"size", {2}}, 2)), "'size' has no element 2");
  EXPECT_EQ(edited("cube();", number("cube", {"size", {2}}, 2)), "'size' is not given");
  EXPECT_EQ(edited("cube();", number("cube", {"r"}, 2)), "cube has no parameter 'r'");
  EXPECT_EQ(edited("cube();", number("cube", {"$a b"}, 2)), "cube has no parameter '$a b'");
  EXPECT_EQ(edited("x = 1;", number("x", {"y"}, 2)), "only statements have parameters");
  EXPECT_EQ(edited("cube();", number("cube", {"size"}, std::numeric_limits<double>::infinity())),
            "the number is not finite");
}

TEST(Edit, SetsValues) {
  const auto set = [](const char* name, const char* parameter, const char* value) -> Edit {
    return [=](SourceDocument& d) { return set_value(d, node_named(d, name), parameter, value); };
  };
  EXPECT_EQ(edited("cube(1);", set("cube", "center", "true")), "cube(center = true, 1);");
  EXPECT_EQ(edited("cube(1, center=false);", set("cube", "center", "true")),
            "cube(1, center=true);");
  EXPECT_EQ(edited("mine(a = 1);", set("mine", "b", "[1, \"x\"]")), "mine(b = [1, \"x\"], a = 1);");
  EXPECT_EQ(edited("cube(1);", set("cube", "size", "1)")), "'1)' is not a value");
  EXPECT_EQ(edited("cube(1);", set("cube", "size", "1 //")), "'1 //' is not a value");
}

TEST(Edit, ListsNumbersWithTheirPlaces) {
  const SourceDocument document =
      open_good("multmatrix([[1, 2], [x, 4]]) cylinder(h = 5, $fn = 6, center = true);");
  const std::vector<NumberValue> matrix = numbers_of(document, 1, 100);
  ASSERT_EQ(matrix.size(), 3u);
  EXPECT_EQ(matrix[2].value, 4);
  EXPECT_EQ(matrix[2].place.parameter, "m");
  EXPECT_EQ(matrix[2].place.indices, (std::vector<size_t>{1, 1}));
  const std::vector<NumberValue> cylinder = numbers_of(document, 2, 100);
  ASSERT_EQ(cylinder.size(), 2u);
  EXPECT_EQ(cylinder[1].place.parameter, "$fn");
  EXPECT_EQ(numbers_of(document, 1, 2).size(), 2u);
}

Edit mark(const char* name, Mark what, bool is_set) {
  return [=](SourceDocument& d) { return set_mark(d, node_named(d, name), what, is_set); };
}

TEST(Edit, HidesAndShows) {
  EXPECT_EQ(edited("group() { cube(1); }", mark("cube", Mark::kDisabled, true)),
            "group() { *cube(1); }");
  EXPECT_EQ(edited("#\tcube(1);", mark("cube", Mark::kDisabled, true)), "*#\tcube(1);");
  EXPECT_EQ(edited("* /* * */ # * cube(1);", mark("cube", Mark::kDisabled, false)),
            " /* * */ #  cube(1);");
  EXPECT_EQ(edited("x = 1;", mark("x", Mark::kDisabled, true)), "only statements can be marked");
}

TEST(Edit, OnlyOneStatementStandsAlone) {
  EXPECT_EQ(edited("!cube(1); group() { ! sphere(1); }", mark("group", Mark::kRoot, true)),
            "cube(1); !group() {  sphere(1); }");
  EXPECT_EQ(edited("!cube(1); !sphere(1);", mark("cube", Mark::kRoot, false)),
            "cube(1); !sphere(1);");
}

Edit remove(std::vector<const char*> names) {
  return [=](SourceDocument& d) {
    std::vector<uint32_t> nodes;
    for (const char* name : names) nodes.push_back(node_named(d, name));
    return remove_nodes(d, nodes);
  };
}

TEST(Edit, RemovesStatementsWithTheirLines) {
  EXPECT_EQ(edited("cube(1);\n  sphere(1);  \nunion();\n", remove({"sphere"})),
            "cube(1);\nunion();\n");
  EXPECT_EQ(edited("cube(1); sphere(1); // s\n", remove({"sphere"})), "cube(1);  // s\n");
  EXPECT_EQ(edited("cube(1);\r\nsphere(1);\r\n", remove({"cube"})), "sphere(1);\r\n");
  EXPECT_EQ(edited("group() {\n\tcube(1);\n\tsphere(1) {\n\t\tunion();\n\t}\n}",
                   remove({"union", "cube", "sphere"})),
            "group() {\n}");
  EXPECT_EQ(edited("{ cube(1); }", remove({"cube"})), "{  }");
}

TEST(Edit, WhatHasOnlyOneChildKeepsItsEnd) {
  EXPECT_EQ(edited("translate([1, 2, 3]) # cube(1); sphere(1);", remove({"cube"})),
            "translate([1, 2, 3]) ; sphere(1);");
}

Edit duplicate(const char* name) {
  return [=](SourceDocument& d) { return duplicate_node(d, node_named(d, name)); };
}

TEST(Edit, DuplicatesBehindTheStatement) {
  std::string copy;
  EXPECT_EQ(edited("group() {\n\t#cube(1);\n}\n", duplicate("cube"), &copy),
            "group() {\n\t#cube(1);\n\t#cube(1);\n}\n");
  EXPECT_EQ(copy, "#cube(1);");
  EXPECT_EQ(edited("cube(1); // c", duplicate("cube")), "cube(1); cube(1); // c");
  EXPECT_EQ(edited("color(\"red\") cube(1); sphere(1);", duplicate("cube"), &copy),
            "color(\"red\") { cube(1); cube(1); } sphere(1);");
  EXPECT_EQ(copy, "cube(1);");
  EXPECT_EQ(edited("cube(1);", duplicate("cube")), "cube(1);\ncube(1);");
}

Edit move(const char* name, const char* parent, size_t position) {
  return [=](SourceDocument& d) {
    const uint32_t to = *parent == '\0' ? 0 : node_named(d, parent);
    return move_node(d, node_named(d, name), to, position);
  };
}

TEST(Edit, MovesAmongSiblings) {
  const char* const text = "cube(1);\nsphere(2); // s\nunion();\n";
  std::string moved;
  EXPECT_EQ(edited(text, move("cube", "", 1), &moved), "sphere(2); // s\ncube(1);\nunion();\n");
  EXPECT_EQ(moved, "cube(1);");
  EXPECT_EQ(edited(text, move("cube", "", 5), &moved), "sphere(2); // s\nunion();\ncube(1);\n");
  EXPECT_EQ(moved, "cube(1);");
  EXPECT_EQ(edited(text, move("union", "", 0), &moved), "union();\ncube(1);\nsphere(2); // s\n");
  EXPECT_EQ(moved, "union();");
  EXPECT_EQ(edited("{a();b();c();}", move("c", "", 0)), "c();\n{a();b();}");
  for (const auto& [name, position] : {std::pair("cube", 0), {"sphere", 1}, {"union", 2}}) {
    SourceDocument document = open_good(text);
    ASSERT_TRUE(move_node(document, node_named(document, name), 0, size_t(position)));
    EXPECT_EQ(document.text(), text);
  }
}

TEST(Edit, MovesIntoOtherStatements) {
  std::string moved;
  EXPECT_EQ(edited("group();\ncube(1);\n", move("cube", "group", 0), &moved),
            "group(){ cube(1); }\n");
  EXPECT_EQ(moved, "cube(1);");
  EXPECT_EQ(edited("group() {}\ncube(1);\n", move("cube", "group", 0)), "group() { cube(1); }\n");
  EXPECT_EQ(edited("group() sphere(1);\ncube(1);\n", move("cube", "group", 0), &moved),
            "group() { cube(1); sphere(1); }\n");
  EXPECT_EQ(moved, "cube(1);");
  EXPECT_EQ(edited("group() sphere(1);\ncube(1);\n", move("cube", "group", 1)),
            "group() { sphere(1); cube(1); }\n");
  EXPECT_EQ(edited("group() { sphere(1); }\n", move("sphere", "", 0)),
            "sphere(1);\ngroup() {  }\n");
  EXPECT_EQ(edited("group() sphere(1);", move("sphere", "", 1)), "group() ;\nsphere(1);");
}

TEST(Edit, RefusesMovesThatCannotBe) {
  EXPECT_EQ(edited("group() { union(); }", move("group", "union", 0)),
            "a statement cannot be moved into itself");
  EXPECT_EQ(edited("cube(1); sphere(1);", move("cube", "sphere", 0)),
            "nothing can stand in this statement");
  EXPECT_EQ(edited("x = 1; group();", move("x", "group", 0)),
            "an assignment counts only where it stands");
}

Edit group(std::vector<const char*> names, const char* operation = "group") {
  return [=](SourceDocument& d) {
    std::vector<uint32_t> nodes;
    for (const char* name : names) nodes.push_back(node_named(d, name));
    return group_nodes(d, nodes, operation);
  };
}

TEST(Edit, GroupsSiblings) {
  std::string whole;
  EXPECT_EQ(
      edited("  cube(1); \n  // c\n  sphere(1);\n  union();\n", group({"cube", "sphere"}), &whole),
      "  group() {\n  cube(1); \n  // c\n  sphere(1);\n  }\n  union();\n");
  EXPECT_EQ(whole, "group() {\n  cube(1); \n  // c\n  sphere(1);\n  }");
  EXPECT_EQ(edited("cube(1); union(); sphere(1);", group({"sphere", "cube"}, "difference")),
            "difference() { cube(1); sphere(1); } union(); ");
  EXPECT_EQ(edited("color(\"red\") cube(1);", group({"cube"})),
            "color(\"red\") group() { cube(1); }");
  EXPECT_EQ(edited("x = 1; cube(1);", group({"x", "cube"})), "an assignment cannot be grouped");
  EXPECT_EQ(edited("union() { cube(1); } sphere(1);", group({"cube", "sphere"})),
            "what is to be grouped must stand in one statement");
  EXPECT_EQ(edited("cube(1);", group({"cube"}, "cube")), "'cube' is no operation");
}

Edit operation(const char* name, const char* wanted) {
  return [=](SourceDocument& d) { return change_operation(d, node_named(d, name), wanted); };
}

TEST(Edit, ChangesOperations) {
  EXPECT_EQ(edited("#union ( /**/ ) { cube(1); }", operation("union", "difference")),
            "#difference ( /**/ ) { cube(1); }");
  EXPECT_EQ(edited("render(convexity = 2) cube(1);", operation("render", "intersection")),
            "intersection() cube(1);");
  EXPECT_EQ(edited("hull($fn = 5) cube(1);", operation("hull", "minkowski")),
            "minkowski($fn = 5) cube(1);");
  EXPECT_EQ(edited("cube(1);", operation("cube", "union")), "only an operation can become another");
  EXPECT_EQ(edited("union();", operation("union", "mirror")), "'mirror' is no operation");
}

Edit paint(const char* name, PaintColor color) {
  return [=](SourceDocument& d) { return set_color(d, node_named(d, name), color); };
}

TEST(Edit, Paints) {
  std::string whole;
  EXPECT_EQ(edited("*#cube(1);", paint("cube", {1, 0.5, 0, 1}), &whole),
            "*#color([1, 0.5, 0, 1]) cube(1);");
  EXPECT_EQ(whole, "*#color([1, 0.5, 0, 1]) cube(1);");
  EXPECT_EQ(edited("color(\"red\") cube(1);", paint("cube", {0, 0, 1, 1})),
            "color([0, 0, 1, 1]) cube(1);");
  EXPECT_EQ(edited("color(alpha = 0.5, c = \"red\") { cube(1); sphere(1); }",
                   paint("color", {0, 0, 1, 0.25})),
            "color(alpha = 0.25, c = [0, 0, 1, 0.25]) { cube(1); sphere(1); }");
  EXPECT_EQ(edited("color(\"red\") { cube(1); sphere(1); }", paint("cube", {0, 0, 1, 1})),
            "color(\"red\") { color([0, 0, 1, 1]) cube(1); sphere(1); }");
  EXPECT_EQ(edited("cube(1);", paint("cube", {0, 0, 2, 1})),
            "a part of the colour is not from 0 to 1");
}

Edit transform(const char* name, const Affine& by) {
  return [=](SourceDocument& d) { return transform_node(d, node_named(d, name), by); };
}

TEST(Edit, MovesAndTurnsSolids) {
  const Affine moved = translation({1, 2, 0});
  const Affine turned{.row = {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}, .translation = {}};
  EXPECT_EQ(edited("%cube(1);", transform("cube", moved)),
            "%multmatrix([[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 0], [0, 0, 0, 1]]) cube(1);");
  EXPECT_EQ(edited("translate([1, /**/ 1, 1]) cube(1);", transform("translate", moved)),
            "translate([2, /**/ 3, 1]) cube(1);");
  EXPECT_EQ(edited("multmatrix([[1, 0, 0, 5],\n[0, 1, 0, 5],\n[0, 0, 1, 5]]) cube(1);",
                   transform("multmatrix", turned)),
            "multmatrix([[0, -1, 0, -5],\n[1, 0, 0, 5],\n[0, 0, 1, 5]]) cube(1);");
  // The one around the cube: it is moved along the axes that it has inside.
  EXPECT_EQ(edited("multmatrix([[0, -1, 0, 5], [1, 0, 0, 0], [0, 0, 1, 0]]) cube(1);",
                   transform("cube", moved)),
            "multmatrix([[0, -1, 0, 3], [1, 0, 0, 1], [0, 0, 1, 0]]) cube(1);");
  // What a name says is not known here.
  EXPECT_EQ(edited("translate(v) cube(1);", transform("translate", moved)),
            "multmatrix([[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 0], [0, 0, 0, 1]]) translate(v) "
            "cube(1);");
}

}  // namespace
}  // namespace whittle
