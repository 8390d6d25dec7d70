#include "edit/tree_update.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace whittle {
namespace {

using Body = SyntaxNode::Body;

/// Children of one node that are read again, and the bytes around them up to their neighbours.
struct Siblings {
  uint32_t parent = 0;
  uint32_t first = 0, last = 0;  ///< nodes, those in them too
  TextRange range;
};

/// The innermost braces around the bytes.
uint32_t braces_around(const SyntaxTree& tree, TextRange bytes) {
  uint32_t node = tree.last_beginning_by(bytes.begin);
  for (; node != 0; node = tree.nodes[node].parent) {
    const SyntaxNode& n = tree.nodes[node];
    if (n.children != Body::kBraces) continue;
    const TextRange inside = n.inside();
    if (inside.begin <= bytes.begin && bytes.end <= inside.end) break;
  }
  return node;
}

/// The child of `parent` that `node` is or is in. Precondition: it is.
uint32_t child_around(const SyntaxTree& tree, uint32_t parent, uint32_t node) {
  while (tree.nodes[node].parent != parent) node = tree.nodes[node].parent;
  return node;
}

Siblings touched_siblings(const SyntaxTree& tree, TextRange changed) {
  const std::vector<SyntaxNode>& nodes = tree.nodes;
  Siblings siblings;
  siblings.parent = braces_around(tree, changed);
  const SyntaxNode& parent = nodes[siblings.parent];
  siblings.range = parent.inside();
  // A statement ends with a mark that nothing behind it can change; so what only touches its end
  // does not count.
  siblings.first = siblings.parent + 1;
  if (const uint32_t before = tree.last_beginning_by(changed.begin); before > siblings.parent) {
    const uint32_t child = child_around(tree, siblings.parent, before);
    siblings.first = nodes[child].end <= changed.begin ? nodes[child].last : child;
  }
  if (siblings.first > siblings.parent + 1) {
    const uint32_t neighbour = child_around(tree, siblings.parent, siblings.first - 1);
    siblings.range.begin = nodes[neighbour].end;
  }
  // But what stands right before a statement may become a part of it.
  siblings.last = siblings.first;
  if (const uint32_t until = tree.last_beginning_by(changed.end); until > siblings.parent) {
    const uint32_t child = child_around(tree, siblings.parent, until);
    siblings.last = std::max(siblings.last, nodes[child].last);
  }
  if (siblings.last < parent.last) siblings.range.end = nodes[siblings.last].begin;
  return siblings;
}

size_t depth_of(const SyntaxTree& tree, uint32_t node) {
  size_t depth = 0;
  for (; node != 0; node = tree.nodes[node].parent) ++depth;
  return depth;
}

/// Puts the children of `read`'s file in the place of the siblings.
void exchange_nodes(std::vector<SyntaxNode>& nodes, const Siblings& old, const SyntaxTree& read) {
  const size_t there = old.last - old.first, now = read.nodes.size() - 1;
  const auto at = nodes.begin() + old.first;
  const auto source = read.nodes.begin() + 1;
  std::copy_n(source, std::min(there, now), at);
  if (now < there) {
    nodes.erase(at + ptrdiff_t(now), at + ptrdiff_t(there));
  } else {
    nodes.insert(at + ptrdiff_t(there), source + ptrdiff_t(there), read.nodes.end());
  }
  for (size_t i = old.first; i < old.first + now; ++i) {
    nodes[i].last += old.first - 1;
    nodes[i].parent = nodes[i].parent == 0 ? old.parent : nodes[i].parent + old.first - 1;
  }
}

}  // namespace

bool update_tree(SyntaxTree& tree, TextRange changed, ptrdiff_t growth, std::string_view text,
                 const ReadLimits& limits) {
  const Siblings old = touched_siblings(tree, changed);
  const TextRange range{old.range.begin, size_t(ptrdiff_t(old.range.end) + growth)};
  // What may be a comment to the end of its line would go on behind what is read.
  const std::string_view again = text.substr(range.begin, range.size());
  const size_t newline = again.rfind('\n');
  const size_t last_line = newline == std::string_view::npos ? 0 : newline;
  if (range.end < text.size() && again.find("//", last_line) != std::string_view::npos)
    return false;
  SyntaxTree read;
  if (!read_statements(text, range, depth_of(tree, old.parent), limits, read)) return false;
  const ptrdiff_t more = ptrdiff_t(read.nodes.size()) - 1 - ptrdiff_t(old.last - old.first);
  if (ptrdiff_t(tree.nodes.size()) + more > ptrdiff_t(std::min<size_t>(limits.nodes, UINT32_MAX))) {
    return false;
  }

  exchange_nodes(tree.nodes, old, read);
  const auto bytes = uint32_t(growth), count = uint32_t(more);  // Modulo 2^32 where they shrink.
  for (size_t i = old.last + count; (bytes | count) != 0 && i < tree.nodes.size(); ++i) {
    SyntaxNode& node = tree.nodes[i];
    node.begin += bytes, node.name += bytes, node.arguments += bytes, node.body += bytes;
    node.end += bytes;
    node.last += count;
    if (node.parent >= old.last) node.parent += count;
  }
  for (uint32_t node = old.parent;; node = tree.nodes[node].parent) {
    tree.nodes[node].end += bytes;
    tree.nodes[node].last += count;
    if (node == 0) break;
  }
  return true;
}

}  // namespace whittle
