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
    const double angle = std::atan2(dot(way, v), dot(way, u));
    // Of an edge shorter than the inverse of the largest number there is no direction.
    sorted.push_back({std::isfinite(angle) ? angle : 0, use});
  }
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& x, const auto& y) { return x.first < y.first; });
  std::vector<EdgeUse> result;
  for (const auto& [angle, use] : sorted) result.push_back(use);
  return result;
}

/// At an edge: those sets of triangles that run along it more often one way than the other, as they
/// would be turned now, are to make up for one another. Pairs of triangles within a set that run
/// opposite ways do not matter.
void relate_sets(std::span<const Vec3> points, const std::vector<Corners>& triangles, uint32_t a,
                 uint32_t b, std::span<const EdgeUse> uses, Turns& turns) {
  struct Member {
    uint32_t root;
    bool forward;
    size_t place;  ///< around the edge
  };
  const std::vector<EdgeUse> sorted = around(points, triangles, a, b, uses);
  std::vector<Member> members;
  for (size_t i = 0; i < sorted.size(); ++i) {
    const Turns::Place place = turns.find(sorted[i].triangle);
    members.push_back({place.root, sorted[i].forward != place.turned, i});
  }
  std::ranges::stable_sort(members, {}, &Member::root);
  std::vector<size_t> left;
  for (auto from = members.begin(); from != members.end();) {
    std::vector<Member> waiting;
    auto to = from;
    for (; to != members.end() && to->root == from->root; ++to) {
      if (!waiting.empty() && waiting.back().forward != to->forward)
        waiting.pop_back();
      else
        waiting.push_back(*to);
    }
    for (const Member& member : waiting) left.push_back(member.place);
    from = to;
  }
  std::ranges::sort(left);
  const auto relate = [&](const EdgeUse& x, const EdgeUse& y) {
    turns.relate(x.triangle, y.triangle, x.forward == y.forward);
  };
  const auto forward = std::ranges::count_if(left, [&](size_t i) { return sorted[i].forward; });
  if (2 * size_t(forward) == left.size()) {
    // As they were written they make up for one another.
    std::vector<size_t> waiting;
    for (const size_t i : left) {
      if (!waiting.empty() && sorted[waiting.back()].forward != sorted[i].forward) {
        relate(sorted[waiting.back()], sorted[i]);
        waiting.pop_back();
      } else {
        waiting.push_back(i);
      }
    }
  } else {
    // Going around, one goes in and out of the solid in turn.
    for (size_t k = 0; k + 1 < left.size(); ++k) relate(sorted[left[k]], sorted[left[k + 1]]);
  }
}

/// Which parts run along an edge more often one way than the other.
void find_unbalanced(std::span<const EdgeUse> uses, const std::vector<uint32_t>& part_of,
                     std::vector<uint32_t>& unbalanced) {
  std::vector<std::pair<uint32_t, int>> ways;
  for (const EdgeUse& use : uses) ways.emplace_back(part_of[use.triangle], use.forward ? 1 : -1);
  std::ranges::sort(ways);
  unbalanced.clear();
  for (size_t i = 0; i < ways.size();) {
    int balance = 0;
    const uint32_t part = ways[i].first;
    for (; i < ways.size() && ways[i].first == part; ++i) balance += ways[i].second;
    if (balance != 0) unbalanced.push_back(part);
  }
}

}  // namespace

MeshParts turn_faces(std::span<const Vec3> points, std::vector<Corners>& triangles) {
  const auto count = uint32_t(triangles.size());
  Turns turns(count);
  bool is_manifold = true;
  for_each_edge(triangles, points.size(), [&](uint32_t, uint32_t, std::span<const EdgeUse> uses) {
    if (uses.size() == 2)
      turns.relate(uses[0].triangle, uses[1].triangle, uses[0].forward == uses[1].forward);
    is_manifold &= uses.size() == 2;
  });
  if (!is_manifold)
    for_each_edge(triangles, points.size(),
                  [&](uint32_t a, uint32_t b, std::span<const EdgeUse> uses) {
                    if (uses.size() > 2 && uses.size() % 2 == 0)
                      relate_sets(points, triangles, a, b, uses, turns);
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
  uint32_t part_count = 0;
  for (uint32_t t = 0; t < count; ++t) {
    const Turns::Place place = turns.find(t);
    if (number[place.root] == UINT32_MAX) number[place.root] = part_count++;
    parts.part_of[t] = number[place.root];
    if (place.turned != (balance[place.root] < 0)) {
      std::swap(triangles[t][1], triangles[t][2]);
      ++parts.turned;
    }
  }

  // Where parts make up for one another at an edge they are one, for better or worse.
  Turns joined(part_count);
  std::vector<uint8_t> is_open(part_count, 0);
  std::vector<uint32_t> unbalanced;
  for_each_edge(triangles, points.size(),
                [&](uint32_t a, uint32_t b, std::span<const EdgeUse> uses) {
                  if (uses.size() == 2 && uses[0].forward != uses[1].forward) return;
                  find_unbalanced(uses, parts.part_of, unbalanced);
                  const auto forward = std::ranges::count_if(uses, &EdgeUse::forward);
                  const bool is_closed = 2 * size_t(forward) == uses.size();
                  if (!is_closed && parts.open_edges++ == 0)
                    parts.first_open = (points[a] + points[b]) * 0.5;
                  for (const uint32_t part : unbalanced) {
                    is_open[part] |= !is_closed;
                    joined.relate(unbalanced[0], part, false);
                  }
                });
  std::vector<uint32_t> joined_number(part_count, UINT32_MAX);
  for (uint32_t i = 0; i < part_count; ++i) {
    uint32_t& own = joined_number[joined.find(i).root];
    if (own == UINT32_MAX) {
      own = uint32_t(parts.is_open.size());
      parts.is_open.push_back(0);
    }
    joined_number[i] = own;
    parts.is_open[own] |= is_open[i];
  }
  for (uint32_t& part : parts.part_of) part = joined_number[part];
  return parts;
}

}  // namespace whittle
