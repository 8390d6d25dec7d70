#include "mesh/turn_faces.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace whittle {
namespace {

/// Sets of triangles, each with whether it is turned against its set's first (union-find with
/// parity).
class Turns {
 public:
  explicit Turns(size_t count) : parent_(count), turned_(count, 0) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  struct Place {
    uint32_t root;
    bool turned;
  };
  Place find(uint32_t i) {
    uint32_t root = i;
    bool turned = false;
    while (parent_[root] != root) turned ^= turned_[root], root = parent_[root];
    const Place place{root, turned};
    while (parent_[i] != root) {
      const uint32_t next = parent_[i];
      const bool own = turned_[i];
      parent_[i] = root;
      turned_[i] = turned;
      turned ^= own;
      i = next;
    }
    return place;
  }
  /// Says whether one of them is to be turned against the other. False if that contradicts what was
  /// said before.
  bool relate(uint32_t a, uint32_t b, bool opposite) {
    const Place of_a = find(a), of_b = find(b);
    if (of_a.root == of_b.root) return (of_a.turned != of_b.turned) == opposite;
    // The lower number stays the root, so that the result does not depend on the order.
    const uint32_t low = std::min(of_a.root, of_b.root), high = std::max(of_a.root, of_b.root);
    parent_[high] = low;
    turned_[high] = of_a.turned ^ of_b.turned ^ opposite;
    return true;
  }

 private:
  std::vector<uint32_t> parent_;
  std::vector<uint8_t> turned_;
};

/// The triangles at an edge in the order in which they stand around it.
std::vector<EdgeUse> around(std::span<const Vec3> points, const std::vector<Corners>& triangles,
                            uint32_t a, uint32_t b, std::span<const EdgeUse> uses) {
  const Vec3 along = normalize(points[b] - points[a]);
  const Vec3 other = std::fabs(along.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 u = normalize(cross(along, other)), v = cross(along, u);
  std::vector<std::pair<double, EdgeUse>> sorted;
  for (const EdgeUse& use : uses) {
    Vec3 third = points[a];
    for (const uint32_t corner : triangles[use.triangle])
      if (corner != a && corner != b) third = points[corner];
    const Vec3 way = third - points[a];
    sorted.push_back({std::atan2(dot(way, v), dot(way, u)), use});
  }
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& x, const auto& y) { return x.first < y.first; });
  std::vector<EdgeUse> result;
  for (const auto& [angle, use] : sorted) result.push_back(use);
  return result;
}

}  // namespace

MeshParts turn_faces(std::span<const Vec3> points, std::vector<Corners>& triangles) {
  const auto count = uint32_t(triangles.size());
  Turns turns(count);
  const auto relate = [&](const EdgeUse& x, const EdgeUse& y) {
    return turns.relate(x.triangle, y.triangle, x.forward == y.forward);
  };
  std::vector<uint32_t> contradicted;
  for_each_edge(triangles, points.size(),
                [&](uint32_t a, uint32_t b, std::span<const EdgeUse> uses) {
                  const auto forward = std::ranges::count_if(uses, &EdgeUse::forward);
                  if (uses.size() == 2) {
                    if (!relate(uses[0], uses[1])) contradicted.push_back(uses[0].triangle);
                  } else if (uses.size() % 2 == 0 && 2 * size_t(forward) != uses.size()) {
                    const std::vector<EdgeUse> sorted = around(points, triangles, a, b, uses);
                    for (size_t i = 0; i + 1 < sorted.size(); ++i)
                      if (!relate(sorted[i], sorted[i + 1]))
                        contradicted.push_back(sorted[i].triangle);
                  }
                });

  // How much of each set's area is turned as its first triangle is, and how much the other way.
  std::vector<double> balance(count, 0);
  for (uint32_t t = 0; t < count; ++t) {
    const auto& [a, b, c] = triangles[t];
    const double area = length(cross(points[b] - points[a], points[c] - points[a]));
    const Turns::Place place = turns.find(t);
    balance[place.root] += place.turned ? -area : area;
  }
  MeshParts parts;
  parts.part_of.resize(count);
  std::vector<uint32_t> number(count, UINT32_MAX);
  for (uint32_t t = 0; t < count; ++t) {
    const Turns::Place place = turns.find(t);
    if (number[place.root] == UINT32_MAX) {
      number[place.root] = uint32_t(parts.is_open.size());
      parts.is_open.push_back(0);
    }
    parts.part_of[t] = number[place.root];
    if (place.turned != (balance[place.root] < 0)) {
      std::swap(triangles[t][1], triangles[t][2]);
      ++parts.turned;
    }
  }
  for (const uint32_t t : contradicted) parts.is_open[parts.part_of[t]] = 1;
  for_each_edge(triangles, points.size(),
                [&](uint32_t a, uint32_t b, std::span<const EdgeUse> uses) {
                  const auto forward = std::ranges::count_if(uses, &EdgeUse::forward);
                  if (2 * size_t(forward) == uses.size()) return;
                  if (parts.open_edges++ == 0) parts.first_open = (points[a] + points[b]) * 0.5;
                  for (const EdgeUse& use : uses) parts.is_open[parts.part_of[use.triangle]] = 1;
                });
  return parts;
}

}  // namespace whittle
