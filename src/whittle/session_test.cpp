// Sessions, as their users see them.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <mutex>

#include "whittle/whittle.h"

namespace {

using whittle::Backend;
using whittle::Control;
using whittle::Part;
using whittle::Point;
using whittle::Seen;
using whittle::Session;
using whittle::WorldRay;

const whittle::Solid& drilled() {
  static const whittle::Solid solid = whittle::Solid::parse(
      "difference() {\n  cube(10, center = true);\n  cylinder(r = 2, h = 30, center = true);\n}");
  return solid;
}

/// From above at z = 50, a unit of the plane z = 0 a pixel or so.
whittle::RenderOptions above(int width, int height) {
  whittle::RenderOptions options{.width = width, .height = height};
  options.eye = {0, 0, 50};
  options.center = {0, 0, 0};
  return options;
}

TEST(Session, MakesThePicturesThatASolidMakes) {
  Session session(drilled());
  std::vector<whittle::RenderOptions> views{above(40, 30), above(120, 90)};
  views.push_back({.width = 33, .height = 44});
  views.push_back({.width = 64, .height = 64});
  views.back().eye = {0, 0, 5.5};  // close to the face
  views.back().center = {1, 3, 5};
  views.push_back(views.front());
  views.back().style = whittle::Style::kBlinn;
  for (const whittle::RenderOptions& view : views) {
    const whittle::Rendering kept = session.render(view), fresh = drilled().render(view);
    EXPECT_EQ(kept.rgba, fresh.rgba);
    EXPECT_EQ(kept.distance, fresh.distance);
    EXPECT_EQ(kept.id, fresh.id);
  }
}

TEST(Session, OutlivesTheSolidItIsOf) {
  Session session{whittle::Solid::parse("cube(10, center = true);")};
  Session moved = std::move(session);
  EXPECT_EQ(moved.render(above(9, 9)).id[40], 1u);
}

TEST(Session, PicksWhatThePictureShows) {
  for (const Backend backend : {Backend::kCpu, Backend::kOracle}) {
    Session session(drilled(), {.backend = backend});
    const whittle::RenderOptions view = above(40, 30);
    const whittle::Rendering picture = session.render(view);
    for (const auto& [x, y] : {std::pair{20, 15}, {25, 15}, {21, 9}, {0, 0}}) {
      const Seen seen = session.pick(view, x + 0.5, y + 0.5);
      const size_t i = size_t(y * 40 + x);
      EXPECT_EQ(seen.id, picture.id[i]);
      if (!seen) continue;
      EXPECT_FLOAT_EQ(float(seen.distance), picture.distance[i]);
    }
    const Seen top = session.pick(view, 25.5, 15.5);
    ASSERT_TRUE(top);
    EXPECT_NEAR(top.point[2], 5, 1e-5);
    EXPECT_EQ(top.normal, (Point{0, 0, 1}));
    EXPECT_EQ(drilled().place(top.id), (whittle::Place{2, 3}));
  }
}

TEST(Session, PicksWithoutAPicture) {
  Session session(drilled());
  EXPECT_EQ(session.pick(above(40, 30), 28, 15).id, 1u);
}

TEST(Session, CastsRaysFromAnywhere) {
  Session session(drilled());
  const std::vector<WorldRay> rays{
      {{-20, 3, 0}, {5, 0, 0}},   // onto the cube
      {{0, 0, 0}, {0, -0.1, 0}},  // from within the hole, onto its wall
      {{0, 0, 20}, {0, 0, -1}},   // through the hole
      {{3, 0, 0}, {0, 0, 1}},     // from within the solid
  };
  const std::vector<Seen> seen = session.cast(rays);
  ASSERT_EQ(seen.size(), 4u);
  EXPECT_EQ(seen[0].id, 1u);
  EXPECT_NEAR(seen[0].distance, 15, 1e-5);
  EXPECT_EQ(seen[0].normal, (Point{-1, 0, 0}));
  EXPECT_EQ(seen[1].id, 2u);
  EXPECT_NEAR(seen[1].distance, 2, 1e-6);
  EXPECT_NEAR(seen[1].normal[1], 1, 1e-6) << "outward of the solid";
  EXPECT_FALSE(seen[2]);
  EXPECT_NEAR(seen[3].point[2], 5, 1e-5);
  EXPECT_TRUE(session.cast({}).empty());
}

TEST(Session, RefusesRaysThatGoNowhere) {
  Session session(drilled());
  for (const WorldRay& ray : {WorldRay{{0, 0, 0}, {0, 0, 0}}, WorldRay{{NAN, 0, 0}, {1, 0, 0}},
                              WorldRay{{0, 0, 0}, {INFINITY, 0, 0}}})
    EXPECT_THROW((void)session.cast({&ray, 1}), whittle::Failure);
  EXPECT_THROW((void)session.pick(above(9, 9), NAN, 0), whittle::Failure);
}

TEST(Session, TellsThePartsOfAPictureAndHowFarItIs) {
  Session session(drilled());
  std::mutex mutex;
  std::vector<std::uint32_t> told(100 * 70, 99);
  std::vector<double> shares;
  Control control;
  control.part = [&](const Part& part) {
    const std::lock_guard lock(mutex);
    for (int y = 0; y < part.height; ++y)
      for (int x = 0; x < part.width; ++x)
        told[size_t((part.y + y) * 100 + part.x + x)] = part.id[size_t(y * part.width + x)];
  };
  control.progress = [&](double share) {
    const std::lock_guard lock(mutex);
    shares.push_back(share);
  };
  const auto picture = session.render(above(100, 70), control);
  ASSERT_TRUE(picture);
  EXPECT_EQ(told, picture->id);
  ASSERT_FALSE(shares.empty());
  for (const double share : shares) EXPECT_TRUE(share > 0 && share <= 1);
}

TEST(Session, StopsAndGoesOn) {
  for (const Backend backend : {Backend::kCpu, Backend::kOracle}) {
    Session session(drilled(), {.backend = backend, .threads = 1});
    std::stop_source stop;
    std::atomic<int> parts = 0;
    Control control;
    control.stop = stop.get_token();
    control.part = [&](const Part&) {
      if (++parts == 2) stop.request_stop();
    };
    EXPECT_FALSE(session.render(above(200, 200), control));
    EXPECT_EQ(parts, 2) << "no part is traced after a stop";
    EXPECT_FALSE(session.render(above(200, 200), control)) << "it stays stopped";
    EXPECT_EQ(parts, 2);
    EXPECT_EQ(session.render(above(50, 40)).rgba,
              drilled().render(above(50, 40), {.backend = backend}).rgba);
  }
}

TEST(Session, RefusesWhatASolidRefuses) {
  EXPECT_THROW(Session(drilled(), {.threads = -1}), whittle::Failure);
  EXPECT_THROW(Session(drilled(), {.backend = Backend::kVulkanRaster, .device = "no such device"}),
               whittle::Failure);
  Session session(drilled());
  EXPECT_THROW((void)session.render({.width = 0}), whittle::Failure);
}

}  // namespace
