#include "image/ordered_cast.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace whittle {
namespace {

/// Meets everything at the distance that the ray's start says, and keeps the rays.
class Echo final : public Tracer {
 public:
  const char* name() const override { return "echo"; }
  Frame render(const Camera&, const RenderControl& = {}) override { return {1, 1}; }
  void probe(const Camera&, std::span<const PixelPosition>, std::span<Hit>) override {}
  void cast(std::span<const Ray> rays, std::span<Hit> hits) override {
    for (size_t i = 0; i < rays.size(); ++i) hits[i] = {float(rays[i].origin.x), 1, {}};
    all.insert(all.end(), rays.begin(), rays.end());
  }
  std::vector<Ray> all;
};

constexpr size_t kColumns = 500, kRows = 301;

/// All ways in turn.
Ray ray_from_place(uint32_t place) {
  const double angle = 2.4 * place, z = std::fmod(place * 0.618, 2.0) - 1;
  const double r = std::sqrt(1 - z * z);
  return {{double(place), 0, 0}, {r * std::cos(angle), r * std::sin(angle), z}};
}

TEST(OrderedCast, PatchesHoldThePlacesThatLookOnceEach) {
  const auto looks = [](size_t x, size_t y) { return (x + 2 * y) % 3 != 0; };
  const std::vector<uint32_t> places = places_in_patches(kColumns, kRows, looks);
  const std::set<uint32_t> all(places.begin(), places.end());
  EXPECT_EQ(all.size(), places.size());
  for (size_t y = 0; y < kRows; ++y)
    for (size_t x = 0; x < kColumns; ++x)
      EXPECT_EQ(all.count(uint32_t(y * kColumns + x)), size_t(looks(x, y)));
}

TEST(OrderedCast, EveryPlaceGetsWhatItsOwnRayMeets) {
  Echo tracer;
  const Workers workers(3);
  OrderedCast cast(tracer, kColumns, workers);
  const std::vector<uint32_t> places =
      places_in_patches(kColumns, kRows, [](size_t, size_t) { return true; });
  ASSERT_GT(places.size(), OrderedCast::kMostRays);
  std::vector<int> uses(kColumns * kRows);
  cast(places, {}, ray_from_place, [&](uint32_t place, const Hit& hit) {
    EXPECT_EQ(hit.distance, float(place));
    ++uses[place];
  });
  EXPECT_EQ(std::ranges::count(uses, 1), ptrdiff_t(uses.size()));
}

TEST(OrderedCast, NeighboursGoTheSameWay) {
  Echo tracer;
  const Workers workers(2);
  OrderedCast cast(tracer, kColumns, workers);
  cast(places_in_patches(kColumns, kRows, [](size_t, size_t) { return true; }), {}, ray_from_place,
       [](uint32_t, const Hit&) {});
  size_t turns = 0;
  double cosines = 0;
  for (size_t i = 1; i < tracer.all.size(); ++i) {
    const Vec3 a = tracer.all[i - 1].direction, b = tracer.all[i].direction;
    turns += a.x * b.x < 0 || a.y * b.y < 0 || a.z * b.z < 0;
    cosines += dot(a, b);
  }
  EXPECT_LT(turns, tracer.all.size() / 200);
  EXPECT_GT(cosines / double(tracer.all.size()), 0.9);
}

TEST(OrderedCast, StopsWhenItIsToldTo) {
  Echo tracer;
  const Workers workers(1);
  OrderedCast cast(tracer, kColumns, workers);
  std::stop_source stop;
  stop.request_stop();
  cast(places_in_patches(kColumns, kRows, [](size_t, size_t) { return true; }), stop.get_token(),
       ray_from_place, [](uint32_t, const Hit&) { FAIL(); });
  EXPECT_TRUE(tracer.all.empty());
}

}  // namespace
}  // namespace whittle
