#include "edit/customizer.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace whittle {
namespace {

/// The variables in one line each: `group/name=value [least:step:most] #characters {value:label}
/// "description"`.
std::vector<std::string> variables_of(std::string_view scad) {
  std::vector<std::string> lines;
  for (const CustomizerVariable& v : read_customizer(scad)) {
    std::string line = v.group == "Parameters" ? "" : v.group + "/";
    line += definition(v, v.value);
    if (v.least) line += fmt::format(" [{}:{}:{}]", *v.least, v.step.value_or(0), *v.most);
    if (!v.least && v.step) line += fmt::format(" step {}", *v.step);
    if (v.most_characters) line += fmt::format(" #{}", *v.most_characters);
    for (const CustomizerChoice& choice : v.choices) {
      line += fmt::format(" {{{}:{}}}", customizer_text(choice.value), choice.label);
    }
    if (!v.description.empty()) line += fmt::format(" \"{}\"", v.description);
    lines.push_back(line);
  }
  return lines;
}

std::string variable_of(std::string_view scad) {
  const std::vector<std::string> lines = variables_of(scad);
  return lines.size() == 1 ? lines[0] : fmt::format("{} variables", lines.size());
}

using Lines = std::vector<std::string>;

TEST(Customizer, LiteralsAreVariables) {
  EXPECT_EQ(variables_of("a = 5; b=-2.50; c = true; d = \"x\\\"y\\n\"; e = [1, 2.5]; $fn = 20;"),
            (Lines{"a=5", "b=-2.5", "c=true", "d=\"x\\\"y\\n\"", "e=[1, 2.5]", "$fn=20"}));
  EXPECT_EQ(
      variables_of("a = 1 + 2; b = a; c = PI; d = undef; e = [0:5]; f = [1, \"a\"]; g = f(1);"
                   "h = [1, 2, 3, 4, 5]; i = []; j = -PI; k = [[1]]; l = a ? 1 : 2; m = 1e999;"),
      Lines{});
}

TEST(Customizer, OnlyTheLinesBeforeTheFirstBraceCount) {
  EXPECT_EQ(variables_of("a = 1;\nb = 2; module x() {}\nc = 3;"), (Lines{"a=1"}));
  EXPECT_EQ(variables_of("a = \"{\"; // {\n/* { */ b = 2;\nmodule x() cube();\nc = 3;\nx() { }"),
            (Lines{"a=\"{\"", "b=2", "c=3"}));
  EXPECT_EQ(variables_of("cube(a = 5); b = 2; translate([1, 2, 3]) cube(); c = 3;"),
            (Lines{"b=2", "c=3"}));
  EXPECT_EQ(
      variables_of("use <a;b.scad>\ninclude <c.scad>\na = 1;\nfunction f(x) = x == 1;\nb = 2;"),
      (Lines{"a=1", "b=2"}));
}

TEST(Customizer, OfOneNameTheLastAssignmentCounts) {
  EXPECT_EQ(variables_of("a = 1; // [1:2]\nb = 2;\na = 3; // [3:4]\n"),
            (Lines{"a=3 [3:0:4]", "b=2"}));
  EXPECT_EQ(variables_of("a = 1;\nb = 2;\na = 3 + 4;\n"), (Lines{"b=2"}));
}

TEST(Customizer, NumbersHaveRanges) {
  EXPECT_EQ(variable_of("a = 3; // [50]"), "a=3 [0:0:50]");
  EXPECT_EQ(variable_of("a = 3; //[ -10 : 10 ]  \r\n"), "a=3 [-10:0:10]");
  EXPECT_EQ(variable_of("a = 3; // [0:0.5:20]"), "a=3 [0:0.5:20]");
  EXPECT_EQ(variable_of("a = 3; // .25"), "a=3 step 0.25");
  EXPECT_EQ(variable_of("a = [1, 2]; // [0:0.1:10]"), "a=[1, 2] [0:0.1:10]");
  EXPECT_EQ(variable_of("a = [1, 2]; // 0.5"), "a=[1, 2] step 0.5");
  EXPECT_EQ(variable_of("a = 3; // [0:-1:20]"), "a=3 [0:0:20]");
}

TEST(Customizer, TextsHaveALength) {
  EXPECT_EQ(variable_of("a = \"x\"; // 8"), "a=\"x\" #8");
  EXPECT_EQ(variable_of("a = \"x//y\"; // 8"), "a=\"x//y\" #8");
  EXPECT_EQ(variable_of("a = \"x\"; // -8"), "a=\"x\"");
}

TEST(Customizer, NumbersAndTextsHaveChoices) {
  EXPECT_EQ(variable_of("a = 2; // [1, 2, 3]"), "a=2 {1:1} {2:2} {3:3}");
  EXPECT_EQ(variable_of("a = 10; // [10:S, 20:Medium Size, 30:\"L, or so\"]"),
            "a=10 {10:S} {20:Medium Size} {30:L, or so}");
  EXPECT_EQ(variable_of("a = \"M\"; // [S, M : Medium,L]"),
            "a=\"M\" {\"S\":S} {\"M\":Medium} {\"L\":L}");
  EXPECT_EQ(variable_of("a = \"a\"; // [\"a,b\", \"c:d\":Lab]"),
            "a=\"a\" {\"a,b\":a,b} {\"c:d\":Lab}");
  EXPECT_EQ(variable_of("a = \"a\"; // [a]"), "a=\"a\" {\"a\":a}");
  EXPECT_EQ(variable_of("a = \"1\"; // [1:2]"), "a=\"1\" {\"1\":2}");
  EXPECT_EQ(variable_of("a = 1; // [0:No]"), "a=1 {0:No}");
}

TEST(Customizer, WhatSaysNothingUnderstoodSaysNothing) {
  for (const char* comment :
       {"hello", "[1:2] mm", "[1:2", "[]", "[5:1]", "[1:2:3:4]", "[a, b]", "", "[", "]", "0"}) {
    EXPECT_EQ(variable_of(fmt::format("a = 3; // {}", comment)), "a=3") << comment;
  }
  EXPECT_EQ(variable_of("a = true; // [1:2]"), "a=true");
  EXPECT_EQ(variable_of("a = [1, 2]; // [1, 2]"), "a=[1, 2]");
}

TEST(Customizer, ACommentBelongsToTheOnlyStatementOfItsLine) {
  EXPECT_EQ(variables_of("a = 1; b = 2; // [1:9]"), (Lines{"a=1", "b=2"}));
  EXPECT_EQ(variables_of("a =\n 1; // [1:9]"), (Lines{"a=1"}));
  EXPECT_EQ(variables_of("a = 1; /* ; */ // [1:9]"), (Lines{"a=1 [1:0:9]"}));
}

TEST(Customizer, TheLineAboveDescribes) {
  EXPECT_EQ(variables_of("//  the radius \na = 1;\nb = 2;\n // indented\nc = 3;\n// far\n\nd = 4;"),
            (Lines{"a=1 \"the radius\"", "b=2", "c=3", "d=4"}));
}

TEST(Customizer, HeadingsMakeGroups) {
  EXPECT_EQ(
      variables_of("a = 1;\n/* [Size] */\nb = 2;\n/* nothing */ c = 3;\n/* [A] [ B ] */\nd = 4;\n"
                   "/* [Hidden] */\ne = 5;\n/* [Global] */\nf = 6;\n// /* [No] */\n\ng = 7;"
                   "\n/* [x]\n[y] */\nh = 8;"),
      (Lines{"a=1", "Size/b=2", "Size/c=3", "A-B/d=4", "Global/f=6", "Global/g=7", "Global/h=8"}));
}

TEST(Customizer, LinesAreCounted) {
  const std::vector<CustomizerVariable> all =
      read_customizer("/*\n*/\na = 1;\n\nb = \"\n\"; c = 2;");
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].line, 3u);
  EXPECT_EQ(all[1].line, 5u);
  EXPECT_EQ(all[2].line, 6u);
}

TEST(Customizer, AnyTextIsUnderstood) {
  for (const char* text : {"", ";", "=", "a", "a =", "a = ", "a = 1", "a = \"", "/*", "//", "use <",
                           "a = [", "a = -;", "{", "\"{", "include"}) {
    EXPECT_EQ(variables_of(text), Lines{}) << text;
  }
  EXPECT_EQ(variables_of("a = 1; \""), Lines{"a=1"});
}

TEST(Customizer, OnlyWhatIsChangedIsTold) {
  const std::vector<CustomizerVariable> all =
      read_customizer("a = 1; b = true; c = \"x\"; d = [1, 2];");
  EXPECT_EQ(definitions(all, {1.0, true, std::string("x"), std::vector<double>{1, 2}}), Lines{});
  EXPECT_EQ(
      definitions(all, {0.1, false, std::string("say \"\\\""), std::vector<double>{1, -3e-7}}),
      (Lines{"a=0.1", "b=false", "c=\"say \\\"\\\\\\\"\"", "d=[1, -3e-07]"}));
}

}  // namespace
}  // namespace whittle
