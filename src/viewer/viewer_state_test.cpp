#include "viewer/viewer_state.h"

#include <gtest/gtest.h>

#include <set>

namespace whittle {
namespace {

ViewerState some_state() {
  ViewerState state;
  state.view = OrbitView{{1, 2, 3}, {60, 0, 30}, 50, 30, false};
  state.files = {"a.csg", "b.csg", "c.csg"};
  return state;
}

PickedPoint picked_at(Vec3 point, Vec3 normal, uint32_t id = 7) {
  PickedPoint picked;
  picked.answer.id = id;
  picked.answer.point = point;
  picked.answer.normal = normal;
  return picked;
}

TEST(ViewerStateTest, ViewsMove) {
  ViewerState state = some_state();
  EXPECT_EQ(act(Action::kTop, state), Effect::kMove);
  EXPECT_EQ(state.view->rotation_degrees, (Vec3{0, 0, 0}));
  EXPECT_EQ(act(Action::kProjection, state), Effect::kMove);
  EXPECT_TRUE(state.view->orthographic);
  EXPECT_EQ(act(Action::kZoomIn, state), Effect::kMove);
  EXPECT_LT(state.view->distance, 50);
  EXPECT_EQ(act(Action::kTurnLeft, state), Effect::kMove);
  EXPECT_EQ(state.view->rotation_degrees.z, 15);
}

TEST(ViewerStateTest, WithoutAViewNothingMoves) {
  ViewerState state = some_state();
  state.view.reset();
  EXPECT_EQ(act(Action::kTop, state), Effect::kNone);
  EXPECT_EQ(act(Action::kFit, state), Effect::kNone);
  EXPECT_FALSE(state.view);
}

TEST(ViewerStateTest, KeysGoThroughAllThatTheCommandLineHas) {
  ViewerState state = some_state();
  std::set<Style> styles;
  std::set<Quality> qualities;
  std::set<Pass> passes;
  std::set<const ColorScheme*> schemes;
  for (int i = 0; i < 40; ++i) {
    EXPECT_EQ(act(Action::kStyle, state), Effect::kPaint);
    EXPECT_EQ(act(Action::kQuality, state), Effect::kPaint);
    EXPECT_EQ(act(Action::kPass, state), Effect::kPaint);
    EXPECT_EQ(act(Action::kColors, state), Effect::kPaint);
    styles.insert(state.look.shading.style);
    qualities.insert(state.look.shading.quality);
    passes.insert(state.look.pass);
    schemes.insert(state.look.shading.scheme);
  }
  EXPECT_EQ(styles.size(), style_choices().size());
  EXPECT_EQ(qualities.size(), quality_choices().size());
  EXPECT_EQ(passes.size(), pass_choices().size());
  EXPECT_EQ(schemes.size(), color_schemes().size() + 1);
}

TEST(ViewerStateTest, StyleOpenscadHasNoShadows) {
  ViewerState state = some_state();
  act(Action::kShadows, state);
  EXPECT_TRUE(state.look.shading.shadows);
  while (state.look.shading.style != Style::kOpenscad) act(Action::kStyle, state);
  EXPECT_FALSE(state.look.shading.shadows);
  act(Action::kShadows, state);
  EXPECT_FALSE(state.look.shading.shadows);
}

TEST(ViewerStateTest, FilesGoAroundAndEachHasAViewOfItsOwn) {
  ViewerState state = some_state();
  EXPECT_EQ(act(Action::kPreviousFile, state), Effect::kLoad);
  EXPECT_EQ(state.file, 2u);
  EXPECT_FALSE(state.view);
  EXPECT_EQ(act(Action::kNextFile, state), Effect::kLoad);
  EXPECT_EQ(state.file, 0u);
  state.files.resize(1);
  EXPECT_EQ(act(Action::kNextFile, state), Effect::kNone);
}

TEST(ViewerStateTest, ReloadingKeepsTheView) {
  ViewerState state = some_state();
  EXPECT_EQ(act(Action::kReload, state), Effect::kLoad);
  EXPECT_EQ(state.view, some_state().view);
}

TEST(ViewerStateTest, PanelsComeAndGo) {
  ViewerState state = some_state();
  EXPECT_EQ(act(Action::kHelp, state), Effect::kNone);
  EXPECT_TRUE(state.shows_help);
  act(Action::kHelp, state);
  EXPECT_FALSE(state.shows_help);
  act(Action::kLookPanel, state);
  EXPECT_TRUE(state.shows_look);
}

TEST(ViewerStateTest, TheLastTwoPicksAreMeasured) {
  ViewerState state = some_state();
  add_pick(picked_at({9, 9, 9}, {0, 0, 1}), state);
  add_pick(picked_at({1, 1, 1}, {0, 0, 1}), state);
  add_pick(picked_at({4, 5, 1}, {1, 0, 0}), state);
  ASSERT_EQ(state.picks.size(), 2u);
  EXPECT_TRUE(state.shows_picks);
  const std::vector<std::string> expected{"statement 7", "point   1, 1, 1", "normal  0, 0, 1",   "",
                                          "statement 7", "point   4, 5, 1", "normal  1, 0, 0",   "",
                                          "apart   5",   "along   3, 4, 0", "angle   90 degrees"};
  EXPECT_EQ(pick_lines(state), expected);
}

TEST(ViewerStateTest, APickIsALine) {
  PickedPoint picked = picked_at({1, 2.5, 1.0 / 3}, {0, 0, 1});
  EXPECT_EQ(pick_text(picked), "statement 7: 1,2.5,0.333333");
  picked.place = "part.csg:2:3";
  picked.statement = "cube(10);";
  EXPECT_EQ(pick_text(picked), "part.csg:2:3: 1,2.5,0.333333 cube(10);");
}

TEST(ViewerStateTest, AClickBesideTheSolidForgetsThem) {
  ViewerState state = some_state();
  add_pick(picked_at({9, 9, 9}, {0, 0, 1}), state);
  add_pick(picked_at({}, {}, 0), state);
  EXPECT_TRUE(state.picks.empty());
  EXPECT_TRUE(pick_lines(state).empty());
}

}  // namespace
}  // namespace whittle
