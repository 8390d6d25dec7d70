#include "trace/drawing_tracer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "trace/view_for_test.h"

namespace whittle {
namespace {

/// A slab over a rectangle that is 4 wide and 2 deep, with its lowest corner at the origin and its
/// left half of id 7. It answers nothing but a look straight down from above it.
class RectangleSlab final : public Tracer {
 public:
  const char* name() const override { return "rectangle"; }
  Frame render(const Camera&, const RenderControl&) override {
    ADD_FAILURE() << "the pixels of a drawing are not those of its slab";
    return {};
  }
  void probe(const Camera&, std::span<const PixelPosition>, std::span<Hit>) override {
    ADD_FAILURE() << "nor are those of its probes";
  }
  void cast(std::span<const Ray> rays, std::span<Hit> hits) override {
    for (size_t i = 0; i < rays.size(); ++i) {
      EXPECT_EQ(rays[i].direction, (Vec3{0, 0, -1}));
      EXPECT_GT(rays[i].origin.z, 0.5);
      const Vec3 p = rays[i].origin;
      const bool in = p.x > 0 && p.x < 4 && p.y > 0 && p.y < 2;
      hits[i] = in ? Hit{float(p.z - 0.5), p.x < 2 ? 7u : 8u, {1, 0, 0}} : Hit{};
    }
    asked += rays.size();
  }
  size_t asked = 0;
};

const Box kRectangleBox{{0, 0, -0.5}, {4, 2, 0.5}};

TEST(DrawingTracer, SeesThePlaneAndNotTheSlab) {
  const Workers workers(2);
  RectangleSlab slab;
  DrawingTracer tracer(slab, kRectangleBox, workers);
  EXPECT_STREQ(tracer.name(), "rectangle");
  for (const CameraNumbers& numbers : std::vector<CameraNumbers>{{1, 1, 0, 55, 0, 25, 20},
                                                                 {2, 1, 0, 0, 0, 0, 9},
                                                                 {2, 1, 0, 140, 10, 25, 9},
                                                                 {2, 1, 0, 80, 0, 0, 9},
                                                                 {1, 1, -3, 1.5, 1.5, 0},
                                                                 {2, 1, 0.5, 3, 2, 0}}) {
    for (const bool orthographic : {false, true}) {
      ViewOptions view = view_of(numbers);
      view.width = 40, view.height = 30, view.orthographic = orthographic;
      const Camera camera = make_camera(view, {}, kRectangleBox);
      const Frame frame = tracer.render(camera);
      int seen = 0;
      for (int y = 0; y < 30; ++y) {
        for (int x = 0; x < 40; ++x) {
          const Ray ray = camera.ray(x + 0.5, y + 0.5);
          const double t = -ray.origin.z / ray.direction.z;
          const Vec3 p = ray.origin + ray.direction * t;
          const double edge = std::min({std::fabs(p.x), std::fabs(p.x - 2), std::fabs(p.x - 4),
                                        std::fabs(p.y), std::fabs(p.y - 2)});
          if (edge < 1e-12) continue;
          const bool in = t > ray.t_min && p.x > 0 && p.x < 4 && p.y > 0 && p.y < 2;
          const Hit& hit = frame.at(x, y);
          ASSERT_EQ(hit.id, !in       ? 0u
                            : p.x < 2 ? 7u
                                      : 8u)
              << testing::PrintToString(numbers) << ": " << x << ", " << y;
          if (!in) continue;
          ++seen;
          EXPECT_FLOAT_EQ(hit.distance, float(t));
          EXPECT_EQ(hit.normal, (Vec3f{0, 0, ray.direction.z < 0 ? 1.0f : -1.0f}));
        }
      }
      EXPECT_GT(seen, 4) << testing::PrintToString(numbers);
    }
  }
}

TEST(DrawingTracer, AnyRaySeesWhatTheCameraSees) {
  const Workers workers(1);
  RectangleSlab slab;
  DrawingTracer tracer(slab, kRectangleBox, workers);
  ViewOptions view = view_of({2, 1, 0, 55, 0, 25, 9});
  view.width = view.height = 16;
  const Camera camera = make_camera(view, {}, kRectangleBox);
  const Frame frame = tracer.render(camera);
  std::vector<Ray> rays;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) rays.push_back(camera.ray(x + 0.5, y + 0.5));
  std::vector<Hit> hits(rays.size(), Hit{1, 99, {}});
  tracer.cast(rays, hits);
  for (size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(hits[i].id, frame.hits[i].id);
    EXPECT_EQ(hits[i].distance, frame.hits[i].distance);
  }
}

TEST(DrawingTracer, StopsWhereItIsAskedTo) {
  const Workers workers(1);
  RectangleSlab slab;
  DrawingTracer tracer(slab, kRectangleBox, workers);
  ViewOptions view = view_of({2, 1, 0, 0, 0, 0, 9});
  view.width = view.height = 1024;  // several batches of rays
  std::stop_source stop;
  const PartSeen once = [&](const Frame&, const PixelRect& part) {
    EXPECT_EQ(part.x1, 1024);
    EXPECT_FALSE(stop.stop_requested()) << "there is no second part";
    stop.request_stop();
  };
  tracer.render(make_camera(view, {}, kRectangleBox),
                {.stop = stop.get_token(), .part_seen = once});
  EXPECT_TRUE(stop.stop_requested());
}

TEST(DrawingTracer, SeesNothingOfThePlaneFromInIt) {
  const Workers workers(1);
  RectangleSlab slab;
  DrawingTracer tracer(slab, kRectangleBox, workers);
  ViewOptions view = view_of({-5, 1, 0, 2, 1, 0});
  view.width = view.height = 9;
  for (const Hit& hit : tracer.render(make_camera(view, {}, kRectangleBox)).hits)
    EXPECT_FALSE(hit.hit());
}

TEST(DrawingTracer, SeesNothingOfThePlaneBehindTheEye) {
  const Workers workers(1);
  RectangleSlab slab;
  DrawingTracer tracer(slab, kRectangleBox, workers);
  ViewOptions view = view_of({2, 1, 3, 2, 1.1, 9});
  view.width = view.height = 9;
  for (const Hit& hit : tracer.render(make_camera(view, {}, kRectangleBox)).hits)
    EXPECT_FALSE(hit.hit());
}

TEST(DrawingTracer, OfNothingNothingIsSeen) {
  const Workers workers(1);
  RectangleSlab slab;
  DrawingTracer tracer(slab, Box{}, workers);
  for (const Hit& hit : tracer.render(make_camera({}, {}, {})).hits) EXPECT_FALSE(hit.hit());
  EXPECT_EQ(slab.asked, 0u);
}

}  // namespace
}  // namespace whittle
