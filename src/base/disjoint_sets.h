// Numbers in sets that are joined (Tarjan, Efficiency of a good but not linear set union algorithm,
// 1975; with the path halving of Tarjan and van Leeuwen 1984).
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace whittle {

/// Each of 0 to n - 1 is a set by itself at first, and the number that stands for it.
class DisjointSets {
 public:
  explicit DisjointSets(size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }

  /// The number that stands for i's set.
  uint32_t find(uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// Joins the sets of two numbers; what stands for `into` stands for both.
  void join(uint32_t from, uint32_t into) { parent_[find(from)] = find(into); }

 private:
  std::vector<uint32_t> parent_;
};

}  // namespace whittle
