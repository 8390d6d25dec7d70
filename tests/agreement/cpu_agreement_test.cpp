// The cpu backend sees what the oracle sees: over the zoo, the examples and random trees, from
// three views each (one inside the model), at several leaf sizes.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include "agreement/cpu_subject.h"
#include "host/read_file.h"
#include "model/instances.h"
#include "support/casting_tracer.h"
#include "support/random_tree.h"
#include "support/read_text.h"
#include "support/zoo.h"
#include "trace/oracle/oracle.h"

namespace whittle {
namespace {

constexpr uint32_t kLeafSizes[] = {2, kAutoLeafSize, 6, 16};

SubdivideSettings leaf_size(uint32_t k) {
  SubdivideSettings settings;
  settings.leaf_size = k;
  return settings;
}

/// Reports of all views at all the given rules together; every difference fails.
AgreementReport agree(const Model& model, std::span<const SubdivideSettings> rules, int width,
                      int height) {
  const auto oracle = make_oracle_tracer(model);
  AgreementReport sum;
  for (const SubdivideSettings& settings : rules) {
    CpuSubject cpu(model, settings);
    for (const Camera& camera : cameras_for(model, width, height)) {
      const AgreementReport report = check_agreement(model, *cpu.tracer, *oracle, camera);
      EXPECT_EQ(report.unexplained, 0) << report.first_difference;
      EXPECT_EQ(report.ambiguous_unmatched, 0) << report.first_difference;
      sum += report;
    }
    EXPECT_EQ(cpu.tracer->stats().disagreements, 0u);
  }
  return sum;
}

std::vector<SubdivideSettings> all_leaf_sizes() {
  std::vector<SubdivideSettings> rules;
  for (const uint32_t k : kLeafSizes) rules.push_back(leaf_size(k));
  SubdivideSettings paper = leaf_size(2);
  paper.split = SplitRule::kXyz, paper.leaf = LeafRule::kPrimitives;
  rules.push_back(paper);
  for (const SplitRule split : {SplitRule::kOctree, SplitRule::kCost}) {
    rules.push_back(leaf_size(kAutoLeafSize));
    rules.back().split = split;
  }
  return rules;
}

// On an edge of the model, where cells meet, and looking along one of its faces: some rays run in
// the face to the last digit, and the first cell on their way ends where it begins.
TEST(CpuAgreement, AnEyeOnAnEdgeThatLooksAlongAFace) {
  const Result<Read> read = read_file(std::string(WHITTLE_EXAMPLES) + "/cheese100.csg");
  ASSERT_TRUE(read);
  const auto oracle = make_oracle_tracer(read->model);
  CpuSubject cpu(read->model, leaf_size(3));
  Camera camera;
  camera.eye = {-50, 0, 50};
  camera.forward = {1, 0, 0};
  camera.right = normalize(cross(camera.forward, Vec3{0.1, 0.2, 1}));
  camera.up = cross(camera.right, camera.forward);
  camera.half_height = 1.2;
  camera.width = camera.height = 64;
  const AgreementReport report = check_agreement(read->model, *cpu.tracer, *oracle, camera);
  EXPECT_EQ(report.unexplained, 0) << report.first_difference;
  EXPECT_EQ(report.ambiguous_unmatched, 0) << report.first_difference;
  EXPECT_EQ(cpu.tracer->stats().disagreements, 0u);
  EXPECT_GT(report.hits, 1000);
}

TEST(CpuAgreement, Zoo) {
  const std::vector<SubdivideSettings> rules = all_leaf_sizes();
  for (const ZooScene& scene : zoo()) {
    SCOPED_TRACE(scene.name);
    const Model model = model_of(scene.text, scene.name);
    agree(model, rules, 48, 36);
    CpuSubject cpu(model, leaf_size(6));
    for (const KnownRay& ray : scene.rays) {
      const Hit hit = trace_one(*cpu.tracer, ray.eye, ray.direction);
      EXPECT_EQ(hit.id, ray.id);
      if (ray.id == 0) continue;
      EXPECT_NEAR(hit.distance, ray.distance, 1e-5 * std::max(1.0, ray.distance));
      const Vec3 n = normalize(ray.normal);
      EXPECT_NEAR(hit.normal.x * n.x + hit.normal.y * n.y + hit.normal.z * n.z, 1, 1e-5);
    }
  }
}

std::vector<std::string> example_files() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(WHITTLE_EXAMPLES))
    if (entry.path().extension() == ".csg") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

class Examples : public testing::TestWithParam<std::string> {};

TEST_P(Examples, Agree) {
  const Result<Read> read = read_file(GetParam());
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_FALSE(read->unsupported);
  const SubdivideSettings rules[] = {leaf_size(2), leaf_size(6)};
  const AgreementReport report = agree(read->model, rules, 64, 48);
  EXPECT_GT(report.hits, report.pixels / 10);
  // Edges are few, even on a cheese.
  EXPECT_LT(report.ambiguous, report.pixels / 20);
}

INSTANTIATE_TEST_SUITE_P(CpuAgreement, Examples, testing::ValuesIn(example_files()),
                         [](const auto& example) {
                           std::string name = std::filesystem::path(example.param).stem().string();
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

/// Seeds of the random trees, in chunks that CTest can run side by side.
class RandomTrees : public testing::TestWithParam<int> {};
constexpr int kSeedsPerChunk = 125, kChunks = 8;

TEST_P(RandomTrees, Agree) {
  AgreementReport sum;
  std::vector<SubdivideSettings> rules;
  for (const uint32_t k : kLeafSizes) rules.push_back(leaf_size(k));
  for (int i = 0; i < kSeedsPerChunk; ++i) {
    const uint64_t seed = uint64_t(GetParam()) * kSeedsPerChunk + uint64_t(i) + 1;
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomTreeOptions options;
    options.primitives = 4 + int(seed % 24);
    options.halfspaces = seed % 5 == 0;
    const Model model = model_of(random_tree(seed, options));
    sum += agree(model, rules, 24, 18);
  }
  EXPECT_GT(sum.hits, sum.pixels / 5);
  EXPECT_LT(sum.ambiguous, sum.pixels / 50);
}

INSTANTIATE_TEST_SUITE_P(CpuAgreement, RandomTrees, testing::Range(0, kChunks));

TEST(CpuAgreement, CoincidentAndNearlyCoincidentRandomTrees) {
  AgreementReport sum;
  for (uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Model model = model_of(
        random_tree(seed, {.primitives = 10, .coincident = true, .nearly = seed % 2 == 0}));
    const SubdivideSettings rules[] = {leaf_size(kLeafSizes[seed % 4])};
    sum += agree(model, rules, 32, 24);
  }
  EXPECT_GT(sum.hits, sum.pixels / 5);
  EXPECT_LT(sum.ambiguous, sum.pixels / 20);
}

TEST(CpuAgreement, RaysThatAreNoCameras) {
  AgreementReport sum;
  for (uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Model model = model_of(random_tree(
        seed, {.primitives = 12, .coincident = seed % 3 == 0, .halfspaces = seed % 5 == 0}));
    const auto oracle = make_oracle_tracer(model);
    CpuSubject cpu(model, leaf_size(kLeafSizes[seed % 4]));
    CastingTracer casting(*cpu.tracer, 1e-3 * bounds(model).box.diagonal());
    for (const Camera& camera : cameras_for(model, 32, 24)) {
      const AgreementReport report = check_agreement(model, casting, *oracle, camera);
      EXPECT_EQ(report.unexplained, 0) << report.first_difference;
      EXPECT_EQ(report.ambiguous_unmatched, 0) << report.first_difference;
      sum += report;
    }
  }
  EXPECT_GT(sum.hits, sum.pixels / 5);
}

TEST(CpuAgreement, SameBytesLazilyOnOneAndEagerlyOnManyThreads) {
  for (const char* name : {"/cheese1000.csg", "/bearing-housing.csg", "/menger3.csg"}) {
    const Result<Read> read = read_file(std::string(WHITTLE_EXAMPLES) + name);
    ASSERT_TRUE(read) << read.error().message;
    SubdivideSettings one = leaf_size(6), many = leaf_size(6);
    one.threads = 1, many.threads = 7;
    CpuSubject a(read->model, one), b(read->model, many, true);
    const Camera camera = cameras_for(read->model, 256, 192)[0];
    const Frame fa = a.tracer->render(camera, {}), fb = b.tracer->render(camera, {});
    ASSERT_EQ(fa.hits.size(), fb.hits.size());
    EXPECT_EQ(std::memcmp(fa.hits.data(), fb.hits.data(), fa.hits.size() * sizeof(Hit)), 0) << name;
  }
}

}  // namespace
}  // namespace whittle
