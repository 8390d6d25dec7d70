// The vulkan-raster backend sees what the oracle sees: over the zoo, the examples and random trees,
// from three views each (one inside the model), at several leaf sizes, and Vulkan's validation
// layer has nothing to complain about. Where there is no device, these tests fail.
#include <gtest/gtest.h>

#include <filesystem>

#include "agreement/raster_subject.h"
#include "io/read.h"
#include "support/random_tree.h"
#include "support/read_text.h"
#include "support/zoo.h"
#include "trace/oracle/oracle.h"

namespace whittle {
namespace {

SubdivideSettings leaf_size(uint32_t k) {
  SubdivideSettings settings;
  settings.leaf_size = k;
  return settings;
}

class RasterAgreement : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    RasterSettings settings;
    settings.validate = true;
    settings.first_batch_ms = 0;  // as many batches as there can be
    Result<std::shared_ptr<RasterDevice>> opened = open_raster_device(settings);
    ASSERT_TRUE(opened) << opened.error().message;
    device = *std::move(opened);
  }
  static void TearDownTestSuite() { device.reset(); }
  void SetUp() override { ASSERT_TRUE(device); }
  void TearDown() override {
    if (!device) return;
    for (const std::string& message : validation_messages(*device)) ADD_FAILURE() << message;
  }

  /// Reports of all views at all the given leaf sizes together; every difference fails.
  static AgreementReport agree(const Model& model, std::initializer_list<uint32_t> leaf_sizes,
                               int width, int height) {
    const auto oracle = make_oracle_tracer(model);
    AgreementReport sum;
    for (const uint32_t k : leaf_sizes) {
      constexpr uint32_t kEager = 4;
      RasterSubject subject(device, model, leaf_size(k), k == kEager);
      for (const Camera& camera : cameras_for(model, width, height)) {
        const AgreementReport report = find_differences(model, *subject.tracer, *oracle, camera);
        EXPECT_EQ(report.unexplained, 0) << "leaf size " << k << '\n' << report.first_difference;
        EXPECT_EQ(report.ambiguous_unmatched, 0) << "leaf size " << k << '\n'
                                                 << report.first_difference;
        sum += report;
      }
      EXPECT_TRUE(subject.tracer->status()) << subject.tracer->status().error().message;
    }
    return sum;
  }

  static std::shared_ptr<RasterDevice> device;
};
std::shared_ptr<RasterDevice> RasterAgreement::device;

/// Makes its pictures of probes: of a coarse picture's pixels each is looked at in 4 x 4 places.
class ProbingTracer final : public Tracer {
 public:
  static constexpr int kFiner = 4;
  explicit ProbingTracer(Tracer& inner) : inner_(inner) {}
  const char* name() const override { return "probing"; }
  Frame render(const Camera& camera, const Progress&) override {
    Frame frame(camera.width, camera.height);
    Camera coarse = camera;
    coarse.width /= kFiner, coarse.height /= kFiner;
    std::vector<PixelPosition> places;
    for (int y = 0; y < camera.height; ++y)
      for (int x = 0; x < camera.width; ++x)
        places.push_back({(float(x) + 0.5f) / kFiner, (float(y) + 0.5f) / kFiner});
    inner_.probe(coarse, places, frame.hits);
    return frame;
  }
  void probe(const Camera& camera, std::span<const PixelPosition> positions,
             std::span<Hit> hits) override {
    inner_.probe(camera, positions, hits);
  }

 private:
  Tracer& inner_;
};

TEST_F(RasterAgreement, ProbesAnywhereInAPixel) {
  int hits = 0;
  for (const char* name : {"/gear.csg", "/cheese100.csg", "/bearing-housing.csg"}) {
    const Result<Read> read = read_file(std::string(WHITTLE_EXAMPLES) + name);
    ASSERT_TRUE(read) << read.error().message;
    const auto oracle = make_oracle_tracer(read->model);
    RasterSubject subject(device, read->model, leaf_size(6));
    ProbingTracer probing(*subject.tracer);
    for (const Camera& camera : cameras_for(read->model, 96, 72)) {
      const AgreementReport report = find_differences(read->model, probing, *oracle, camera);
      EXPECT_EQ(report.unexplained, 0) << report.first_difference;
      EXPECT_EQ(report.ambiguous_unmatched, 0) << report.first_difference;
      hits += report.hits;
    }
  }
  EXPECT_GT(hits, 10000);
}

TEST_F(RasterAgreement, Zoo) {
  for (const ZooScene& scene : zoo()) {
    SCOPED_TRACE(scene.name);
    const Model model = model_of(scene.text, scene.name);
    agree(model, {2, 6}, 48, 36);
    RasterSubject subject(device, model, leaf_size(4));
    for (const KnownRay& ray : scene.rays) {
      const Hit hit = trace_one(*subject.tracer, ray.eye, ray.direction);
      EXPECT_EQ(hit.id, ray.id);
      if (ray.id == 0) continue;
      EXPECT_NEAR(hit.distance, ray.distance, 1e-5 * std::max(1.0, ray.distance));
      const Vec3 n = normalize(ray.normal);
      EXPECT_NEAR(hit.normal.x * n.x + hit.normal.y * n.y + hit.normal.z * n.z, 1, 1e-5);
    }
  }
}

TEST_F(RasterAgreement, Examples) {
  for (const auto& entry : std::filesystem::recursive_directory_iterator(WHITTLE_EXAMPLES)) {
    if (entry.path().extension() != ".csg") continue;
    SCOPED_TRACE(entry.path().string());
    const Result<Read> read = read_file(entry.path().string());
    ASSERT_TRUE(read) << read.error().message;
    const AgreementReport report = agree(read->model, {2, 4, 6}, 64, 48);
    EXPECT_GT(report.hits, report.pixels / 10);
  }
}

TEST_F(RasterAgreement, RandomTrees) {
  AgreementReport sum;
  for (uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomTreeOptions options;
    options.primitives = 4 + int(seed % 24);
    options.halfspaces = seed % 5 == 0;
    options.coincident = seed % 3 == 0;
    options.nearly = seed % 6 == 0;
    const Model model = model_of(random_tree(seed, options));
    sum += agree(model, {uint32_t(2 + seed % 8)}, 24, 18);
  }
  EXPECT_GT(sum.hits, sum.pixels / 5);
}

}  // namespace
}  // namespace whittle
