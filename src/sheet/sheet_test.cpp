#include "sheet/sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace whittle {
namespace {

using V = NamedView;

/// 40 x 30 x 20, somewhere.
const Box kBox{{5, -7, 100}, {45, 23, 120}};

const SheetView& view_of_sheet(const Sheet& sheet, V view) {
  const auto at =
      std::ranges::find_if(sheet.views, [&](const SheetView& v) { return v.view == view; });
  EXPECT_NE(at, sheet.views.end());
  return *at;
}

Sheet sheet_of(const std::vector<V>& views, ProjectionAngle angle, int width = 800,
               int height = 600) {
  const SheetSettings settings{views, angle, ""};
  const Result<Sheet> sheet = sheet_of_pixels(settings, kBox, width, height);
  EXPECT_TRUE(sheet);
  return sheet ? *sheet : Sheet{};
}

void expect_places_apart(const Sheet& sheet) {
  for (size_t i = 0; i < sheet.views.size(); ++i) {
    const SheetView& a = sheet.views[i];
    EXPECT_EQ(a.corner, (Vec2{std::floor(a.corner.x), std::floor(a.corner.y)}));
    EXPECT_EQ(a.size, (Vec2{std::floor(a.size.x), std::floor(a.size.y)}));
    EXPECT_GE(a.size.x, a.drawn.x);
    EXPECT_GE(a.size.y, a.drawn.y);
    EXPECT_GE(a.corner.x, 0);
    EXPECT_GE(a.corner.y, 0);
    EXPECT_LE(a.corner.x + a.size.x, sheet.size.x);
    EXPECT_LE(a.corner.y + a.size.y, sheet.size.y);
    for (size_t k = 0; k < i; ++k) {
      const SheetView& b = sheet.views[k];
      EXPECT_TRUE(a.corner.x + a.size.x <= b.corner.x || b.corner.x + b.size.x <= a.corner.x ||
                  a.corner.y + a.size.y <= b.corner.y || b.corner.y + b.size.y <= a.corner.y);
    }
  }
}

TEST(Sheets, ViewsOfABoxAreAtOneScale) {
  const Sheet sheet = sheet_of({V::kFront, V::kRight, V::kTop, V::kIso}, ProjectionAngle::kThird);
  const double s = sheet.scale;
  const auto expect_drawn = [&](V view, double width, double height) {
    const Vec2 drawn = view_of_sheet(sheet, view).drawn;
    EXPECT_NEAR(drawn.x, width * s, 1e-6);
    EXPECT_NEAR(drawn.y, height * s, 1e-6);
  };
  expect_drawn(V::kFront, 40, 20);
  expect_drawn(V::kRight, 30, 20);
  expect_drawn(V::kTop, 40, 30);
  // Edges of an isometric view are shorter by sqrt(2 / 3), at 30 degrees.
  const double c = std::sqrt(2.0 / 3);
  expect_drawn(V::kIso, (40 + 30) * c * std::cos(M_PI / 6), ((40 + 30) / 2.0 + 20) * c);
  expect_places_apart(sheet);
  // It could not be much larger.
  double right = 0, low = 0, left = 1e9, top = 1e9;
  for (const SheetView& view : sheet.views) {
    right = std::max(right, view.corner.x + view.size.x);
    low = std::max(low, view.corner.y + view.size.y);
    left = std::min(left, view.corner.x);
    top = std::min(top, view.corner.y);
  }
  EXPECT_TRUE(right - left > 0.8 * 800 || low - top > 0.65 * 600);
}

TEST(Sheets, ThirdAngleHasTheTopAboveAndTheRightOnTheRight) {
  const Sheet sheet =
      sheet_of({V::kIso, V::kFront, V::kRight, V::kTop, V::kLeft, V::kBottom, V::kBack},
               ProjectionAngle::kThird, 1200, 800);
  const Vec2 front = view_of_sheet(sheet, V::kFront).middle(),
             right = view_of_sheet(sheet, V::kRight).middle(),
             left = view_of_sheet(sheet, V::kLeft).middle(),
             back = view_of_sheet(sheet, V::kBack).middle(),
             top = view_of_sheet(sheet, V::kTop).middle(),
             bottom = view_of_sheet(sheet, V::kBottom).middle(),
             iso = view_of_sheet(sheet, V::kIso).middle();
  // The same feature lies in one row or column: to the bit.
  for (const Vec2 v : {right, left, back}) EXPECT_EQ(v.y, front.y);
  for (const Vec2 v : {top, bottom}) EXPECT_EQ(v.x, front.x);
  EXPECT_LT(left.x, front.x);
  EXPECT_LT(front.x, right.x);
  EXPECT_LT(right.x, back.x);
  EXPECT_LT(top.y, front.y);
  EXPECT_LT(front.y, bottom.y);
  EXPECT_EQ(iso, (Vec2{right.x, top.y}));
  expect_places_apart(sheet);
}

TEST(Sheets, FirstAngleHasThemOnTheOtherSide) {
  const Sheet sheet = sheet_of({V::kFront, V::kRight, V::kTop, V::kLeft, V::kBottom, V::kIso},
                               ProjectionAngle::kFirst, 1200, 800);
  const Vec2 front = view_of_sheet(sheet, V::kFront).middle();
  EXPECT_LT(view_of_sheet(sheet, V::kRight).middle().x, front.x);
  EXPECT_GT(view_of_sheet(sheet, V::kLeft).middle().x, front.x);
  EXPECT_GT(view_of_sheet(sheet, V::kTop).middle().y, front.y);
  EXPECT_LT(view_of_sheet(sheet, V::kBottom).middle().y, front.y);
  EXPECT_EQ(view_of_sheet(sheet, V::kTop).middle().x, front.x);
  EXPECT_EQ(view_of_sheet(sheet, V::kRight).middle().y, front.y);
  expect_places_apart(sheet);
}

TEST(Sheets, FewViewsStandNextToOneAnother) {
  const Sheet sheet = sheet_of({V::kFront, V::kIso}, ProjectionAngle::kThird);
  EXPECT_GT(view_of_sheet(sheet, V::kIso).middle().x, view_of_sheet(sheet, V::kFront).middle().x);
  expect_places_apart(sheet);
  expect_places_apart(sheet_of({V::kIso}, ProjectionAngle::kFirst));
}

TEST(Sheets, ExtensionLinesStandAtTheEdgesOfTheBox) {
  const Sheet sheet = sheet_of({V::kFront, V::kRight, V::kTop}, ProjectionAngle::kThird);
  const auto count = [&](bool vertical, double at, double low, double high) {
    return std::ranges::count_if(sheet.lines, [&](const Stroke& s) {
      if (s.size() != 2) return false;
      const auto along = [&](Vec2 p) { return vertical ? p.x : p.y; };
      const auto across = [&](Vec2 p) { return vertical ? p.y : p.x; };
      return std::fabs(along(s[0]) - at) < 1e-6 && std::fabs(along(s[1]) - at) < 1e-6 &&
             std::min(across(s[0]), across(s[1])) > low &&
             std::max(across(s[0]), across(s[1])) < high;
    });
  };
  const SheetView front = view_of_sheet(sheet, V::kFront), top = view_of_sheet(sheet, V::kTop);
  for (const double side : {-0.5, 0.5}) {
    // The width below the front, its height on the left, and the depth on the left of the top.
    EXPECT_EQ(count(true, front.middle().x + side * front.drawn.x, front.middle().y, 600), 1);
    EXPECT_EQ(count(false, front.middle().y + side * front.drawn.y, 0, front.corner.x + 2), 1);
    EXPECT_EQ(count(false, top.middle().y + side * top.drawn.y, 0, top.corner.x + 2), 1);
  }
  // Each edge once: three numbers, each with two extension lines and five of the arrows.
  const Sheet twice = sheet_of({V::kFront, V::kRight, V::kTop, V::kBack, V::kLeft, V::kBottom},
                               ProjectionAngle::kThird);
  const auto pairs = [](const Sheet& s) {
    return std::ranges::count_if(s.lines, [](const Stroke& line) { return line.size() == 2; });
  };
  const auto words = [&](std::string_view text) {
    return std::ranges::count_if(text_strokes(text, {}, 1),
                                 [](const Stroke& line) { return line.size() == 2; });
  };
  EXPECT_EQ(pairs(sheet), 3 * 7 + words("40") + words("30") + words("20") + words("FRONT") +
                              words("RIGHT") + words("TOP") + words("third angle"));
  EXPECT_EQ(pairs(twice) - pairs(sheet), words("BACK") + words("LEFT") + words("BOTTOM"));
}

TEST(Sheets, ACameraSeesTheBoxWhereTheSheetSaysItIs) {
  const Sheet sheet = sheet_of({V::kFront, V::kRight, V::kTop, V::kIso}, ProjectionAngle::kThird);
  for (const SheetView& view : sheet.views) {
    const Camera camera =
        sheet_camera(view.view, kBox, sheet.scale, int(view.size.x), int(view.size.y));
    Vec2 lo{1e9, 1e9}, hi{-1e9, -1e9};
    for (int i = 0; i < 8; ++i) {
      const Vec3 p = kBox.corner(i) - camera.eye;
      const double x = camera.width / 2.0 + dot(p, camera.right) / camera.units_per_pixel();
      const double y = camera.height / 2.0 - dot(p, camera.up) / camera.units_per_pixel();
      lo = {std::min(lo.x, x), std::min(lo.y, y)};
      hi = {std::max(hi.x, x), std::max(hi.y, y)};
    }
    EXPECT_NEAR(lo.x, (view.size.x - view.drawn.x) / 2, 1e-6);
    EXPECT_NEAR(hi.x, (view.size.x + view.drawn.x) / 2, 1e-6);
    EXPECT_NEAR(lo.y, (view.size.y - view.drawn.y) / 2, 1e-6);
    EXPECT_NEAR(hi.y, (view.size.y + view.drawn.y) / 2, 1e-6);
  }
}

TEST(Sheets, ToScaleIsInMillimetres) {
  const SheetSettings settings{{V::kFront, V::kTop}, ProjectionAngle::kFirst, "part"};
  const Sheet sheet = sheet_to_scale(settings, kBox, 2);
  EXPECT_NEAR(view_of_sheet(sheet, V::kFront).drawn.x, 80, 1e-9);
  EXPECT_NEAR(view_of_sheet(sheet, V::kTop).drawn.y, 60, 1e-9);
  for (const Stroke& line : sheet.lines) {
    for (const Vec2 p : line) {
      EXPECT_GE(p.x, 0);
      EXPECT_GE(p.y, 0);
      EXPECT_LE(p.x, sheet.size.x);
      EXPECT_LE(p.y, sheet.size.y);
    }
  }
}

TEST(Sheets, APictureThatIsTooSmallIsRefused) {
  const SheetSettings settings{{V::kFront, V::kTop}, ProjectionAngle::kThird, ""};
  const Result<Sheet> sheet = sheet_of_pixels(settings, kBox, 64, 64);
  ASSERT_FALSE(sheet);
  EXPECT_EQ(sheet.error().kind, ErrorKind::kUsage);
}

TEST(Sheets, LengthsAreWrittenToFiveDigitsOfTheLongest) {
  EXPECT_EQ(length_text(40, 40), "40");
  EXPECT_EQ(length_text(39.9999999, 40), "40");
  EXPECT_EQ(length_text(12.3456789, 40), "12.346");
  EXPECT_EQ(length_text(0.5, 123.456), "0.5");
  EXPECT_EQ(length_text(123456.7, 123456.7), "123457");
  EXPECT_EQ(length_text(0.001, 0.0012345), "0.001");
}

}  // namespace
}  // namespace whittle
