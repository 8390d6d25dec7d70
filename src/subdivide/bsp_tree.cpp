#include "subdivide/bsp_tree.h"

#include <algorithm>

namespace whittle {
namespace {

/// Weights of a polygon's corners that give points inside of it.
constexpr double kWeights[][3] = {
    {1.1, 0.9, 1.3}, {2.3, 0.7, 0.4}, {0.5, 2.1, 0.8}, {0.6, 0.5, 2.7}};

/// So many planes are tried before one of them divides a part.
constexpr size_t kCandidates = 8;

Vec3 point_in(std::span<const Vec3> polygon, const double (&weights)[3]) {
  Vec3 sum;
  double all = 0;
  for (size_t k = 0; k < polygon.size(); ++k) {
    const double weight = weights[k % 3] + 0.01 * double(k);
    sum += polygon[k] * weight;
    all += weight;
  }
  return sum / all;
}

}  // namespace

/// Of the planes of some polygons, the one that cuts the fewest others and leaves as little as can
/// be on one of its sides: with nothing there, it is one literal beside the rest.
uint32_t BspTree::choose(std::span<const uint32_t> polygons, const CellPolygons& in) const {
  uint32_t best = in.polygons[polygons[0]].plane;
  size_t least = SIZE_MAX, tried = 0;
  uint32_t last = UINT32_MAX;
  const size_t step = std::max<size_t>(1, polygons.size() / (4 * kCandidates));
  for (size_t i = 0; i < polygons.size() && tried < kCandidates; i += step) {
    const uint32_t plane = in.polygons[polygons[i]].plane;
    if (plane == last) continue;
    last = plane;
    ++tried;
    size_t front = 0, back = 0, cut = 0, cost = 0;
    for (const uint32_t number : polygons) {
      // It only grows.
      cost = 8 * cut + std::min(front, back);
      if (cost >= least) break;
      const CellPolygons::Polygon& polygon = in.polygons[number];
      if (polygon.plane == plane) continue;
      bool has_front = false, has_back = false;
      for (const Vec3& p : in.corners_of(polygon)) {
        const double f = in.planes[plane].at(p);
        has_front |= f > in.slack;
        has_back |= f < -in.slack;
        if (has_front && has_back) break;
      }
      cut += has_front && has_back;
      front += has_front && !has_back;
      back += has_back && !has_front;
    }
    cost = 8 * cut + std::min(front, back);
    if (cost < least) least = cost, best = plane;
    if (cost == 0) break;
  }
  return best;
}

/// Sorts polygons: into on_, front_ and back_ of a plane.
void BspTree::divide(std::span<const uint32_t> polygons, uint32_t plane, CellPolygons& in) {
  on_.clear();
  front_.clear();
  back_.clear();
  for (const uint32_t number : polygons) {
    const CellPolygons::Polygon polygon = in.polygons[number];
    if (polygon.plane == plane) {
      on_.push_back(number);
      continue;
    }
    double highest = 0, lowest = 0;
    for (const Vec3& p : in.corners_of(polygon)) {
      const double f = in.planes[plane].at(p);
      highest = std::max(highest, f);
      lowest = std::min(lowest, f);
    }
    if (highest > in.slack && lowest < -in.slack) {
      CellPolygons::Polygon part[2];
      in.split(polygon, plane, part[0], part[1]);
      for (const bool is_back : {false, true}) {
        if (in.is_thin(part[is_back])) continue;
        (is_back ? back_ : front_).push_back(uint32_t(in.polygons.size()));
        in.polygons.push_back(part[is_back]);
      }
    } else {
      (highest >= -lowest ? front_ : back_).push_back(number);
    }
  }
}

/// Finds a point on the node's plane, as far from all that else is in the part as can be, and what
/// all polygons on the plane say there together.
void BspTree::take_sample(std::span<const uint32_t> polygons, uint32_t parent,
                          const CellPolygons& in, Node& node) {
  other_planes_.clear();
  for (const uint32_t number : polygons)
    if (const uint32_t plane = in.polygons[number].plane; plane != node.plane)
      other_planes_.push_back(plane);
  std::ranges::sort(other_planes_);
  other_planes_.erase(std::unique(other_planes_.begin(), other_planes_.end()), other_planes_.end());

  const double good_enough = 16 * in.slack;
  node.room = -1;
  for (const uint32_t number : on_) {
    for (const auto& weights : kWeights) {
      const Vec3 p = point_in(in.corners_of(in.polygons[number]), weights);
      double room = kInfinity;
      for (const uint32_t plane : other_planes_)
        room = std::min(room, std::fabs(in.planes[plane].at(p)));
      if (!(room > node.room)) continue;
      int jump = 0;
      for (const uint32_t other : on_) {
        const CellPolygons::Polygon& polygon = in.polygons[other];
        const Vec3 normal = in.planes[node.plane].n * double(polygon.outward);
        const double depth = depth_in(in.corners_of(polygon), normal, in.slack, p);
        room = std::min(room, std::fabs(depth));
        if (depth > 0) jump += polygon.outward;
      }
      if (!(room > node.room)) continue;
      node.room = room;
      node.sample = p;
      node.jump = jump;
      if (node.room > good_enough) break;
    }
    if (node.room > good_enough) break;
  }
  node.from_bounds = kInfinity;
  for (uint32_t n = parent; n != UINT32_MAX; n = parents_[n])
    node.from_bounds =
        std::min(node.from_bounds, std::fabs(in.planes[nodes_[n].plane].at(node.sample)));
}

void BspTree::build(CellPolygons& in) {
  nodes_.clear();
  parents_.clear();
  parts_ = 0;
  lists_.clear();
  for (uint32_t i = 0; i < in.polygons.size(); ++i) lists_.push_back(i);
  open_.assign(1, {0, uint32_t(lists_.size()), UINT32_MAX, 0});
  while (!open_.empty()) {
    const Open part = open_.back();
    open_.pop_back();
    uint32_t self;
    if (part.first == part.last) {
      self = kPart + parts_++;
    } else {
      self = uint32_t(nodes_.size());
      list_.assign(lists_.begin() + part.first, lists_.begin() + part.last);
      lists_.resize(part.first);
      Node node{.plane = choose(list_, in)};
      divide(list_, node.plane, in);
      take_sample(list_, part.parent, in, node);
      nodes_.push_back(node);
      parents_.push_back(part.parent);
      const auto from = uint32_t(lists_.size());
      lists_.insert(lists_.end(), front_.begin(), front_.end());
      const auto middle = uint32_t(lists_.size());
      lists_.insert(lists_.end(), back_.begin(), back_.end());
      open_.push_back({from, middle, self, 0});
      open_.push_back({middle, uint32_t(lists_.size()), self, 1});
    }
    if (part.parent != UINT32_MAX) nodes_[part.parent].child[part.side] = self;
  }
}

}  // namespace whittle
