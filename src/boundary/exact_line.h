// Lines where two planes meet. Lines that are equal get one number, whichever planes name them.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/workers.h"
#include "boundary/exact_point.h"

namespace whittle {

/// Pluecker's coordinates: the direction, and the vector product of any of its points with it.
struct ExactLine {
  std::array<Int128, 3> direction{};  ///< less than 2^107
  std::array<WideInt<3>, 3> moment;   ///< less than 2^134
  int axis = 0;                       ///< along which the direction is largest; positive there
};

/// The line in which two planes meet. Precondition: they are not parallel.
ExactLine line_of(const ExactPlane& a, const ExactPlane& b);
bool is_same(const ExactLine& a, const ExactLine& b);
/// The same for equal lines, whichever planes name them. Precondition: the line meets the region.
uint32_t hash_of(const ExactLine& line);

/// Lines by number.
struct NumberedLines {
  std::vector<uint32_t> numbers;  ///< of each pair of planes
  std::vector<uint8_t> axes;      ///< by number of line: ExactLine::axis
};

/// Numbers the lines of pairs of planes, as `pair_of(i)` says them for i < n. Preconditions as
/// above.
NumberedLines number_lines(size_t n, const std::function<std::array<uint32_t, 2>(size_t)>& pair_of,
                           const ExactGeometry& geometry, const Workers& workers);

}  // namespace whittle
