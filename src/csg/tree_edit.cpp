#include "csg/tree_edit.h"

#include <utility>
#include <vector>

namespace whittle {

void remove_marked(Model& model) {
  std::vector<Node>& nodes = model.nodes;
  std::vector<uint32_t> new_index(nodes.size() + 1);
  uint32_t kept = 0;
  for (size_t i = 0; i < nodes.size(); ++i) {
    new_index[i] = kept;
    kept += nodes[i].end != kRemoved;
  }
  new_index[nodes.size()] = kept;
  if (kept == nodes.size()) return;
  for (size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].end == kRemoved) continue;
    Node& target = nodes[new_index[i]];
    target = nodes[i];
    target.end = new_index[target.end];
  }
  nodes.resize(kept);
}

void keep_subtree(Document& document, uint32_t root) {
  Model& model = document.model;
  Document kept;
  const uint32_t end = model.nodes[root].end;
  kept.model.nodes.reserve(end - root + 1);
  kept.model.nodes.push_back(model.nodes[0]);
  const auto move_entry = [](auto& from, auto& to, uint32_t index) {
    to.push_back(std::move(from[index]));
    return static_cast<uint32_t>(to.size() - 1);
  };
  for (uint32_t i = root; i < end; ++i) {
    Node node = model.nodes[i];
    if (node.end != kRemoved) node.end = node.end - root + 1;
    const uint32_t payload = node.payload;
    if (node.kind == NodeKind::kTransform) {
      node.payload = move_entry(model.transforms, kept.model.transforms, payload);
    } else if (node.kind == NodeKind::kColor) {
      node.payload = move_entry(model.colors, kept.model.colors, payload);
    } else if (node.kind == NodeKind::kPrimitive) {
      node.payload = move_entry(model.primitives, kept.model.primitives, payload);
    } else if (node.kind == NodeKind::kLeaf) {
      move_entry(document.leaf_ids, kept.leaf_ids, payload);
      node.payload = move_entry(document.leaves, kept.leaves, payload);
    } else if (node.kind == NodeKind::kOperation) {
      move_entry(document.operation_ids, kept.operation_ids, payload);
      node.payload = move_entry(document.operations, kept.operations, payload);
    }
    kept.model.nodes.push_back(node);
  }
  kept.model.nodes[0].end = static_cast<uint32_t>(kept.model.nodes.size());
  model.nodes = std::move(kept.model.nodes);
  model.transforms = std::move(kept.model.transforms);
  model.colors = std::move(kept.model.colors);
  model.primitives = std::move(kept.model.primitives);
  document.leaves = std::move(kept.leaves);
  document.operations = std::move(kept.operations);
  document.leaf_ids = std::move(kept.leaf_ids);
  document.operation_ids = std::move(kept.operation_ids);
}

}  // namespace whittle
