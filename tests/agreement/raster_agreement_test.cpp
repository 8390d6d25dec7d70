// The vulkan-raster backend sees what the oracle sees: over the zoo, the examples and random trees,
// from three views each (one inside the model), at several leaf sizes. Whichever shaders solve the
// cells, and whether hidden cells are left out, the facts are the same to the bit. And Vulkan's
// validation layer has nothing to complain about. Where there is no device, these tests fail.
//
// With the argument --floats the shaders compute in single precision, whatever the device can do,
// and the longer tests look at less.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "agreement/raster_subject.h"
#include "host/read_file.h"
#include "model/instances.h"
#include "support/casting_tracer.h"
#include "support/random_tree.h"
#include "support/read_text.h"
#include "support/zoo.h"
#include "trace/oracle/oracle.h"
#include "trace/pixel_threshold.h"

namespace whittle {
namespace {

/// What main() was told.
ShaderNumbers& numbers() {
  static ShaderNumbers numbers = ShaderNumbers::kAuto;
  return numbers;
}
bool is_short() {
  return numbers() == ShaderNumbers::kFloat;
}

SubdivideSettings leaf_size(uint32_t k) {
  SubdivideSettings settings;
  settings.leaf_size = k;
  return settings;
}

bool same_bytes(const Frame& a, const Frame& b) {
  return a.hits.size() == b.hits.size() &&
         std::memcmp(a.hits.data(), b.hits.data(), a.hits.size() * sizeof(Hit)) == 0;
}

/// Two tracers that must give the same facts.
class Pair final : public Tracer {
 public:
  Pair(Tracer& first, Tracer& second) : first_(first), second_(second) {}
  const char* name() const override { return "pair"; }
  Frame render(const Camera& camera, const RenderControl&) override {
    Frame frame = first_.render(camera, {});
    EXPECT_TRUE(same_bytes(frame, second_.render(camera, {})));
    return frame;
  }
  void probe(const Camera& camera, std::span<const PixelPosition> positions,
             std::span<Hit> hits) override {
    first_.probe(camera, positions, hits);
  }
  void cast(std::span<const Ray> rays, std::span<Hit> hits) override { first_.cast(rays, hits); }

 private:
  Tracer &first_, &second_;
};

class RasterAgreement : public testing::Test {
 protected:
  static std::shared_ptr<RasterDevice> open(ShaderCases shaders, bool culling) {
    RasterSettings settings;
    settings.numbers = numbers();
    settings.shaders = shaders;
    settings.culling = culling;
    settings.first_batch_ms = 0;  // as many batches as there can be
    settings.validate = true;
    Result<std::shared_ptr<RasterDevice>> opened = open_raster_device(settings);
    EXPECT_TRUE(opened) << opened.error().message;
    return opened ? *std::move(opened) : nullptr;
  }
  static void SetUpTestSuite() {
    device = open(ShaderCases::kSpecialised, true);
    unified = open(ShaderCases::kUnified, true);
    without_culling = open(ShaderCases::kSpecialised, false);
  }
  static void TearDownTestSuite() {
    device.reset();
    unified.reset();
    without_culling.reset();
  }
  void SetUp() override { ASSERT_TRUE(device && unified && without_culling); }
  void TearDown() override {
    for (const auto& used : {device, unified, without_culling})
      if (used)
        for (const std::string& message : validation_messages(*used)) ADD_FAILURE() << message;
  }

  /// What the first of the pair shows is what the oracle shows, and what the second shows.
  static AgreementReport compare(const Model& model, Tracer& specialised, Tracer& other,
                                 Tracer& oracle, const Camera& camera) {
    Pair pair(specialised, other);
    const AgreementReport report = find_differences(model, pair, oracle, camera);
    EXPECT_EQ(report.unexplained, 0) << report.first_difference;
    EXPECT_EQ(report.ambiguous_unmatched, 0) << report.first_difference;
    return report;
  }

  /// Reports of all the cameras at all the given rules together; every difference fails.
  static AgreementReport agree(const Model& model, std::span<const SubdivideSettings> rules,
                               std::span<const Camera> cameras) {
    const auto oracle = make_oracle_tracer(model);
    AgreementReport sum;
    for (const SubdivideSettings& settings : rules) {
      SCOPED_TRACE("leaf size " + std::to_string(settings.leaf_size));
      // One of them refines its cells while it draws them.
      RasterSubject subject(device, model, settings), other(unified, model, settings, true);
      for (const Camera& camera : cameras)
        sum += compare(model, *subject.tracer, *other.tracer, *oracle, camera);
      EXPECT_TRUE(subject.tracer->status()) << subject.tracer->status().error().message;
      EXPECT_TRUE(other.tracer->status()) << other.tracer->status().error().message;
    }
    return sum;
  }
  static AgreementReport agree(const Model& model, std::initializer_list<uint32_t> leaf_sizes,
                               int width, int height) {
    std::vector<SubdivideSettings> rules;
    for (const uint32_t k : leaf_sizes) rules.push_back(leaf_size(k));
    return agree(model, rules, cameras_for(model, width, height));
  }

  static std::shared_ptr<RasterDevice> device, unified, without_culling;
};
std::shared_ptr<RasterDevice> RasterAgreement::device, RasterAgreement::unified,
    RasterAgreement::without_culling;

Model example(const std::string& name) {
  Result<Read> read = read_file(std::string(WHITTLE_EXAMPLES) + "/" + name);
  WHITTLE_CHECK(read);
  return std::move(read->model);
}

/// Makes its pictures of probes: of a coarse picture's pixels each is looked at in 4 x 4 places.
class ProbingTracer final : public Tracer {
 public:
  static constexpr int kFiner = 4;
  explicit ProbingTracer(Tracer& inner) : inner_(inner) {}
  const char* name() const override { return "probing"; }
  Frame render(const Camera& camera, const RenderControl&) override {
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
  void cast(std::span<const Ray> rays, std::span<Hit> hits) override { inner_.cast(rays, hits); }

 private:
  Tracer& inner_;
};

TEST_F(RasterAgreement, ProbesAnywhereInAPixel) {
  int hits = 0;
  for (const char* name : {"gear.csg", "cheese100.csg", "bearing-housing.csg"}) {
    SCOPED_TRACE(name);
    const Model model = example(name);
    const auto oracle = make_oracle_tracer(model);
    RasterSubject subject(device, model, leaf_size(6)), other(unified, model, leaf_size(6), true);
    ProbingTracer probing(*subject.tracer), probing_other(*other.tracer);
    for (const Camera& camera : cameras_for(model, 96, 72))
      hits += compare(model, probing, probing_other, *oracle, camera).hits;
  }
  EXPECT_GT(hits, 10000);
}

TEST_F(RasterAgreement, RaysThatAreNoCameras) {
  const Model model = example("cheese100.csg");
  const auto oracle = make_oracle_tracer(model);
  RasterSubject subject(device, model, leaf_size(6)), other(unified, model, leaf_size(6), true);
  const double reach = 1e-3 * bounds(model).box.diagonal();
  CastingTracer casting(*subject.tracer, reach), casting_other(*other.tracer, reach);
  for (const Camera& camera : cameras_for(model, 64, 48))
    EXPECT_GT(compare(model, casting, casting_other, *oracle, camera).hits, 300);
}

TEST_F(RasterAgreement, Zoo) {
  for (const ZooScene& scene : zoo()) {
    SCOPED_TRACE(scene.name);
    const Model model = model_of(scene.text, scene.name);
    agree(model, {2, 4, 6}, 64, 48);
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
  std::vector<SubdivideSettings> rules{leaf_size(2), leaf_size(4), leaf_size(6)};
  for (const auto& entry : std::filesystem::recursive_directory_iterator(WHITTLE_EXAMPLES)) {
    if (entry.path().extension() != ".csg") continue;
    SCOPED_TRACE(entry.path().string());
    const Result<Read> read = read_file(entry.path().string());
    ASSERT_TRUE(read) << read.error().message;
    std::rotate(rules.begin(), rules.begin() + 1, rules.end());
    const AgreementReport report = agree(read->model, std::span(rules).first(is_short() ? 1 : 3),
                                         cameras_for(read->model, 64, 48));
    EXPECT_GT(report.hits, report.pixels / 10);
  }
}

TEST_F(RasterAgreement, LargerPictures) {
  for (const char* name : {"cheese1000.csg", "bearing-housing.csg", "menger3.csg"}) {
    SCOPED_TRACE(name);
    const Model model = example(name);
    const SubdivideSettings rules[] = {leaf_size(4)};
    const std::vector<Camera> cameras = cameras_for(model, 256, 192);
    EXPECT_GT(agree(model, rules, {&cameras[0], 1}).hits, 5000);
  }
}

// At corners of cells, on faces and edges of the model, and a little beside them.
TEST_F(RasterAgreement, EyesAmongTheCells) {
  const Model model = example("cheese100.csg");
  const Box box = bounds(model).box;
  const Vec3 middle = (box.lo + box.hi) * 0.5, size = box.size();
  std::vector<Camera> cameras;
  for (const Vec3 at : {middle, box.lo, Vec3{middle.x, middle.y, box.hi.z},
                        Vec3{box.lo.x, middle.y, box.hi.z}, middle + size * 0.25}) {
    for (const double beside : {0.0, 1e-6, -1e-3}) {
      for (const Vec3 toward : {Vec3{1, 0, 0}, Vec3{-0.3, 0.5, -0.8}}) {
        Camera camera;
        camera.eye = at + size * beside;
        camera.forward = normalize(toward);
        camera.right = normalize(cross(camera.forward, Vec3{0.1, 0.2, 1}));
        camera.up = cross(camera.right, camera.forward);
        camera.half_height = 1.2;
        camera.width = camera.height = 64;
        cameras.push_back(camera);
      }
    }
  }
  const SubdivideSettings rules[] = {leaf_size(3)};
  EXPECT_GT(agree(model, rules, cameras).hits, 10000);
}

// Views that show nothing but the tips of two cones, and eyes beside them.
TEST_F(RasterAgreement, Tips) {
  const Model model = model_of(
      "cylinder(h = 10, r1 = 5, r2 = 0); translate([0, 0, 10]) cylinder(h = 10, r1 = 0, r2 = 5);"
      "translate([-1000, 0, 0]) cube(1);",
      "tips");
  const Vec3 tip = {0, 0, 10};
  std::vector<Camera> cameras;
  const auto look = [&](Vec3 from, double half_height) {
    Camera camera;
    camera.eye = tip + from;
    camera.forward = normalize(from * -1.0);
    camera.right = normalize(cross(camera.forward, Vec3{0, 0, 1}));
    camera.up = cross(camera.right, camera.forward);
    camera.half_height = half_height;
    camera.width = camera.height = 64;
    cameras.push_back(camera);
  };
  for (const double half_height : {1e-5, 1e-8}) look({8, -6, 2}, half_height);
  for (const double distance : {1e-2, 1e-5}) look(Vec3{0.3, -1, 0.01} * distance, 1.2);
  const SubdivideSettings rules[] = {leaf_size(4)};
  EXPECT_GT(agree(model, rules, cameras).hits, 4000);
}

// A camera that jumps finds cells that were seen where they are hidden now, and the other way
// round.
TEST_F(RasterAgreement, HiddenCellsAreLeftOutAndNothingElse) {
  std::vector<const char*> names{"menger3.csg", "cheese1000.csg"};
  if (is_short()) names.pop_back();
  for (const char* name : names) {
    SCOPED_TRACE(name);
    const Model model = example(name);
    RasterSubject with(device, model, leaf_size(2), true),
        without(without_culling, model, leaf_size(2), true);
    for (const int side : {64, 160}) {
      for (const Camera& camera : cameras_for(model, side, side)) {
        EXPECT_TRUE(
            same_bytes(with.tracer->render(camera, {}), without.tracer->render(camera, {})));
        const RasterStats some = with.tracer->stats(), all = without.tracer->stats();
        EXPECT_EQ(some.in_view, all.in_view);
        EXPECT_EQ(all.drawn_first, all.in_view);
        EXPECT_EQ(all.drawn_second, 0u);
        EXPECT_LE(some.drawn_first + some.drawn_second, some.in_view);
      }
    }
    const Camera camera = cameras_for(model, 128, 128)[0];
    with.tracer->render(camera, {});
    with.tracer->render(camera, {});
    const RasterStats stats = with.tracer->stats();
    EXPECT_GT(stats.drawn_first, 0u);
    EXPECT_LT(stats.drawn_first + stats.drawn_second, stats.in_view / 2);
  }
}

/// Boxes of the cells that are ignored, in local coordinates.
std::vector<Box> ignored_cells(const CellTree& tree) {
  struct Open {
    const Cell* cell;
    Box box;
  };
  std::vector<Open> open{{tree.root, tree.region}};
  std::vector<Box> ignored;
  while (!open.empty()) {
    const Open now = open.back();
    open.pop_back();
    const CellLink link = now.cell->link();
    if (link.kind() == CellKind::kIgnored) ignored.push_back(now.box);
    if (link.kind() != CellKind::kNode) continue;
    for (int side = 0; side < 2; ++side) {
      Box box = now.box;
      (side == 0 ? box.hi : box.lo)[link.axis()] = now.cell->split;
      open.push_back({link.children() + side, box});
    }
  }
  return ignored;
}

/// Whether a ray meets a box before `farthest`.
bool meets(const Ray& ray, const Box& box, double farthest) {
  double from = ray.t_min, to = farthest;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (box.lo[axis] - ray.origin[axis]) / ray.direction[axis],
                 b = (box.hi[axis] - ray.origin[axis]) / ray.direction[axis];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  return from <= to;
}

// The paper's rules: what is wrong in the picture lies in ignored cells.
TEST_F(RasterAgreement, InPaperModeOnlyIgnoredCellsDiffer) {
  for (const char* name : {"cheese100.csg", "cone100.csg", "cyl100.csg"}) {
    SCOPED_TRACE(name);
    const Model model = example(name);
    const Camera camera = cameras_for(model, 192, 144)[0];
    const Frame exact = make_oracle_tracer(model)->render(camera, {});
    for (const double threshold : {1.0, 4.0}) {
      SubdivideSettings paper = leaf_size(2);
      paper.split = SplitRule::kXyz, paper.leaf = LeafRule::kPrimitives;
      paper.ignore_small = true;
      paper.is_small = PixelThreshold(camera, threshold);
      RasterSubject subject(device, model, paper), other(unified, model, paper, true);
      const Frame seen = subject.tracer->render(camera, {});
      EXPECT_TRUE(same_bytes(seen, other.tracer->render(camera, {})));
      const std::vector<Box> ignored = ignored_cells(subject.cells);
      EXPECT_FALSE(ignored.empty());
      int differ = 0, elsewhere = 0;
      for (int y = 0; y < camera.height; ++y) {
        for (int x = 0; x < camera.width; ++x) {
          const Hit &a = seen.at(x, y), &b = exact.at(x, y);
          const double distance = std::max(a.distance, b.distance);
          if (a.id == b.id && (a.id == 0 || std::fabs(a.distance - b.distance) <= 1e-5 * distance))
            continue;
          ++differ;
          Ray ray = camera.ray(x + 0.5, y + 0.5);
          ray.origin = ray.origin - subject.scene.origin;
          // To the surface, and as far beyond as a float may be wrong.
          const double farthest = distance * (1 + 1e-6);
          if (std::ranges::none_of(ignored,
                                   [&](const Box& box) { return meets(ray, box, farthest); }))
            ++elsewhere;
        }
      }
      const double share = double(differ) / double(seen.hits.size());
      std::printf("%s, %g pixels: %zu cells ignored, %.2f %% of the pixels differ\n", name,
                  threshold, ignored.size(), 100 * share);
      EXPECT_EQ(elsewhere, 0);
      EXPECT_LT(share, 0.05 * threshold);
    }
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
    SubdivideSettings rules[] = {leaf_size(uint32_t(2 + seed % 8))};
    if (seed % 4 == 0) rules[0].leaf = LeafRule::kPrimitives, rules[0].split = SplitRule::kXyz;
    sum += agree(model, rules, cameras_for(model, 64, 48));
  }
  EXPECT_GT(sum.hits, sum.pixels / 5);
}

}  // namespace
}  // namespace whittle

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (argc > 1 && !std::strcmp(argv[1], "--floats"))
    whittle::numbers() = whittle::ShaderNumbers::kFloat;
  return RUN_ALL_TESTS();
}
