// For tests: are the cells of two trees the same?
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "subdivide/cells.h"

namespace whittle {

inline bool same_leaf(const Leaf& a, const Leaf& b) {
  const auto equal = [](const auto& x, const auto& y, auto&& equal_item) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end(), equal_item);
  };
  return a.table == b.table &&
         equal(a.literals(), b.literals(),
               [](const LeafLiteral& x, const LeafLiteral& y) {
                 return x.literal == y.literal && x.owner == y.owner;
               }) &&
         equal(a.steps(), b.steps(),
               [](const Step& x, const Step& y) {
                 return x.literal == y.literal && x.on_true == y.on_true &&
                        x.on_false == y.on_false;
               }) &&
         std::ranges::equal(a.tokens(), b.tokens());
}

/// Whether the cells are the same wherever neither tree is open; `compared` counts them.
inline bool same_where_known(const CellTree& a, const CellTree& b, size_t* compared = nullptr) {
  std::vector<std::pair<const Cell*, const Cell*>> stack{{a.root, b.root}};
  while (!stack.empty()) {
    const auto [x, y] = stack.back();
    stack.pop_back();
    const CellLink lx = x->link(), ly = y->link();
    if (lx.kind() == CellKind::kOpen || ly.kind() == CellKind::kOpen) continue;
    if (compared != nullptr) ++*compared;
    if (lx.kind() != ly.kind()) return false;
    if (lx.kind() == CellKind::kNode) {
      if (lx.axis() != ly.axis() || x->split != y->split) return false;
      for (int side = 0; side < 2; ++side)
        stack.push_back({lx.children() + side, ly.children() + side});
    } else if (is_leaf(lx.kind()) && !same_leaf(lx.leaf(), ly.leaf())) {
      return false;
    }
  }
  return true;
}

}  // namespace whittle
