// Lines where two planes meet. Lines that are equal get one number, whichever planes name them.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "boundary/exact_point.h"

namespace whittle {

/// Pluecker's coordinates: the direction, and the vector product of any of its points with it.
struct ExactLine {
  std::array<Int128, 3> direction{};  ///< less than 2^107
  std::array<WideInt<3>, 3> moment;   ///< less than 2^134
  int axis = 0;                       ///< along which the direction is largest; positive there
};

class LineTable {
 public:
  explicit LineTable(const ExactGeometry& geometry) : geometry_(geometry) {}

  /// The line's number. Precondition: the planes are not parallel, and the line meets the region.
  uint32_t number(uint32_t plane_a, uint32_t plane_b);

  const ExactLine& operator[](uint32_t number) const { return lines_[number]; }
  size_t size() const { return lines_.size(); }

 private:
  using Key = std::array<int64_t, 4>;
  struct Hash {
    size_t operator()(const Key& key) const;
  };
  ExactLine make(uint32_t plane_a, uint32_t plane_b) const;
  static Key key(const ExactLine& line);
  static bool is_same(const ExactLine& a, const ExactLine& b);

  const ExactGeometry& geometry_;
  std::vector<ExactLine> lines_;
  /// By pairs of planes, in a table with free places.
  struct Named {
    uint64_t planes = UINT64_MAX;
    uint32_t line = 0;
  };
  Named& place_of(uint64_t planes);
  std::vector<Named> named_ = std::vector<Named>(1024);
  size_t named_count_ = 0;
  std::unordered_multimap<Key, uint32_t, Hash> by_key_;
};

}  // namespace whittle
