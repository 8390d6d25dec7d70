#include "viewer/painter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <fstream>
#include <iterator>
#include <mutex>
#include <string>

#include "base/folder_for_test.h"
#include "whittle/output.h"

namespace whittle {
namespace {

constexpr PictureSize kPaintedSize{160, 120};
constexpr const char* kText =
    "difference() { cube([20, 20, 10]); translate([10, 10, -1]) cylinder(h = 20, r = 6, $fn = 0); "
    "}";

std::unique_ptr<Drawable> drawable_of(const std::string& text) {
  Result<Read> read = read_csg(text, "test.csg");
  WHITTLE_CHECK(read);
  Result<std::unique_ptr<Drawable>> made = make_drawable(*std::move(read), {});
  WHITTLE_CHECK(made);
  return *std::move(made);
}

PaintRequest request_of(std::optional<OrbitView> view, bool is_moving = false) {
  ViewOptions framing;
  framing.width = kPaintedSize.width, framing.height = kPaintedSize.height;
  framing.tight = true;
  PaintRequest request;
  request.view = view;
  request.framing = framing;
  request.size = kPaintedSize;
  request.is_moving = is_moving;
  return request;
}

/// What the command line makes.
Picture expected_picture(const std::string& text, const OrbitView& view, const Look& look = {}) {
  const std::unique_ptr<Drawable> drawable = drawable_of(text);
  const Camera camera = camera_of(view, kPaintedSize);
  WHITTLE_CHECK(drawable->renderer->prepare(camera));
  Result<Frame> frame = drawable->renderer->trace(camera);
  WHITTLE_CHECK(frame);
  Result<Picture> picture = drawable->renderer->shade(*frame, camera, look.shading, look.rays());
  WHITTLE_CHECK(picture);
  return *std::move(picture);
}

class PainterTest : public testing::Test {
 protected:
  /// Takes what there is until `is_enough`; fails after some seconds.
  template <class IsEnough>
  Painter::News take_until(const IsEnough& is_enough) {
    for (;;) {
      Painter::News news = painter_.take();
      if (is_enough(news)) return news;
      std::unique_lock lock(mutex_);
      if (!told_.wait_for(lock, std::chrono::seconds(60), [&] { return count_ > 0; })) {
        ADD_FAILURE() << "nothing was told";
        return news;
      }
      count_ = 0;
    }
  }
  Painted take_final() {
    return *std::move(take_until([](const Painter::News& news) {
                        return news.painted && news.painted->step.is_final;
                      }).painted);
  }

 private:
  std::mutex mutex_;
  std::condition_variable told_;
  int count_ = 0;

 protected:
  Painter painter_{[this] {
    const std::lock_guard lock(mutex_);
    ++count_;
    told_.notify_all();
  }};
};

TEST_F(PainterTest, TheFinalPictureIsTheCommandLinesToTheByte) {
  painter_.use(drawable_of(kText), request_of(std::nullopt));
  const Painted made = take_final();
  EXPECT_EQ(made.view, rounded(made.view));
  EXPECT_TRUE(std::ranges::equal(made.picture.rgba, expected_picture(kText, made.view).rgba));
}

TEST_F(PainterTest, AViewThatIsGivenIsKept) {
  const OrbitView view{{10, 10, 5}, {70, 0, 200}, 90, 30, true};
  painter_.use(drawable_of(kText), request_of(view));
  const Painted made = take_final();
  EXPECT_EQ(made.view, view);
  EXPECT_TRUE(std::ranges::equal(made.picture.rgba, expected_picture(kText, view).rgba));
}

TEST_F(PainterTest, TheLatestOfManyRequestsIsFinishedAfterAnyNumberOfOthers) {
  painter_.use(drawable_of(kText), request_of(std::nullopt));
  OrbitView view = take_final().view;
  for (int i = 0; i < 200; ++i) {
    view = rounded(orbited(view, 3, 1));
    painter_.show(request_of(view, true));
  }
  const Painted made = take_final();
  EXPECT_EQ(made.view, view);
  EXPECT_TRUE(std::ranges::equal(made.picture.rgba, expected_picture(kText, view).rgba));
}

TEST_F(PainterTest, WhatMovesIsShownBeforeItIsFinal) {
  painter_.use(drawable_of(kText), request_of(std::nullopt));
  OrbitView view = take_final().view;
  view = rounded(orbited(view, 30, 10));
  painter_.show(request_of(view, true));
  const Painter::News news =
      take_until([](const Painter::News& n) { return n.painted.has_value(); });
  EXPECT_FALSE(news.painted->step.is_final);
  EXPECT_EQ(news.painted->picture.width, kPaintedSize.width);
  EXPECT_EQ(news.painted->picture.height, kPaintedSize.height);
}

TEST_F(PainterTest, AnotherModelIsShownFromTheSameView) {
  painter_.use(drawable_of(kText), request_of(std::nullopt));
  const OrbitView view = take_final().view;
  painter_.use(drawable_of("cube(10);"), request_of(view));
  const Painted made = take_final();
  EXPECT_EQ(made.view, view);
  EXPECT_TRUE(std::ranges::equal(made.picture.rgba, expected_picture("cube(10);", view).rgba));
}

TEST_F(PainterTest, PicksSayWhatIsThere) {
  const OrbitView view{{10, 10, 5}, {0, 0, 0}, 100, 22.5, true};
  painter_.use(drawable_of(kText), request_of(view));
  // 40 units are 120 pixels high.
  const double unit = kPaintedSize.height / (200 * std::tan(std::acos(-1.0) / 16));
  painter_.ask({view, kPaintedSize, 80 - 8 * unit, 60});
  painter_.ask({view, kPaintedSize, 80, 60});
  std::vector<PickAnswer> answers;
  take_until([&](const Painter::News& news) {
    answers.insert(answers.end(), news.answers.begin(), news.answers.end());
    return answers.size() == 2;
  });
  EXPECT_EQ(answers[0].id, 1u);
  EXPECT_NEAR(length(answers[0].point - Vec3{2, 10, 10}), 0, 1e-9);
  EXPECT_NEAR(length(answers[0].normal - Vec3{0, 0, 1}), 0, 1e-9);
  EXPECT_EQ(answers[0].place, (SourceLocation{1, 16}));
  EXPECT_EQ(answers[1].id, 0u);
}

TEST_F(PainterTest, WhatIsSeenIsKnownOfEveryPicture) {
  const OrbitView view{{10, 10, 5}, {0, 0, 0}, 100, 22.5, true};
  painter_.use(drawable_of(kText), request_of(view));
  for (bool is_final = false; !is_final;) {
    const Painter::News news =
        take_until([](const Painter::News& n) { return n.painted.has_value(); });
    const Painted& made = *news.painted;
    is_final = made.step.is_final;
    const std::optional<Vec3> point = made.point_at(52, 60);
    ASSERT_TRUE(point);
    EXPECT_NEAR(point->z, 10, 1e-4);
    EXPECT_NEAR(length(*point - point_on_target_plane(view, kPaintedSize, 52, 60) - Vec3{0, 0, 5}),
                0, 0.5);
    EXPECT_FALSE(made.point_at(80, 60));
    EXPECT_FALSE(made.point_at(2, 2));
    EXPECT_FALSE(made.point_at(-1, 60));
  }
}

TEST_F(PainterTest, SavesTheFinalPicture) {
  const TestFolder folder;
  painter_.use(drawable_of(kText), request_of(std::nullopt));
  const OrbitView view = take_final().view;
  Look look;
  look.shading.background = false;
  for (const bool background : {true, false}) {
    look.shading.background = background;
    const std::string path = folder / "part.png";
    painter_.save({view, kPaintedSize, look, path});
    const Painter::News news = take_until([](const Painter::News& n) { return !n.saved.empty(); });
    ASSERT_TRUE(news.saved[0]);
    EXPECT_EQ(*news.saved[0], path);
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    const Result<std::string> expected =
        encode(FileFormat::kPng, {}, expected_picture(kText, view, look), !background, path);
    ASSERT_TRUE(expected);
    EXPECT_EQ(bytes, *expected);
  }
}

TEST_F(PainterTest, AFolderThatIsNotThereIsSaid) {
  painter_.use(drawable_of(kText), request_of(OrbitView()));
  painter_.save({OrbitView(), kPaintedSize, {}, "/there/is/no/such/folder.png"});
  const Painter::News news = take_until([](const Painter::News& n) { return !n.saved.empty(); });
  ASSERT_FALSE(news.saved[0]);
  EXPECT_EQ(news.saved[0].error().kind, ErrorKind::kMachine);
}

TEST_F(PainterTest, EndsWhileItPaints) {
  painter_.use(drawable_of(kText), request_of(std::nullopt));
  painter_.show(request_of(OrbitView(), true));
}

}  // namespace
}  // namespace whittle
