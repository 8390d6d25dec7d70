// The backend by itself: what it says of its work, its limits and its failures. That its pictures
// are right is shown in tests/agreement.
#include "trace/vulkan/raster.h"

#include <gtest/gtest.h>

#include "gpu/vulkan.h"
#include "lower/lower.h"
#include "subdivide/subdivide.h"
#include "support/agreement.h"
#include "support/read_text.h"

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
  std::unique_ptr<RasterTracer> tracer() const {
    Result<std::shared_ptr<RasterDevice>> device = open_raster_device();
    EXPECT_TRUE(device) << device.error().message;
    if (!device) return nullptr;
    Result<std::unique_ptr<RasterTracer>> made = make_raster_tracer(*device, scene, cells);
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
  const auto made = make_raster_tracer(*device, subject.scene, subject.cells);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().kind, ErrorKind::kMachine);
  EXPECT_NE(made.error().message.find(": out of memory"), std::string::npos);
}

}  // namespace
}  // namespace whittle
