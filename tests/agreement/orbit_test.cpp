// By the paper's rules cells end where they look small. One tree serves all cameras: each picture
// is the one that is made afresh, to the bit, and little is refined for it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>

#include "host/read_file.h"
#include "whittle/paper_settings_for_test.h"
#include "whittle/renderer.h"

namespace whittle {
namespace {

/// A renderer that keeps its cells, beside one that makes them afresh.
class Orbit {
 public:
  Orbit(const char* example, Backend backend, Refine refine)
      : model_(read_file(std::string(WHITTLE_EXAMPLES) + "/" + example, {})->model),
        refine_(refine),
        kept_(*Renderer::make(model_, paper_settings(backend))),
        fresh_(*Renderer::make(model_, paper_settings(backend))) {}

  Camera camera(double turn, double distance) {
    ViewOptions view;
    view.width = view.height = 128;
    view.target = Vec3{0, 0, 0};
    view.rotation_degrees = Vec3{55, 0, turn};
    view.distance = distance;
    return kept_.camera(view);
  }

  /// All that the picture may need.
  void start(const Camera& camera) {
    ASSERT_TRUE(kept_.prepare(camera, refine_));
    for (int i = 0; i < 2; ++i) ASSERT_TRUE(kept_.trace(camera));
    before_ = refined(kept_);
  }

  /// Compares the picture with the one that is made afresh; `shades`: places between pixels too.
  /// The share of the cells that it refines anew, of those that are refined afresh.
  void step(const Camera& camera, bool shades, double& share) {
    fresh_.discard();
    ASSERT_TRUE(fresh_.prepare(camera, refine_));
    const Result<Frame> expected = fresh_.trace(camera), frame = kept_.trace(camera);
    ASSERT_TRUE(expected && frame);
    EXPECT_EQ(
        std::memcmp(frame->hits.data(), expected->hits.data(), frame->hits.size() * sizeof(Hit)),
        0);
    hits_ += std::ranges::count_if(frame->hits, [](const Hit& hit) { return hit.hit(); });
    share = double(refined(kept_) - before_) / double(refined(fresh_));
    before_ = refined(kept_);
    if (!shades) return;
    EXPECT_EQ(kept_.shade(*frame, camera, {}, 2)->rgba,
              fresh_.shade(*expected, camera, {}, 2)->rgba);
  }
  /// Pixels so far.
  ptrdiff_t hits() const { return hits_; }

 private:
  static uint64_t refined(const Renderer& renderer) {
    return statistics_of(*renderer.cells()).refined;
  }

  Model model_;
  Refine refine_;
  Renderer kept_, fresh_;
  uint64_t before_ = 0;
  ptrdiff_t hits_ = 0;
};

void expect_little_work(Orbit& orbit) {
  orbit.start(orbit.camera(25, 420));
  double sum = 0;
  constexpr int kDegrees = 16;
  for (int degree = 1; degree <= kDegrees; ++degree) {
    SCOPED_TRACE(degree);
    double share = 0;
    ASSERT_NO_FATAL_FAILURE(orbit.step(orbit.camera(25 + degree, 420), false, share));
    EXPECT_LT(share, 0.05);
    sum += share;
  }
  EXPECT_GT(sum, 0);
  EXPECT_GT(orbit.hits(), kDegrees * 2000);
}

/// Near, inside, and so far that the whole model is small.
void expect_the_same_anywhere(Orbit& orbit) {
  for (const double distance : {250.0, 80.0, 20.0, 500.0, 1e5, 400.0, 1500.0, 1e5, 420.0, 80.0}) {
    SCOPED_TRACE(distance);
    double share = 0;
    ASSERT_NO_FATAL_FAILURE(orbit.step(orbit.camera(distance, distance), true, share));
  }
}

TEST(Orbit, OnTheCpu) {
  Orbit orbit("cheese100.csg", Backend::kCpu, Refine::kAll);
  expect_little_work(orbit);
  expect_the_same_anywhere(orbit);
}

TEST(Orbit, OnAVulkanDevice) {
  Orbit orbit("cheese100.csg", Backend::kVulkanRaster, Refine::kWhereRaysCome);
  expect_little_work(orbit);
  expect_the_same_anywhere(orbit);
}

}  // namespace
}  // namespace whittle
