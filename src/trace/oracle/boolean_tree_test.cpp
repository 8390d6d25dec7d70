#include "trace/oracle/boolean_tree.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "model/instances.h"
#include "support/random_tree.h"
#include "support/read_text.h"

namespace whittle {
namespace {

/// Operands of a node that are not under %, in file order.
std::vector<uint32_t> operands(const Model& model, uint32_t node) {
  std::vector<uint32_t> found;
  for (uint32_t i = node + 1; i < model.nodes[node].end; i = model.nodes[i].end)
    if (!model.nodes[i].background) found.push_back(i);
  return found;
}

/// The value of every node by definition; `inside` is indexed by the primitive's place in the
/// model.
std::vector<bool> values(const Model& model, const std::vector<bool>& inside) {
  std::vector<bool> value(model.nodes.size());
  for (uint32_t i = uint32_t(model.nodes.size()); i-- > 0;) {
    const Node& node = model.nodes[i];
    const std::vector<uint32_t> below = operands(model, i);
    const auto is_true = [&](uint32_t n) { return bool(value[n]); };
    switch (node.kind) {
      case NodeKind::kPrimitive:
        value[i] = inside[node.payload];
        break;
      case NodeKind::kIntersection:
        value[i] = !below.empty() && std::ranges::all_of(below, is_true);
        break;
      case NodeKind::kDifference:
        value[i] = !below.empty() && is_true(below[0]) &&
                   std::none_of(below.begin() + 1, below.end(), is_true);
        break;
      default:
        value[i] = std::ranges::any_of(below, is_true);
    }
  }
  return value;
}

TEST(BooleanState, IsTheDefinitionAfterAnyFlips) {
  std::mt19937 random(1);
  for (uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Model model = model_of(random_tree(seed, {.primitives = 15}));
    const std::vector<Instance> leaves = instances(model);
    const BooleanTree tree = make_boolean_tree(model);
    ASSERT_EQ(tree.leaves.size(), leaves.size());
    if (leaves.empty()) continue;
    BooleanState state(tree);
    std::vector<bool> inside(model.primitives.size());
    std::vector<bool> before = values(model, inside);
    for (int step = 0; step < 200; ++step) {
      state.begin_step();
      for (auto flips = 1 + random() % 3; flips > 0; --flips) {
        const uint32_t leaf = uint32_t(random() % leaves.size());
        state.flip(leaf);
        inside[leaves[leaf].primitive] = !inside[leaves[leaf].primitive];
        ASSERT_EQ(state.is_inside(leaf), inside[leaves[leaf].primitive]);
      }
      const std::vector<bool> after = values(model, inside);
      ASSERT_EQ(state.value(), after[0]);
      ASSERT_EQ(state.has_changed(), after[0] != before[0]);
      if (state.has_changed()) {
        uint32_t node = 0;
        while (model.nodes[node].kind != NodeKind::kPrimitive)
          for (const uint32_t operand : operands(model, node))
            if (after[operand] != before[operand]) {
              node = operand;
              break;
            }
        ASSERT_EQ(leaves[state.owner()].node, node);
      }
      before = after;
    }
  }
}

}  // namespace
}  // namespace whittle
