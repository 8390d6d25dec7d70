#include "csg/syntax_tree.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "csg/argument_places.h"
#include "csg/test_support.h"

namespace whittle {
namespace {

using Form = SyntaxNode::Form;

SyntaxTree syntax_of(std::string_view text) {
  Result<SyntaxTree> tree = read_syntax(text, 0, "t.csg", {});
  if (!tree) {
    ADD_FAILURE() << tree.error().message;
    return {};
  }
  return std::move(*tree);
}

/// The tree as `difference(cube, #sphere)`, blocks as `{...}`, assignments as `x=`.
std::string outline(std::string_view text) {
  const SyntaxTree tree = syntax_of(text);
  std::string out;
  std::vector<uint32_t> ends;
  for (uint32_t i = 1; i < tree.nodes.size(); ++i) {
    for (; !ends.empty() && ends.back() <= i; ends.pop_back()) out += ')';
    if (!out.empty() && out.back() != '(') out += ' ';
    const SyntaxNode& node = tree.nodes[i];
    if (node.modifiers.disabled) out += '*';
    if (node.modifiers.root) out += '!';
    if (node.modifiers.highlight) out += '#';
    if (node.modifiers.background) out += '%';
    out += node.form == Form::kBlock ? "{}" : std::string(name_of(text, node));
    if (node.form == Form::kAssignment) out += '=';
    if (node.last == i + 1) continue;
    out += '(';
    ends.push_back(node.last);
  }
  return out + std::string(ends.size(), ')');
}

/// The texts of all nodes but the file.
std::vector<std::string> texts(std::string_view text) {
  std::vector<std::string> all;
  for (const SyntaxNode& node : syntax_of(text).nodes) {
    if (node.form != Form::kFile) all.emplace_back(text.substr(node.begin, node.end - node.begin));
  }
  return all;
}

TEST(SyntaxTree, HasEveryStatementWithItsChildren) {
  EXPECT_EQ(outline(""), "");
  EXPECT_EQ(outline(";;"), "");
  EXPECT_EQ(outline("sphere(1); cube(2);"), "sphere cube");
  EXPECT_EQ(outline("difference() { cube(1); translate([1, 2, 3]) #sphere(1); } cube(3);"),
            "difference(cube translate(#sphere)) cube");
  EXPECT_EQ(outline("a = 1; { cube(1); { } } $fn = 5;"), "a= {}(cube {}) $fn=");
  EXPECT_EQ(outline("group() { ; } union();"), "group union");
}

TEST(SyntaxTree, HasAlsoWhatTheModelLeavesOut) {
  EXPECT_EQ(outline("* ! group() { %cube(1); nobody(x = 2) { # sphere(1); } }"),
            "*!group(%cube nobody(#sphere))");
  EXPECT_EQ(outline("sphere(1) { cube(1); }"), "sphere(cube)");
}

TEST(SyntaxTree, NodesReachFromTheirFirstMarkToTheirLastByte) {
  EXPECT_EQ(texts("/* a */ # /* b */ cube(/*)*/1) /*;*/ ; // c\n x = [1]; "),
            (std::vector<std::string>{"# /* b */ cube(/*)*/1) /*;*/ ;", "x = [1];"}));
  EXPECT_EQ(texts("color(\"red\")\n  translate([1, 2, 3]) cube(1);{ sphere(1);}"),
            (std::vector<std::string>{"color(\"red\")\n  translate([1, 2, 3]) cube(1);",
                                      "translate([1, 2, 3]) cube(1);", "cube(1);", "{ sphere(1);}",
                                      "sphere(1);"}));
}

TEST(SyntaxTree, KnowsThePartsOfAStatement) {
  const std::string text = " *foo ( 1 ) /**/ { cube(); } x = 5 ;";
  const SyntaxTree tree = syntax_of(text);
  ASSERT_EQ(tree.nodes.size(), 4u);
  const SyntaxNode& foo = tree.nodes[1];
  EXPECT_EQ(foo.begin, 1u);
  EXPECT_EQ(foo.name, 2u);
  EXPECT_EQ(foo.arguments, text.find(" 1"));
  EXPECT_EQ(foo.body, text.find('{'));
  EXPECT_EQ(foo.inside(), (TextRange{text.find('{') + 1, text.find('}')}));
  const SyntaxNode& x = tree.nodes[3];
  EXPECT_EQ(text.substr(x.arguments, x.body - x.arguments), "5");
  EXPECT_EQ(tree.nodes[0].inside(), (TextRange{0, text.size()}));
  EXPECT_EQ(tree.child_count(0), 2u);
  EXPECT_EQ(tree.child_count(1), 1u);
  EXPECT_EQ(tree.innermost(text.find("cube")), 2u);
  EXPECT_EQ(tree.innermost(text.find('}')), 1u);
  EXPECT_EQ(tree.innermost(0), 0u);
}

TEST(SyntaxTree, MistakesAreTheReaders) {
  for (const char* text :
       {"cube(1)", "cube(1;", "}", "group() { cube();", "x = 1 + 2;", "for(i=1);",
        "translate([1]) x = 5;", "cube(1) \"a\";", "/* cube(1);", "cube(\"a);"}) {
    const Result<SyntaxTree> tree = read_syntax(text, 0, "t.csg", {});
    ASSERT_FALSE(tree) << text;
    EXPECT_EQ(tree.error().message, read_bad(text));
  }
}

TEST(SyntaxTree, DepthAndNumberAreLimited) {
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "union() ";
  deep += "cube();";
  EXPECT_EQ(syntax_of(deep).nodes.size(), 100002u);
  ReadLimits limits;
  limits.depth = 1000;
  EXPECT_FALSE(read_syntax(deep, 0, "t.csg", limits));
  limits = {};
  limits.nodes = 3;
  EXPECT_TRUE(read_syntax("cube(); { cube(); }", 0, "t.csg", limits));
  EXPECT_FALSE(read_syntax("cube(); { cube(); } a = 1;", 0, "t.csg", limits));
}

// The values of statements.

std::string values_of(std::string_view text) {
  const SyntaxTree tree = syntax_of(text);
  std::string out;
  for (const ArgumentPlace& place : argument_places(text, tree.nodes.at(1))) {
    const TextRange range = place.value.range;
    out += fmt::format("{}=<{}> ", place.name, text.substr(range.begin, range.size()));
  }
  return out;
}

TEST(ArgumentPlaces, AreThoseThatCountUnderTheirParametersNames) {
  EXPECT_EQ(values_of("sphere( 1.50 , $fn =5);"), "r=<1.50> $fn=<5> ");
  EXPECT_EQ(values_of("cylinder(r1 = 2, 10, 3);"), "r1=<2> h=<10> r2=<3> ");
  EXPECT_EQ(values_of("cube(size = [1, /* ] */ -2, [3]], /**/ center /**/ = /**/ true /**/);"),
            "size=<[1, /* ] */ -2, [3]]> center=<true> ");
  EXPECT_EQ(values_of("cube(size = 1, size = 2, wrong = 3);"), "size=<2> ");
  EXPECT_EQ(values_of("cube(a , center = b);"), "size=<a> center=<b> ");
  EXPECT_EQ(values_of("text(text = \"a\"b\", size = 5);"), "text=<\"a\"b\"> size=<5> ");
  EXPECT_EQ(values_of("nobody(1, a = 2, a = 3);"), "a=<3> ");
  EXPECT_EQ(values_of("width = - 5 ;"), "width=<- 5> ");
  EXPECT_EQ(values_of("{ cube(1); }"), "");
}

TEST(ArgumentPlaces, KnowWhatIsANumber) {
  const std::string text =
      "cylinder(h = -2.5, r1 = x, center = true, r2 = [1, \"]\", [2, 3], inf,]);";
  const SyntaxTree tree = syntax_of(text);
  const std::vector<ArgumentPlace> places = argument_places(text, tree.nodes.at(1));
  ASSERT_EQ(places.size(), 4u);
  EXPECT_EQ(places[0].value.kind, Value::Kind::kNumber);
  EXPECT_EQ(places[0].value.number, -2.5);
  EXPECT_EQ(places[1].value.kind, Value::Kind::kUndef);
  EXPECT_EQ(places[2].value.kind, Value::Kind::kBool);
  EXPECT_EQ(places[2].value.number, 1);
  const std::vector<ValuePlace> elements = element_places(text, places[3].value.range, 10);
  ASSERT_EQ(elements.size(), 4u);
  const TextRange inner = elements[2].range;
  EXPECT_EQ(text.substr(inner.begin, inner.size()), "[2, 3]");
  EXPECT_EQ(element_places(text, inner, 1).size(), 1u);
  EXPECT_TRUE(element_places(text, places[0].value.range, 10).empty());
}

TEST(ArgumentPlaces, AValueIsOneAndNothingElse) {
  for (const char* text : {"5", "-5e3", "[1, [2], \"a\"]", "true", "x", "\"a\"", "- 5"}) {
    EXPECT_TRUE(is_value(text)) << text;
  }
  for (const char* text : {"", " 5", "5 ", "5;", "5)", "1 + 2", "[1", "5//", "a = 5", "f(1)"}) {
    EXPECT_FALSE(is_value(text)) << text;
  }
}

TEST(ArgumentPlaces, TransformsAreReadAsWritten) {
  const auto map_of = [](std::string_view text) {
    return written_transform(text, syntax_of(text).nodes.at(1));
  };
  EXPECT_EQ(map_of("translate([1, 2]);"), translation({1, 2, 0}));
  EXPECT_EQ(map_of("multmatrix(m = [[1, 0, 0, 5], [0, 1, 0, 0], [0, 0, 1, 0]]);"),
            translation({5, 0, 0}));
  EXPECT_EQ(map_of("scale(2);"), scaling({2, 2, 2}));
  EXPECT_EQ(map_of("translate(v);"), std::nullopt);
  EXPECT_EQ(map_of("translate([x, 2, 3]);"), std::nullopt);
  EXPECT_EQ(map_of("cube(1);"), std::nullopt);
}

}  // namespace
}  // namespace whittle
