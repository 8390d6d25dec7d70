// The backend by itself: what it says of its work, its limits and its failures. That its pictures
// are right is shown in tests/agreement.
#include "trace/vulkan/raster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "gpu/vulkan.h"
#include "lower/lower.h"
#include "subdivide/subdivide.h"
#include "support/agreement.h"
#include "support/read_text.h"
#include "trace/cpu/cpu.h"

namespace whittle {
namespace {

struct Subject {
  Model model;
  Scene scene;
  CellTree cells;

  explicit Subject(const std::string& text) : model(model_of(text)) {
    scene = *lower(model);
    cells = subdivide(scene, {});
  }
  MakeTracer second_look(const CellTree& tree) const {
    return [this, tree] { return make_cpu_tracer(scene, tree); };
  }
  std::unique_ptr<RasterTracer> tracer() const { return tracer_of(cells); }
  std::unique_ptr<RasterTracer> tracer_of(const CellTree& tree) const {
    RasterSettings settings;
    settings.first_batch_ms = 0;  // as many batches as there can be
    Result<std::shared_ptr<RasterDevice>> device = open_raster_device(settings);
    EXPECT_TRUE(device) << device.error().message;
    if (!device) return nullptr;
    Result<std::unique_ptr<RasterTracer>> made =
        make_raster_tracer(*device, scene, tree, second_look(tree));
    EXPECT_TRUE(made) << made.error().message;
    return made ? *std::move(made) : nullptr;
  }
};

TEST(Raster, SaysWhatItDid) {
  const Subject subject("difference() { cube(10, center = true); sphere(r = 6); }");
  const auto tracer = subject.tracer();
  ASSERT_TRUE(tracer);
  EXPECT_STREQ(tracer->name(), "vulkan-raster");
  const Camera camera = cameras_for(subject.model, 64, 48)[0];
  tracer->render(camera, {});
  EXPECT_TRUE(tracer->status());
  EXPECT_EQ(tracer->stats().cells, statistics_of(subject.cells).leaf_count());
  EXPECT_GT(tracer->stats().in_view, tracer->stats().cells / 2);
  EXPECT_LE(tracer->stats().in_view, tracer->stats().cells);
  EXPECT_GT(tracer->stats().draw_ms, 0);
}

bool same(const Hit& a, const Hit& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

void expect_same(std::span<const Hit> a, std::span<const Hit> b) {
  EXPECT_TRUE(std::ranges::equal(a, b, same));
}

/// Cells enough for several batches, many of them hidden.
std::string holed_block() {
  std::string text = "difference() { translate([-20, -8, -20]) cube([40, 16, 40]);";
  for (int x = -16; x <= 16; x += 8)
    for (int z = -16; z <= 16; z += 8)
      text += "translate([" + std::to_string(x) + ", 0, " + std::to_string(z) +
              "]) rotate([90, 0, 0]) cylinder(r = 3, h = 12, center = true);";
  return text + "}";
}

TEST(Raster, RefinesWhileItDrawsAndLeavesOutWhatIsHidden) {
  const Subject subject(holed_block());
  const CellTree open = open_cells(subject.scene, {});
  const auto all = subject.tracer(), streaming = subject.tracer_of(open);
  ASSERT_TRUE(all && streaming);
  const std::vector<Camera> cameras = cameras_for(subject.model, 64, 48);
  const Frame expected = all->render(cameras[0], {});
  EXPECT_EQ(all->stats().batches, 0u);

  // What is shown on the way is a part of the picture, and grows.
  std::vector<int> shown;
  const PartSeen note = [&](const Frame& frame, const PixelRect&) {
    shown.push_back(0);
    for (size_t i = 0; i < frame.hits.size(); ++i) {
      if (!frame.hits[i].hit()) continue;
      EXPECT_TRUE(same(frame.hits[i], expected.hits[i]));
      ++shown.back();
    }
  };
  expect_same(streaming->render(cameras[0], {.part_seen = note}).hits, expected.hits);
  ASSERT_TRUE(streaming->status());
  const RasterStats stats = streaming->stats();
  EXPECT_GT(stats.batches, 3u);
  EXPECT_EQ(shown.size(), stats.batches) << "the last time with all that is seen";
  EXPECT_TRUE(std::ranges::is_sorted(shown));
  EXPECT_GT(shown.back(), 0);
  EXPECT_GT(stats.first_ms, 0);
  EXPECT_LT(stats.cells, all->stats().cells) << "some are hidden";

  // Later pictures see what was left out.
  for (const Camera& camera : cameras)
    expect_same(streaming->render(camera, {}).hits, all->render(camera, {}).hits);
  EXPECT_EQ(streaming->stats().batches, 0u);
}

TEST(Raster, PlacesCanBeTheFirstThatIsLookedAt) {
  const Subject subject(holed_block());
  const CellTree open = open_cells(subject.scene, {});
  const auto all = subject.tracer(), lazy = subject.tracer_of(open);
  ASSERT_TRUE(all && lazy);
  const Camera camera = cameras_for(subject.model, 16, 12)[0];
  std::vector<PixelPosition> places;
  for (float y = 0.25f; y < 12; y += 0.5f)
    for (float x = 0.25f; x < 16; x += 0.5f) places.push_back({x, y});
  std::vector<Hit> expected(places.size()), seen(places.size());
  all->probe(camera, places, expected);
  lazy->probe(camera, places, seen);
  expect_same(seen, expected);
}

TEST(Raster, SettingUpDrawsNothingAndHarmsNothing) {
  const Subject subject("difference() { cube(10, center = true); sphere(r = 6); }");
  const auto tracer = subject.tracer();
  ASSERT_TRUE(tracer);
  const Camera camera = cameras_for(subject.model, 32, 24)[0];
  const Frame expected = tracer->render(camera, {});
  tracer->set_up(camera);
  EXPECT_TRUE(tracer->status());
  expect_same(tracer->render(camera, {}).hits, expected.hits);
}

/// Whom shaders in floats ask where they are in doubt: says what nobody could have seen.
class Marker final : public Tracer {
 public:
  static constexpr Hit kMark{-1, 12345, {}};
  explicit Marker(size_t& asked) : asked_(asked) {}
  const char* name() const override { return "marker"; }
  Frame render(const Camera& camera, const RenderControl&) override {
    return Frame(camera.width, camera.height);
  }
  void probe(const Camera&, std::span<const PixelPosition> positions,
             std::span<Hit> hits) override {
    asked_ += positions.size();
    std::ranges::fill(hits, kMark);
  }
  void cast(std::span<const Ray>, std::span<Hit>) override {}

 private:
  size_t& asked_;
};

/// Of a picture of the holed block how many pixels are in doubt, while all others show what they
/// should. The cells' margin is the device's, or the least.
uint64_t in_doubt(ShaderNumbers numbers, bool least_margin) {
  RasterSettings settings;
  settings.numbers = numbers;
  const Result<std::shared_ptr<RasterDevice>> device = open_raster_device(settings);
  EXPECT_TRUE(device) << device.error().message;
  const Subject subject(holed_block());
  SubdivideSettings rules;
  if (!least_margin) rules.margin = cell_margin(**device);
  const CellTree cells = subdivide(subject.scene, rules);
  size_t asked = 0;
  const auto tracer = *make_raster_tracer(*device, subject.scene, cells,
                                          [&] { return std::make_unique<Marker>(asked); });
  const Camera camera = cameras_for(subject.model, 128, 96)[0];
  const Frame expected = make_cpu_tracer(subject.scene, cells)->render(camera, {});
  // All pixels that nobody was asked about are right.
  const auto hold = [&](std::span<const Hit> seen) {
    size_t marked = 0;
    for (size_t i = 0; i < seen.size(); ++i) {
      if (same(seen[i], Marker::kMark))
        ++marked;
      else
        EXPECT_EQ(seen[i].id, expected.hits[i].id);
    }
    EXPECT_EQ(marked, std::exchange(asked, 0));
  };
  hold(tracer->render(camera, {}).hits);
  std::vector<PixelPosition> places;
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) places.push_back({float(x) + 0.5f, float(y) + 0.5f});
  std::vector<Hit> probed(places.size());
  tracer->probe(camera, places, probed);
  hold(probed);
  return tracer->stats().in_doubt;
}

TEST(Raster, WhatFloatsCannotTellIsAskedAgainAndNothingElse) {
  const uint64_t doubtful = in_doubt(ShaderNumbers::kFloat, false);
  EXPECT_GT(doubtful, 0u);
  EXPECT_LT(doubtful, 128u * 96 / 100);
  // Where leaves are right in their cells alone, floats cannot tell what is in a cell.
  EXPECT_GT(in_doubt(ShaderNumbers::kFloat, true), 128u * 96 / 10);
  RasterSettings doubles;
  doubles.numbers = ShaderNumbers::kDouble;
  if (open_raster_device(doubles)) {
    EXPECT_EQ(in_doubt(ShaderNumbers::kDouble, true), 0u);
  }
}

TEST(Raster, AnEmptySolidIsAnEmptyPicture) {
  const Subject subject("difference() { cube(1); cube(1); }");
  const auto tracer = subject.tracer();
  ASSERT_TRUE(tracer);
  Camera camera;
  camera.width = camera.height = 8;
  for (const Hit& hit : tracer->render(camera, {}).hits) EXPECT_FALSE(hit.hit());
  Hit hit{1, 1, {}};
  tracer->probe(camera, std::vector<PixelPosition>{{1, 1}}, {&hit, 1});
  EXPECT_FALSE(hit.hit());
}

TEST(Raster, ADeviceThatIsNotThereIsAMistakeOfTheUser) {
  RasterSettings settings;
  settings.device = "99";
  const auto made = open_raster_device(settings);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().kind, ErrorKind::kUsage);
}

/// Puts a function that fails in the place of one of Vulkan's, for as long as it lives.
template <class Function>
class Failing {
 public:
  Failing(Function& place, Function failing) : place_(place), real_(place) { place_ = failing; }
  ~Failing() { place_ = real_; }
  Failing(const Failing&) = delete;

 private:
  Function& place_;
  Function real_;
};

TEST(Raster, ALostDeviceIsSaidOnceAndAllPicturesSinceAreEmpty) {
  const Subject subject("cube(10, center = true);");
  const auto tracer = subject.tracer();
  ASSERT_TRUE(tracer);
  const Camera camera = cameras_for(subject.model, 16, 16)[0];
  {
    const Failing lose(
        vkQueueSubmit2,
        PFN_vkQueueSubmit2([](VkQueue, uint32_t, const VkSubmitInfo2*, VkFence) -> VkResult {
          return VK_ERROR_DEVICE_LOST;
        }));
    const Frame frame = tracer->render(camera, {});
    ASSERT_EQ(frame.hits.size(), 256u);
    for (const Hit& hit : frame.hits) EXPECT_FALSE(hit.hit());
  }
  ASSERT_FALSE(tracer->status());
  EXPECT_EQ(tracer->status().error().kind, ErrorKind::kMachine);
  EXPECT_NE(tracer->status().error().message.find(": the device was lost"), std::string::npos);
  for (const Hit& hit : tracer->render(camera, {}).hits) EXPECT_FALSE(hit.hit());
}

TEST(Raster, OutOfMemoryIsAnError) {
  const Subject subject("cube(10, center = true);");
  const Result<std::shared_ptr<RasterDevice>> device = open_raster_device();
  ASSERT_TRUE(device) << device.error().message;
  const Failing full(
      vkAllocateMemory,
      PFN_vkAllocateMemory(
          [](VkDevice, const VkMemoryAllocateInfo*, const VkAllocationCallbacks*,
             VkDeviceMemory*) -> VkResult { return VK_ERROR_OUT_OF_DEVICE_MEMORY; }));
  const auto made =
      make_raster_tracer(*device, subject.scene, subject.cells, subject.second_look(subject.cells));
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().kind, ErrorKind::kMachine);
  EXPECT_NE(made.error().message.find(": out of memory"), std::string::npos);
}

}  // namespace
}  // namespace whittle
