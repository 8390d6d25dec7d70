#include "trace/oracle/boolean_tree.h"

#include <algorithm>
#include <limits>

#include "base/result.h"

namespace whittle {

namespace {

constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

}  // namespace

BooleanTree make_boolean_tree(const Model& model) {
  BooleanTree tree;
  std::vector<uint32_t> open;
  for (uint32_t i = 0; i < model.nodes.size();) {
    const Node& node = model.nodes[i];
    if (node.background) {
      i = node.end;
      continue;
    }
    while (!open.empty() && model.nodes[tree.nodes[open.back()].model_node].end <= i)
      open.pop_back();
    const uint32_t index = uint32_t(tree.nodes.size());
    const uint32_t parent = open.empty() ? 0 : open.back();
    const bool is_first = !open.empty() && tree.nodes[parent].operands++ == 0;
    tree.nodes.push_back({.kind = node.kind,
                          .parent = parent,
                          .operands = 0,
                          .is_first = is_first,
                          .model_node = i});
    if (node.kind == NodeKind::kPrimitive)
      tree.leaves.push_back(index);
    else
      open.push_back(index);
    ++i;
  }
  return tree;
}

BooleanState::BooleanState(const BooleanTree& tree)
    : tree_(&tree),
      value_(tree.nodes.size()),
      first_value_(tree.nodes.size()),
      true_operands_(tree.nodes.size()),
      step_of_(tree.nodes.size()),
      before_(tree.nodes.size()),
      first_changed_(tree.nodes.size(), kNone),
      leaf_of_(tree.nodes.size(), kNone) {
  for (uint32_t leaf = 0; leaf < tree.leaves.size(); ++leaf) leaf_of_[tree.leaves[leaf]] = leaf;
  begin_step();
}

void BooleanState::begin_step() {
  ++step_;
  touched_.clear();
}

void BooleanState::set(uint32_t node, bool value) {
  if (step_of_[node] != step_) {
    step_of_[node] = step_;
    before_[node] = value_[node];
    touched_.push_back(node);
  }
  value_[node] = value;
}

bool BooleanState::evaluate(uint32_t node) const {
  const BooleanTree::Node& n = tree_->nodes[node];
  switch (n.kind) {
    case NodeKind::kDifference:
      return first_value_[node] && true_operands_[node] == 0;
    case NodeKind::kIntersection:
      return true_operands_[node] == n.operands;
    default:
      return true_operands_[node] > 0;
  }
}

void BooleanState::flip(uint32_t leaf) {
  uint32_t node = tree_->leaves[leaf];
  set(node, !value_[node]);
  while (node != 0) {
    const uint32_t parent = tree_->nodes[node].parent;
    if (tree_->nodes[parent].kind == NodeKind::kDifference && tree_->nodes[node].is_first)
      first_value_[parent] = value_[node];
    else
      value_[node] ? ++true_operands_[parent] : --true_operands_[parent];
    const bool now = evaluate(parent);
    if (now == bool(value_[parent])) return;
    set(parent, now);
    node = parent;
  }
}

uint32_t BooleanState::owner() {
  WHITTLE_CHECK(has_changed());
  for (const uint32_t node : touched_) first_changed_[node] = kNone;
  for (const uint32_t node : touched_) {
    if (node == 0 || !is_changed(node)) continue;
    uint32_t& first = first_changed_[tree_->nodes[node].parent];
    first = std::min(first, node);
  }
  uint32_t node = 0;
  while (tree_->nodes[node].kind != NodeKind::kPrimitive) {
    node = first_changed_[node];
    WHITTLE_CHECK(node != kNone);
  }
  return leaf_of_[node];
}

}  // namespace whittle
