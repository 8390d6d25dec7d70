#include "evaluate/background.h"

#include "model/copy_nodes.h"

namespace whittle {
namespace {

/// What stands around a node.
struct Around {
  uint32_t end = 0;  ///< of the node that adds to it
  Affine map;
  Rgba color;  ///< the outermost valid one
};

class Copier {
 public:
  explicit Copier(const Document& document) : from_(document), copier_(document.model, to_.model) {}

  void add(uint32_t marked, const Around& around) {
    copier_.close_before(marked);
    if (around.map != Affine{}) copier_.open_transform(around.map, marked);
    if (around.color.is_valid()) copier_.open_color(around.color, marked);
    const std::vector<Node>& nodes = from_.model.nodes;
    for (uint32_t i = marked; i < nodes[marked].end;) {
      if (i != marked && nodes[i].background) {
        i = nodes[i].end;
        continue;
      }
      copier_.close_before(i);
      open(i++);
    }
    copier_.close_before(nodes[marked].end);
  }

  Document take() {
    copier_.finish();
    return std::move(to_);
  }

 private:
  void open(uint32_t i) {
    copier_.open(i);
    Node& node = to_.model.nodes.back();
    const uint32_t payload = node.payload;
    if (node.kind == NodeKind::kLeaf) {
      node.payload = uint32_t(to_.leaves.size());
      to_.leaves.push_back(from_.leaves[payload]);
      to_.leaf_ids.push_back(from_.leaf_ids[payload]);
    } else if (node.kind == NodeKind::kOperation) {
      node.payload = uint32_t(to_.operations.size());
      to_.operations.push_back(from_.operations[payload]);
      to_.operation_ids.push_back(from_.operation_ids[payload]);
    }
  }

  const Document& from_;
  Document to_;
  NodeCopier copier_;
};

}  // namespace

Document background_of(const Document& document) {
  const Model& model = document.model;
  Copier copier(document);
  std::vector<Around> scopes{{.end = uint32_t(model.nodes.size()), .map = {}, .color = {}}};
  for (uint32_t i = 1; i < model.nodes.size();) {
    const Node& node = model.nodes[i];
    while (scopes.back().end <= i) scopes.pop_back();
    Around around = scopes.back();
    if (node.background) copier.add(i, around);
    if (node.kind == NodeKind::kOperation) {
      i = node.end;
      continue;
    }
    if (node.kind == NodeKind::kTransform) around.map = around.map * model.transforms[node.payload];
    if (node.kind == NodeKind::kColor && !around.color.is_valid())
      around.color = model.colors[node.payload];
    if (node.kind == NodeKind::kTransform || node.kind == NodeKind::kColor) {
      around.end = node.end;
      scopes.push_back(around);
    }
    ++i;
  }
  return copier.take();
}

}  // namespace whittle
