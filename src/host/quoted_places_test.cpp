#include "host/quoted_places.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>

namespace whittle {
namespace {

TEST(QuotedPlaces, APlaceBecomesTheStatementThatStandsThere) {
  const std::string text =
      "group() {\n"
      "\tlinear_extrude(height = 3, center = false) {\n"
      "\t\tsquare(size = [1, 1]);\n"
      "\t}\n}\ncube(1); sphere(2);\n";
  QuotedPlaces quoted(text, "a.scad");
  EXPECT_EQ(quoted("a.scad:2:2: warning: odd"),
            "a.scad: warning: in \"linear_extrude(height = 3, center = false)\": odd");
  // Within a statement, and the second on its line.
  EXPECT_EQ(quoted("a.scad:3:10: error: so: odd"),
            "a.scad: error: in \"square(size = [1, 1])\": so: odd");
  EXPECT_EQ(quoted("a.scad:6:10: warning: odd"), "a.scad: warning: in \"sphere(2)\": odd");
}

TEST(QuotedPlaces, WhatIsNoPlaceInThatFileStays) {
  QuotedPlaces quoted("cube();\n", "a.scad");
  for (const char* message :
       {"", "a.scad", "a.scad:1: error: openscad: odd", "a.scad: warning: odd",
        "b.scad:1:1: warning: odd", "a.scad:1:x: warning: odd", "a.scad:1:1:odd",
        "a.scad:99999999999999999999:1: warning: odd", "a.scad:1:1: odd"}) {
    EXPECT_EQ(quoted(message), message);
  }
  // A place that is not there has no statement.
  for (const char* place : {"0:0", "1:0", "9:1", "2:1", "1:99"}) {
    EXPECT_EQ(quoted(std::string("a.scad:") + place + ": warning: odd").find("a.scad: warning: "),
              0u);
  }
  QuotedPlaces empty("", "a.scad");
  EXPECT_EQ(empty("a.scad:1:1: warning: odd"), "a.scad: warning: odd");
}

TEST(QuotedPlaces, LongStatementsAreCut) {
  EXPECT_EQ(quote_statement("linear_extrude(height = 3, center = false, convexity = 10, $fn = 0, "
                            "$fa = 12, $fs = 2) {",
                            0),
            "linear_extrude(height = 3, center = false, ...)");
  const std::string name(200, 'x');
  EXPECT_EQ(quote_statement("import(\"" + name + "\");", 0),
            "import(\"" + name.substr(0, 49) + "...");
  // A character of several bytes is not cut into.
  for (size_t length = 40; length < 57; ++length) {
    std::string text(length, 'x');
    for (int i = 0; i < 20; ++i) text += "\xe2\x82\xac";
    const std::string cut = quote_statement(text, 0);
    EXPECT_LE(cut.size(), 60u);
    EXPECT_EQ((cut.size() - 3 - length) % 3, 0u) << length;
  }
}

TEST(QuotedPlaces, StringsAndBlanksAreUnderstood) {
  EXPECT_EQ(quote_statement("text(text = \"a; b) \\\" {\", size = 3);", 0),
            "text(text = \"a; b) \\\" {\", size = 3)");
  EXPECT_EQ(quote_statement("\n\t cube(\n  1\n) ;", 0), "cube( 1 )");
  EXPECT_EQ(quote_statement("cube", 0), "cube");
  EXPECT_EQ(quote_statement("cube();", 100), "");
  EXPECT_EQ(quote_statement("text(\"abc\\", 0), "text(\"abc\\");
  EXPECT_EQ(quote_statement("group() cube();", 0), "group()");
}

TEST(QuotedPlaces, APlaceCanBeLeftOut) {
  EXPECT_EQ(without_place("a b.stl:1:1: warning: odd", "a b.stl"), "a b.stl: warning: odd");
  EXPECT_EQ(without_place("other:1:1: warning: odd", "a b.stl"), "other:1:1: warning: odd");
}

RC_GTEST_PROP(QuotedPlaces, AnyPlaceInAnyTextHasAMessage, (const std::string& text)) {
  const auto line = *rc::gen::inRange(0, 5), column = *rc::gen::inRange(0, 200);
  QuotedPlaces quoted(text, "a");
  const std::string place = "a:" + std::to_string(line) + ":" + std::to_string(column);
  const std::string message = quoted(place + ": warning: odd");
  RC_ASSERT(message.starts_with("a: warning: "));
  RC_ASSERT(message.ends_with("odd"));
  RC_ASSERT(message.size() < 100u);
}

}  // namespace
}  // namespace whittle
