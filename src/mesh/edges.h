// The edges of a triangle mesh, and which triangles are at them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace whittle {

using Corners = std::array<uint32_t, 3>;

/// A triangle at an edge from a to b, a < b.
struct EdgeUse {
  uint32_t b;
  uint32_t triangle;
  bool forward;  ///< the triangle runs from a to b
};

/// Calls visit(a, b, uses) for every edge, a < b, with all triangles at it, in a fixed order.
/// Sorted by counting: linear. A triangle is at no edge between two equal corners.
template <class Visit>
void for_each_edge(std::span<const Corners> triangles, size_t point_count, const Visit& visit) {
  std::vector<uint32_t> first(point_count + 2, 0);
  const auto for_uses = [&](const auto& use) {
    for (uint32_t t = 0; t < triangles.size(); ++t)
      for (size_t e = 0; e < 3; ++e) {
        const uint32_t a = triangles[t][e], b = triangles[t][(e + 1) % 3];
        if (a != b) use(std::min(a, b), EdgeUse{std::max(a, b), t, a < b});
      }
  };
  for_uses([&](uint32_t a, const EdgeUse&) { ++first[a + 2]; });
  for (size_t i = 2; i < first.size(); ++i) first[i] += first[i - 1];
  std::vector<EdgeUse> uses(first.back());
  for_uses([&](uint32_t a, const EdgeUse& use) { uses[first[a + 1]++] = use; });
  for (uint32_t a = 0; a < point_count; ++a) {
    const auto begin = uses.begin() + first[a], end = uses.begin() + first[a + 1];
    std::sort(begin, end, [](const EdgeUse& x, const EdgeUse& y) {
      return x.b != y.b ? x.b < y.b : x.triangle < y.triangle;
    });
    for (auto from = begin; from != end;) {
      auto to = from;
      while (to != end && to->b == from->b) ++to;
      visit(a, from->b, std::span<const EdgeUse>(from, to));
      from = to;
    }
  }
}

}  // namespace whittle
