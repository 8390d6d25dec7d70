#include "host/openscad_view.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>
#include <vector>

namespace whittle {
namespace {

std::string assigned_by(std::string_view text) {
  AssignedViews found;
  find_assigned_views(text, found);
  return std::string(found.target ? "t" : "") + (found.rotation ? "r" : "") +
         (found.distance ? "d" : "") + (found.fov ? "f" : "");
}

TEST(OpenscadView, WhatIsAssignedAtTheTopCounts) {
  EXPECT_EQ(assigned_by("$vpt=[1,2,3]; $vpr = [0,0,0];\n$vpd\t=\n3;$vpf=4"), "trdf");
  EXPECT_EQ(assigned_by("cube([1, 2]); { } $vpd /* how far */ // in mm\n = 3;"), "d");
  EXPECT_EQ(assigned_by("}) $vpd = 3;"), "d") << "what closes too much is openscad's affair";
  EXPECT_EQ(assigned_by("s = \"\\\"\"; $vpr = 1;"), "r");
}

TEST(OpenscadView, WhatIsNoAssignmentAtTheTopDoesNot) {
  for (const char* text :
       {"", "$", "$vp", "$vpd", "$vpd =", "$vpd == 3", "a = $vpd;", "$vpdx = 3;", "$vpx = 3;",
        "// $vpd = 3;", "/* $vpd = 3; */", "/* $vpd = 3;", "\"$vpd = 3;\"", "\"$vpd = 3;",
        "module m() { $vpd = 3; }", "m($vpd = 3);", "[$vpd = 3]", "xvpd = 3;", "$vpd / = 3"}) {
    EXPECT_EQ(assigned_by(text), std::string_view(text) == "$vpd =" ? "d" : "") << text;
  }
}

FileView taken(std::string messages, std::string* rest = nullptr) {
  const FileView view =
      take_view(messages, {.target = true, .rotation = true, .distance = true, .fov = true});
  if (rest) *rest = messages;
  return view;
}

TEST(OpenscadView, TheAnswerIsTakenFromWhatIsSaid) {
  std::string rest;
  const FileView view = taken(
      "ECHO: 1\nECHO: whittle_view = 0, t = [1, -2, 3.5], r = [90, 0], d = 1e+06, f = 30\n"
      "WARNING: Viewall and autocenter disabled in favor of $vp*\nWARNING: odd",
      &rest);
  EXPECT_EQ(rest, "ECHO: 1\nWARNING: odd");
  EXPECT_EQ(view.target, (Vec3{1, -2, 3.5}));
  EXPECT_EQ(view.rotation_degrees, (Vec3{90, 0, 0}));
  EXPECT_EQ(view.distance, 1e6);
  EXPECT_EQ(view.fov_degrees, 30);
}

TEST(OpenscadView, OnlyWhatIsAssignedIsSet) {
  std::string messages = "ECHO: whittle_view = 0, t = [1, 2, 3], r = [0, 0, 0], d = 5, f = 6\n";
  const FileView view = take_view(messages, {.rotation = true});
  EXPECT_FALSE(view.target);
  EXPECT_EQ(view.rotation_degrees, (Vec3{0, 0, 0}));
  EXPECT_FALSE(view.distance);
  EXPECT_FALSE(view.fov_degrees);
}

TEST(OpenscadView, WhatIsOfAnotherKindIsNotSet) {
  for (const char* values :
       {"t = undef, r = \"x\", d = true, f = 0", "t = [1], r = [1, 2, 3, 4], d = , f = 180",
        "t = [1, \"2\", 3], r = [], d = nan, f = inf", "t = [1, 2, 3, r = 3, d = 4 5, f = -1", "",
        "t", "t = [", "r = [1, 2, inf], d = -inf, f = nan"}) {
    const FileView view = taken(std::string("ECHO: whittle_view = 0, ") + values);
    EXPECT_FALSE(view.target || view.rotation_degrees || view.distance || view.fov_degrees)
        << values;
  }
  EXPECT_FALSE(taken("").target);
}

/// Texts of words that mean something here.
rc::Gen<std::string> odd_text(std::vector<std::string> words) {
  return rc::gen::map(
      rc::gen::container<std::vector<std::string>>(rc::gen::elementOf(std::move(words))),
      [](const std::vector<std::string>& all) {
        std::string text;
        for (const std::string& word : all) text += word;
        return text;
      });
}

RC_GTEST_PROP(OpenscadView, AnyTextIsLookedThrough, ()) {
  const std::string text = *odd_text({"$vp", "$vpd", "t", "=", "==", "/", "*", "//", "/*", "*/",
                                      "\"", "\\", "\n", "(", ")", "{", "}", " "});
  AssignedViews assigned;
  find_assigned_views(text, assigned);
  AssignedViews more = assigned;
  find_assigned_views(text + "\n", more);
  RC_ASSERT(more.any() == assigned.any());
}

RC_GTEST_PROP(OpenscadView, OfAnyMessagesOnlyTheAnswerIsTaken, ()) {
  const std::string text =
      *odd_text({"ECHO: whittle_view = ", ", t = ", ", r = ", ", d = ", ", f = ", "[", "]", "1",
                 ", ", "-", "1e999", "\n", "x"});
  std::string messages = text;
  const FileView view =
      take_view(messages, {.target = true, .rotation = true, .distance = true, .fov = true});
  RC_ASSERT(messages.size() <= text.size());
  RC_ASSERT(!view.fov_degrees || (*view.fov_degrees > 0 && *view.fov_degrees < 180));
  RC_ASSERT(!view.target || is_finite(*view.target));
  if (text.find("whittle_view") == std::string::npos) RC_ASSERT(messages == text);
}

}  // namespace
}  // namespace whittle
