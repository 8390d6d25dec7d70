// Solids that are cut open, as users see them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "whittle/whittle.h"

namespace {

using whittle::Backend;
using whittle::CuttingPlane;
using whittle::Point;
using whittle::Seen;
using whittle::Session;
using whittle::Solid;

constexpr CuttingPlane kFront{{0, -1, 0}, 0};  // y < 0

/// A block with a bore, a red pin in it, and a blue ball in a hollow of the block; whatever
/// overlaps is the block's, which stands first.
const Solid& nested() {
  static const Solid solid = Solid::parse(
      "difference() { cube([40, 20, 20], center = true);\n"
      "  translate([-10, 0, 0]) cylinder(h = 30, r = 5, center = true);\n"
      "  translate([10, 0, 0]) sphere(7); }\n"
      "color(\"red\") translate([-10, 0, 0]) cylinder(h = 40, r = 3, center = true);\n"
      "color(\"blue\") translate([10, 0, 0]) sphere(6);\n"
      "color(\"lime\") translate([0, 0, 8]) cube([10, 10, 10], center = true);\n");
  return solid;
}

/// What a ray along +y sees at (x, z).
Seen look(Session& session, double x, double z) {
  const whittle::WorldRay ray{{x, -50, z}, {0, 1, 0}};
  return session.cast({&ray, 1})[0];
}

TEST(CutOpen, ACapIsWhoseMaterialItCutsThrough) {
  const Solid cut = nested().cut_open({{kFront}});
  EXPECT_EQ(cut.statement_count(), 6u);
  for (const Backend backend : {Backend::kCpu, Backend::kOracle}) {
    Session session(cut, {.backend = backend});
    const struct {
      double x, z;
      std::uint32_t id;
    } caps[] = {{-18, 0, 1}, {0, 0, 1},    {18, 9, 1},  // the block
                {-10, 0, 4}, {-10, 19, 4}, {-12, 5, 4},
                {10, 0, 5},  {13, 4, 5},   {0, 9, 1},  // the block and the lime cube: the first
                {0, 12, 6}};                           // the lime cube alone
    for (const auto& [x, z, id] : caps) {
      const Seen seen = look(session, x, z);
      EXPECT_EQ(seen.id, id) << x << ", " << z;
      EXPECT_TRUE(seen.is_cap);
      EXPECT_NEAR(seen.distance, 50, 1e-4);
      EXPECT_EQ(seen.normal, (Point{0, -1, 0}));
    }
    // Beside the pin, and between ball and hollow, one sees the walls behind.
    for (const auto& [x, z, id] : {std::tuple{-14.0, 0.0, 2u}, {10.0, 6.5, 3u}}) {
      const Seen seen = look(session, x, z);
      EXPECT_EQ(seen.id, id);
      EXPECT_FALSE(seen.is_cap);
      EXPECT_GT(seen.distance, 51);
    }
    EXPECT_FALSE(look(session, -10, 21));
  }
}

// A distance is a float, off by far more than the solid's tolerance.
TEST(CutOpen, CapsAreKnownFromFarAway) {
  Session session(nested().cut_open({{kFront}}), {.backend = Backend::kCpu});
  for (int i = 0; i < 200; ++i) {
    const whittle::WorldRay ray{{-18 + 0.01 * i, -3e5 - 7 * i, 0.02 * i}, {0, 1, 0}};
    const Seen seen = session.cast({&ray, 1})[0];
    EXPECT_EQ(seen.id, 1u) << i;
    EXPECT_TRUE(seen.is_cap) << i;
  }
}

TEST(CutOpen, PicturesAreFramedAsOfTheWhole) {
  for (const whittle::Style style : {whittle::Style::kStudio, whittle::Style::kOpenscad}) {
    const whittle::RenderOptions view{.width = 80, .height = 60, .style = style};
    const whittle::Rendering whole = nested().render(view);
    const whittle::Rendering cut = nested().cut_open({{{{0, 0, 1}, 5}}}).render(view);
    // What is not cut away is where it was.
    int same = 0;
    for (size_t i = 0; i < whole.id.size(); ++i) {
      if (cut.id[i] != whole.id[i] || std::isinf(cut.distance[i])) continue;
      same += std::fabs(cut.distance[i] - whole.distance[i]) < 1e-3f;
    }
    EXPECT_GT(same, 500);
    EXPECT_NE(cut.id, whole.id);
  }
}

TEST(CutOpen, ACapShowsTheColourOfItsPart) {
  whittle::RenderOptions view{.width = 200, .height = 120, .orthographic = true};
  view.eye = {0, -100, 0};
  view.center = {0, 0, 0};
  const Solid cut = nested().cut_open({{kFront}});
  for (const whittle::Style style :
       {whittle::Style::kStudio, whittle::Style::kPlain, whittle::Style::kBlinn}) {
    view.style = style;
    Session session(cut);
    const whittle::Rendering picture = session.render(view);
    int red = 0, blue = 0;
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        const Seen seen = session.pick(view, x + 0.5, y + 0.5);
        if (!seen.is_cap) continue;
        const auto* c = &picture.rgba[4 * size_t(y * view.width + x)];
        red += seen.id == 4 && c[0] > 120 && c[0] > 2 * c[1] && c[0] > 2 * c[2];
        blue += seen.id == 5 && c[2] > 120 && c[2] > 2 * c[0] && c[2] > 2 * c[1];
      }
    }
    EXPECT_GT(red, 50);
    EXPECT_GT(blue, 50);
  }
}

TEST(CutOpen, ChosenColoursStayWhole) {
  Session session(nested().cut_open({{kFront}}, {{0, 0, 1}}));
  const Seen ball = look(session, 10, 0);
  EXPECT_EQ(ball.id, 5u);
  EXPECT_FALSE(ball.is_cap);
  EXPECT_NEAR(ball.distance, 44, 1e-4);
  EXPECT_TRUE(look(session, -10, 0).is_cap);
}

TEST(CutOpen, IsWhatTheBoundaryIsOf) {
  const Solid cube = Solid::parse("cube(10);");
  const whittle::BoundaryMesh mesh = cube.cut_open({{{{2, 0, 0}, 8}}}).boundary();
  double most = 0;
  for (const Point& corner : mesh.corners) most = std::max(most, corner[0]);
  EXPECT_DOUBLE_EQ(most, 4);
  EXPECT_EQ(mesh.corners.size(), 8u);
}

TEST(CutOpen, WhatCanNotBeIsAFailure) {
  const auto cause_of = [](const auto& act) {
    try {
      act();
    } catch (const whittle::Failure& failure) {
      return int(failure.cause());
    }
    return 0;
  };
  EXPECT_EQ(cause_of([] { nested().cut_open({{{{0, 0, 0}, 1}}}); }), 2);
  EXPECT_EQ(cause_of([] { nested().cut_open({{{{NAN, 0, 0}, 1}}}); }), 2);
  EXPECT_EQ(cause_of([] { Solid::parse("square(3);").cut_open({{kFront}}); }), 2);
  EXPECT_EQ(cause_of([] { nested().cut_open({}); }), 0);
}

TEST(Xray, OfNestedBoxesIsByTheFormula) {
  // Four walls, seen straight; the film's light is computed here anew.
  const Solid shell = Solid::parse(
      "difference() { color(\"white\") cube(20, center = true); color(\"white\") "
      "cube(10, center = true); }");
  whittle::RenderOptions view{.width = 41, .height = 41, .orthographic = true};
  view.eye = {0, 0, 100};
  view.center = {0, 0, 0};
  view.background = false;
  view.xray = true;
  for (const Backend backend : {Backend::kCpu, Backend::kOracle}) {
    const whittle::Rendering picture = shell.render(view, {.backend = backend});
    const auto alpha = [](int walls) { return 255 * (1 - std::exp(-0.12 * walls)); };
    // The eye's height over the plane z = 0 makes 200 tan(11.25 degrees) units of 41 pixels.
    const double unit = 41 / (200 * std::tan(11.25 / 180 * std::acos(-1.0)));
    const auto at = [&](double x, double y) {
      return &picture.rgba[4 * (size_t(20.5 - y * unit) * 41 + size_t(20.5 + x * unit))];
    };
    EXPECT_NEAR(at(0, 0)[3], alpha(4), 0.6);
    EXPECT_NEAR(at(2, -2)[3], alpha(4), 0.6);
    EXPECT_NEAR(at(7.5, 0)[3], alpha(2), 0.6);
    EXPECT_NEAR(at(0, -7.5)[3], alpha(2), 0.6);
    EXPECT_EQ(at(15, 0)[3], 0);
    EXPECT_NEAR(at(0, 0)[0], 255 * (1.055 * std::pow(0.22, 1 / 2.4) - 0.055), 0.6);
    EXPECT_EQ(picture.id[size_t(20 * 41 + 20)], 1u);
  }
}

}  // namespace
