#include "flat/point_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace whittle {

namespace {

constexpr uint32_t kLeafSize = 8;

/// May be true of a box that is a little farther.
bool is_near(const Rect& box, Vec2 a, Vec2 b, double margin) {
  if (std::max(a.x, b.x) < box.lo.x - margin || std::min(a.x, b.x) > box.hi.x + margin ||
      std::max(a.y, b.y) < box.lo.y - margin || std::min(a.y, b.y) > box.hi.y + margin)
    return false;
  const Vec2 along = b - a, middle = (box.lo + box.hi) * 0.5, half = (box.hi - box.lo) * 0.5;
  return std::abs(cross(along, middle - a)) <=
         std::abs(along.x) * (half.y + margin) + std::abs(along.y) * (half.x + margin);
}

bool is_near(Vec2 p, Vec2 a, Vec2 b, double margin) {
  const Vec2 along = b - a;
  const double square = dot(along, along);
  const double t = square > 0 ? std::clamp(dot(along, p - a) / square, 0.0, 1.0) : 0;
  const Vec2 between = p - (a + along * t);
  return dot(between, between) <= margin * margin;
}

}  // namespace

PointTree::PointTree(std::vector<Vec2> points) : points_(std::move(points)) {
  order_.resize(points_.size());
  std::iota(order_.begin(), order_.end(), 0u);
  if (points_.empty()) return;
  nodes_.push_back({{}, 0, uint32_t(order_.size()), 0});
  for (size_t i = 0; i < nodes_.size(); ++i) {
    const uint32_t begin = nodes_[i].begin, end = nodes_[i].end;
    Rect box{points_[order_[begin]], points_[order_[begin]]};
    for (uint32_t k = begin; k < end; ++k) {
      const Vec2 p = points_[order_[k]];
      box.lo = {std::min(box.lo.x, p.x), std::min(box.lo.y, p.y)};
      box.hi = {std::max(box.hi.x, p.x), std::max(box.hi.y, p.y)};
    }
    nodes_[i].box = box;
    if (end - begin <= kLeafSize) continue;
    const bool by_x = box.hi.x - box.lo.x > box.hi.y - box.lo.y;
    const uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](uint32_t a, uint32_t b) {
                       return by_x ? points_[a].x < points_[b].x : points_[a].y < points_[b].y;
                     });
    nodes_[i].left = uint32_t(nodes_.size());
    nodes_.push_back({{}, begin, middle, 0});
    nodes_.push_back({{}, middle, end, 0});
  }
}

void PointTree::near_segment(Vec2 a, Vec2 b, double margin, std::vector<uint32_t>& found) const {
  found.clear();
  if (nodes_.empty()) return;
  std::vector<uint32_t> waiting{0};
  while (!waiting.empty()) {
    const Node& node = nodes_[waiting.back()];
    waiting.pop_back();
    if (!is_near(node.box, a, b, margin)) continue;
    if (node.left != 0) {
      waiting.push_back(node.left);
      waiting.push_back(node.left + 1);
      continue;
    }
    for (uint32_t k = node.begin; k < node.end; ++k)
      if (is_near(points_[order_[k]], a, b, margin)) found.push_back(order_[k]);
  }
}

}  // namespace whittle
