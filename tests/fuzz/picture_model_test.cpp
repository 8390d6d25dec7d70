// Are the models of random bytes worth rendering? What the picture's fuzzer finds depends on it.
#include "fuzz/picture_model.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <vector>

#include "csg/read_csg.h"
#include "lower/lower.h"
#include "model/instances.h"
#include "support/agreement.h"
#include "trace/oracle/oracle.h"

namespace whittle {
namespace {

std::vector<uint8_t> random_bytes(uint32_t seed, size_t count) {
  std::mt19937 random(seed);  // the same everywhere, unlike the standard distributions
  std::vector<uint8_t> bytes;
  while (bytes.size() < count) bytes.push_back(uint8_t(random() >> 11));
  return bytes;
}

Read read(const std::string& text) {
  Result<Read> result = read_csg(text, "fuzz.csg");
  EXPECT_TRUE(result) << result.error().message << '\n' << text;
  return result ? *std::move(result) : Read{};
}

TEST(PictureModel, EveryBytesAreAModelReadWithoutComplaint) {
  for (uint32_t seed = 0; seed < 500; ++seed) {
    const PictureInput input = decode_picture(random_bytes(seed, seed % 200), 1e-5);
    const Read result = read(input.text);
    EXPECT_TRUE(result.warnings.empty()) << result.warnings[0] << '\n' << input.text;
    EXPECT_FALSE(result.unsupported);
    // What is extruded is a statement too.
    EXPECT_GE(result.model.statement_count, uint32_t(input.primitives)) << input.text;
    EXPECT_GE(input.primitives, 1);
    EXPECT_LE(input.primitives, kMostPrimitives);
    EXPECT_LT(input.view, kViews);
  }
}

TEST(PictureModel, AllKindsComeUp) {
  std::map<size_t, int> shapes;
  std::map<NodeKind, int> nodes;
  std::map<int, int> views;
  std::map<uint32_t, int> leaf_sizes;
  int nearly = 0;
  for (uint32_t seed = 0; seed < 300; ++seed) {
    const PictureInput input = decode_picture(random_bytes(seed, 100), 1e-5);
    const Model model = read(input.text).model;
    for (const Primitive& primitive : model.primitives) ++shapes[primitive.shape.index()];
    for (const Node& node : model.nodes) ++nodes[node.kind];
    ++views[input.view], ++leaf_sizes[input.leaf_size];
    nearly += input.uses_nearly;
  }
  EXPECT_EQ(shapes.size(), std::variant_size_v<Shape>);
  EXPECT_GT(shapes[Shape(Mesh{}).index()], 100);
  for (const NodeKind kind : {NodeKind::kUnion, NodeKind::kDifference, NodeKind::kIntersection,
                              NodeKind::kTransform, NodeKind::kPrimitive})
    EXPECT_GT(nodes[kind], 100) << int(kind);
  EXPECT_GT(nodes[NodeKind::kBody], 40);
  EXPECT_EQ(views.size(), size_t(kViews));
  EXPECT_EQ(leaf_sizes.size(), 4u);
  EXPECT_GT(nearly, 100);
}

TEST(PictureModel, MostShowSomethingAndFacesCoincide) {
  int shown = 0, coincident = 0;
  constexpr int kModels = 200;
  for (uint32_t seed = 0; seed < kModels; ++seed) {
    const Model model = read(decode_picture(random_bytes(seed, 80), 0).text).model;
    const auto oracle = make_oracle_tracer(model, 1);
    const Frame frame = oracle->render(cameras_for(model, 16, 16)[0]);
    int hits = 0;
    for (const Hit& hit : frame.hits) hits += hit.hit();
    shown += hits > 8;
    const Result<Scene> scene = lower(model);
    ASSERT_TRUE(scene);
    coincident += scene->half_spaces.size() < scene->faces.size();
  }
  EXPECT_GT(shown, kModels * 3 / 4);
  EXPECT_GT(coincident, kModels * 3 / 4);
}

TEST(PictureModel, NearlyMovesByTolerances) {
  // Two cubes at one place, the second displaced along x by kNearly[0] times the tolerance.
  const uint8_t bytes[] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 3, 3, 0, 7, 0, 0, 3, 3, 3, 9};
  const PictureInput input = decode_picture(bytes, 0.25);
  EXPECT_TRUE(input.uses_nearly);
  const Model model = read(input.text).model;
  const std::vector<Instance> all = instances(model);
  ASSERT_EQ(all.size(), 2u) << input.text;
  EXPECT_EQ(all[1].world_from_object.translation.x - all[0].world_from_object.translation.x,
            kNearly[0] * 0.25);
}

}  // namespace
}  // namespace whittle
