#include "model/copy_nodes.h"

namespace whittle {

NodeCopier::NodeCopier(const Model& from, Model& to) : from_(from), to_(to) {
  to_.file = from.file;
  to_.statement_count = from.statement_count;
  to_.view = from.view;
  to_.nodes.push_back({.where = from.nodes[0].where});
}

void NodeCopier::open(uint32_t node) {
  Node copy = from_.nodes[node];
  const uint32_t source_end = copy.end;
  copy.background = copy.highlight = false;
  const auto take = [&](const auto& source, auto& target) {
    target.push_back(source[copy.payload]);
    copy.payload = uint32_t(target.size() - 1);
  };
  if (copy.kind == NodeKind::kTransform) take(from_.transforms, to_.transforms);
  if (copy.kind == NodeKind::kColor) take(from_.colors, to_.colors);
  if (copy.kind == NodeKind::kPrimitive) take(from_.primitives, to_.primitives);
  open_.push_back({source_end, uint32_t(to_.nodes.size())});
  to_.nodes.push_back(copy);
}

void NodeCopier::open_around(NodeKind kind, uint32_t payload, uint32_t node) {
  open_.push_back({from_.nodes[node].end, uint32_t(to_.nodes.size())});
  to_.nodes.push_back({.kind = kind, .payload = payload, .where = from_.nodes[node].where});
}

void NodeCopier::open_transform(const Affine& map, uint32_t node) {
  open_around(NodeKind::kTransform, uint32_t(to_.transforms.size()), node);
  to_.transforms.push_back(map);
}

void NodeCopier::open_color(const Rgba& color, uint32_t node) {
  open_around(NodeKind::kColor, uint32_t(to_.colors.size()), node);
  to_.colors.push_back(color);
}

void NodeCopier::close_before(uint32_t node) {
  while (!open_.empty() && open_.back().source_end <= node) {
    to_.nodes[open_.back().node].end = uint32_t(to_.nodes.size());
    open_.pop_back();
  }
}

void NodeCopier::finish() {
  close_before(uint32_t(from_.nodes.size()));
  to_.nodes[0].end = uint32_t(to_.nodes.size());
}

}  // namespace whittle
