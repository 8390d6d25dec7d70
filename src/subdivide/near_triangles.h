// Which triangles of boundaries reach a cell. The cell's parts search these, and not the whole
// boundary.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace whittle {

/// Indices into Boundary::triangles(), if they are listed.
using ListedTriangles = std::optional<std::span<const uint32_t>>;

/// For each boundary that is whole in a formula, in the formula's order: its unit, how many
/// triangles are listed, and these, as indices into Boundary::triangles(). kMany and none if there
/// are too many to list. An empty row lists nothing at all.
class NearTriangles {
 public:
  static constexpr uint32_t kMany = UINT32_MAX;
  /// No more than so many triangles of a boundary are listed.
  static constexpr size_t kMostListed = 32;
  /// Words that a boundary takes at most.
  static constexpr size_t kMostWords = 2 + kMostListed;

  /// Adds a boundary; nothing: too many.
  static void add(uint32_t unit, ListedTriangles triangles, std::vector<uint32_t>& row) {
    row.push_back(unit);
    row.push_back(triangles ? uint32_t(triangles->size()) : kMany);
    if (triangles) row.insert(row.end(), triangles->begin(), triangles->end());
  }

  NearTriangles() = default;
  explicit NearTriangles(std::span<const uint32_t> row) : row_(row) {}

  /// Those of the next boundary that is this unit, if they are listed; others before it are passed
  /// over.
  ListedTriangles next(uint32_t unit) {
    while (!row_.empty()) {
      const uint32_t its_unit = row_[0], number = row_[1];
      const std::span<const uint32_t> its = row_.subspan(2, number == kMany ? 0 : number);
      row_ = row_.subspan(2 + its.size());
      if (its_unit != unit) continue;
      if (number == kMany) return std::nullopt;
      return its;
    }
    return std::nullopt;
  }

 private:
  std::span<const uint32_t> row_;
};

}  // namespace whittle
