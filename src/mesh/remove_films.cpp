#include "mesh/remove_films.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace whittle {
namespace {

/// A triangle by its corners from the lowest number to the highest.
struct Entry {
  Corners sorted;
  uint32_t triangle;
  bool is_even;  ///< it runs through them in that order
};

Entry entry_of(const Corners& corners, uint32_t triangle) {
  Entry entry{corners, triangle, true};
  const auto order = [&](size_t i, size_t j) {
    if (entry.sorted[i] <= entry.sorted[j]) return;
    std::swap(entry.sorted[i], entry.sorted[j]);
    entry.is_even = !entry.is_even;
  };
  order(0, 1), order(1, 2), order(0, 1);
  return entry;
}

/// Of triangles with the same corners as many turned one way go as the other.
void mark_pairs(std::vector<Entry>::const_iterator from, std::vector<Entry>::const_iterator to,
                std::vector<uint8_t>& is_gone) {
  const auto even = std::count_if(from, to, [](const Entry& entry) { return entry.is_even; });
  const auto pairs = std::min<std::ptrdiff_t>(even, (to - from) - even);
  std::ptrdiff_t left[2] = {pairs, pairs};
  for (; from != to; ++from)
    if (left[from->is_even]-- > 0) is_gone[from->triangle] = 1;
}

}  // namespace

void remove_films(std::vector<Corners>& triangles, size_t point_count) {
  // Sorted by counting for the lowest corner, which few have in common.
  std::vector<uint32_t> first(point_count + 2, 0);
  for (const Corners& t : triangles) ++first[std::min({t[0], t[1], t[2]}) + 2];
  for (size_t i = 2; i < first.size(); ++i) first[i] += first[i - 1];
  std::vector<Entry> entries(triangles.size());
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    const Entry entry = entry_of(triangles[t], t);
    entries[first[entry.sorted[0] + 1]++] = entry;
  }
  std::vector<uint8_t> is_gone(triangles.size(), 0);
  const auto at = [&](uint32_t i) { return entries.begin() + std::ptrdiff_t(i); };
  for (size_t corner = 0; corner < point_count; ++corner) {
    const auto end = at(first[corner + 1]);
    std::sort(at(first[corner]), end, [](const Entry& a, const Entry& b) {
      return std::pair(a.sorted, a.triangle) < std::pair(b.sorted, b.triangle);
    });
    for (auto from = at(first[corner]); from != end;) {
      auto to = from;
      while (to != end && to->sorted == from->sorted) ++to;
      if (to - from > 1) mark_pairs(from, to, is_gone);
      from = to;
    }
  }
  size_t kept = 0;
  for (size_t t = 0; t < triangles.size(); ++t)
    if (!is_gone[t]) triangles[kept++] = triangles[t];
  triangles.resize(kept);
}

}  // namespace whittle
