#include "io/tree_edit.h"

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

void keep_subtree(Model& model, uint32_t root) {
  Model kept;
  const uint32_t end = model.nodes[root].end;
  kept.nodes.reserve(end - root + 1);
  kept.nodes.push_back(model.nodes[0]);
  const auto move_entry = [](auto& from, auto& to, uint32_t& index) {
    to.push_back(std::move(from[index]));
    index = static_cast<uint32_t>(to.size() - 1);
  };
  for (uint32_t i = root; i < end; ++i) {
    Node node = model.nodes[i];
    if (node.end != kRemoved) node.end = node.end - root + 1;
    if (node.kind == NodeKind::kTransform) {
      move_entry(model.transforms, kept.transforms, node.payload);
    } else if (node.kind == NodeKind::kColor) {
      move_entry(model.colors, kept.colors, node.payload);
    } else if (node.kind == NodeKind::kPrimitive) {
      move_entry(model.primitives, kept.primitives, node.payload);
    }
    kept.nodes.push_back(node);
  }
  kept.nodes[0].end = static_cast<uint32_t>(kept.nodes.size());
  model.nodes = std::move(kept.nodes);
  model.transforms = std::move(kept.transforms);
  model.colors = std::move(kept.colors);
  model.primitives = std::move(kept.primitives);
}

}  // namespace whittle
