// A piece of a document at the end of what was built before it.
#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

#include "base/large_pages.h"
#include "csg/document_builder.h"
#include "csg/tree_edit.h"

namespace whittle {
namespace {

/// Moves what is in `from` to the end of `to`. Returns how much there was in `to`.
template <class T>
uint32_t move_to_end(std::vector<T>& from, std::vector<T>& to) {
  const auto base = static_cast<uint32_t>(to.size());
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
  return base;
}

/// The same of numbers of statements, of which there were `ids` before.
void move_ids_to_end(const std::vector<uint32_t>& from, uint32_t ids, std::vector<uint32_t>& to) {
  for (const uint32_t id : from) to.push_back(id + ids);
}

/// Makes room for the rest of a table of which a share is there. The guess may be wrong: what is
/// not needed is never touched, and costs no memory.
template <class T>
void make_room_in(std::vector<T>& table, double share) {
  const double size = static_cast<double>(table.size());
  if (size + size / 8 < static_cast<double>(table.capacity()) || size < 1000) return;
  table.reserve(static_cast<size_t>(std::clamp(1.05 * size / share, 2 * size, 32 * size)));
  prefer_large_pages(table.data(), table.capacity() * sizeof(T));
}

}  // namespace

uint32_t DocumentBuilder::append(DocumentBuilder& piece, SourceLocation start,
                                 std::span<const OuterClose> closes,
                                 const std::function<void(const OuterClose&)>& close) {
  Document& from = piece.document_;
  std::vector<Node>& nodes = document_.model.nodes;
  // Only while no node is added a closed statement may turn out to be empty, which takes its node
  // and what belongs to that from the ends of the tables.
  while (!closes.empty() && closes.front().nodes == 1) {
    close(closes.front());
    closes = closes.subspan(1);
  }
  const uint32_t shift = static_cast<uint32_t>(nodes.size()) - 1;
  const uint32_t ids = document_.model.statement_count;
  std::array<uint32_t, kNodeKinds> bases{};
  const auto base_of = [&](NodeKind kind) -> uint32_t& { return bases[static_cast<size_t>(kind)]; };
  base_of(NodeKind::kTransform) = move_to_end(from.model.transforms, document_.model.transforms);
  base_of(NodeKind::kColor) = move_to_end(from.model.colors, document_.model.colors);
  for (Primitive& primitive : from.model.primitives) primitive.id += ids;
  base_of(NodeKind::kPrimitive) = move_to_end(from.model.primitives, document_.model.primitives);
  base_of(NodeKind::kLeaf) = move_to_end(from.leaves, document_.leaves);
  base_of(NodeKind::kOperation) = move_to_end(from.operations, document_.operations);
  move_ids_to_end(from.leaf_ids, ids, document_.leaf_ids);
  move_ids_to_end(from.operation_ids, ids, document_.operation_ids);
  document_.model.statement_count += from.model.statement_count;
  for (Pending curve : piece.pending_) {
    curve.payload += base_of(curve.kind);
    pending_.push_back(curve);
  }
  has_removed_ |= piece.has_removed_;

  size_t done = 1;
  const auto append_nodes_before = [&](size_t end) {
    for (; done < end; ++done) {
      Node node = from.model.nodes[done];
      // Nodes that are still open have no end yet.
      if (node.end != kRemoved) node.end += shift;
      node.payload += base_of(node.kind);
      node.where = place_in_whole(node.where, start);
      nodes.push_back(node);
    }
  };
  for (const OuterClose& one : closes) {
    append_nodes_before(one.nodes);
    close(one);
  }
  append_nodes_before(from.model.nodes.size());
  return shift;
}

uint32_t DocumentBuilder::append_scope(const DocumentBuilder& piece, uint32_t scope) {
  scopes_.push_back(piece.scopes_[scope]);
  return static_cast<uint32_t>(scopes_.size()) - 1;
}

void DocumentBuilder::make_room(double share_read) {
  make_room_in(document_.model.nodes, share_read);
  make_room_in(document_.model.transforms, share_read);
  make_room_in(document_.model.colors, share_read);
  make_room_in(document_.model.primitives, share_read);
}

}  // namespace whittle
