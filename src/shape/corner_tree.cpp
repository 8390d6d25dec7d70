#include "shape/corner_tree.h"

#include <limits>
#include <utility>

#include "base/box.h"

namespace whittle {

namespace {

constexpr uint32_t kLeafCorners = 4;

}  // namespace

CornerTree::CornerTree(std::vector<Corner> corners) : corners_(std::move(corners)) {
  if (corners_.empty()) return;
  nodes_.push_back({.begin = 0, .end = uint32_t(corners_.size()), .middle = {}, .axis = {}});
  // A node is made before its children, and the first child right before all that is below it.
  std::vector<uint32_t> parents_of_second;
  for (uint32_t i = 0;;) {
    split(i);
    const Node node = nodes_[i];
    if (node.end - node.begin > kLeafCorners) {
      parents_of_second.push_back(i);
      nodes_.push_back({.begin = node.begin,
                        .end = node.begin + (node.end - node.begin) / 2,
                        .middle = {},
                        .axis = {}});
    } else if (!parents_of_second.empty()) {
      Node& parent = nodes_[parents_of_second.back()];
      parents_of_second.pop_back();
      parent.second = uint32_t(nodes_.size());
      const uint32_t begin = parent.begin + (parent.end - parent.begin) / 2, end = parent.end;
      nodes_.push_back({.begin = begin, .end = end, .middle = {}, .axis = {}});
    } else {
      return;
    }
    i = uint32_t(nodes_.size()) - 1;
  }
}

/// Measures a node, and sorts its corners so that either half is one of its halves in space.
void CornerTree::split(uint32_t i) {
  Node& node = nodes_[i];
  const auto begin = corners_.begin() + node.begin, end = corners_.begin() + node.end;
  Box box;
  Vec3 axis;
  for (auto c = begin; c != end; ++c) {
    box.include(c->place);
    axis += normalize(c->normal);
  }
  node.middle = box.center();
  node.axis = normalize(axis);
  node.lo = kInfinity;
  node.hi = -kInfinity;
  for (auto c = begin; c != end; ++c) {
    const Vec3 d = c->place - node.middle;
    const double along = dot(d, node.axis);
    node.lo = std::min(node.lo, along);
    node.hi = std::max(node.hi, along);
    node.radius = std::max(node.radius, length(d - node.axis * along));
    node.reach = std::max(node.reach, length(d));
  }
  constexpr double kRoundings = 32;
  node.rounding =
      kRoundings * std::numeric_limits<double>::epsilon() * (length(node.middle) + node.reach);
  const Vec3 size = box.size();
  const int longest = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  std::nth_element(
      begin, begin + (node.end - node.begin) / 2, end,
      [&](const Corner& a, const Corner& b) { return a.place[longest] < b.place[longest]; });
}

}  // namespace whittle
