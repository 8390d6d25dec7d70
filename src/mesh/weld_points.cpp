#include "mesh/weld_points.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace whittle {
namespace {

using Cell = std::array<int64_t, 3>;

uint64_t hash_of(const Cell& cell) {
  uint64_t hash = 0;
  for (const int64_t c : cell) {
    hash = (hash ^ uint64_t(c)) * 0x9e3779b97f4a7c15ull;
    hash ^= hash >> 32;
  }
  return hash;
}

/// The cell of a coordinate. Without a tolerance equal numbers, and only these, have one cell.
int64_t cell_of(double x, double scale) {
  if (scale == 0) return std::bit_cast<int64_t>(x + 0.0);
  return int64_t(std::floor(x * scale));
}

}  // namespace

std::vector<uint32_t> weld_points(std::span<const Vec3> points, double tolerance) {
  constexpr uint32_t kNone = UINT32_MAX;
  std::vector<uint32_t> first(points.size());
  std::vector<uint32_t> head(std::bit_ceil(points.size() + 1), kNone), next(points.size(), kNone);
  const size_t mask = head.size() - 1;
  // Cells four tolerances wide: what is near a point is mostly in its own cell.
  constexpr double kLeast = 1e-300;  // the inverse of less may be infinite
  const double scale = tolerance > kLeast ? 1 / (4 * tolerance) : 0;
  const auto has_cell = [&](Vec3 p) {
    constexpr double kFar = 4e18;  // what a cell's number can be
    const Vec3 at = abs(p) * scale;
    return is_finite(p) && at.x < kFar && at.y < kFar && at.z < kFar;
  };
  const auto is_near = [&](Vec3 a, Vec3 b) {
    return std::fabs(a.x - b.x) <= tolerance && std::fabs(a.y - b.y) <= tolerance &&
           std::fabs(a.z - b.z) <= tolerance;
  };
  for (uint32_t i = 0; i < points.size(); ++i) {
    const Vec3 p = points[i];
    first[i] = i;
    if (!has_cell(p)) continue;
    Cell low, high, own;
    for (int axis = 0; axis < 3; ++axis) {
      own[size_t(axis)] = cell_of(p[axis], scale);
      low[size_t(axis)] = scale == 0 ? own[size_t(axis)] : cell_of(p[axis] - tolerance, scale);
      high[size_t(axis)] = scale == 0 ? own[size_t(axis)] : cell_of(p[axis] + tolerance, scale);
    }
    uint32_t found = kNone;
    Cell cell;
    for (cell[0] = low[0]; cell[0] <= high[0]; ++cell[0])
      for (cell[1] = low[1]; cell[1] <= high[1]; ++cell[1])
        for (cell[2] = low[2]; cell[2] <= high[2]; ++cell[2])
          for (uint32_t k = head[hash_of(cell) & mask]; k != kNone; k = next[k])
            if (is_near(points[k], p)) found = std::min(found, k);
    if (found != kNone) {
      first[i] = found;
      continue;
    }
    uint32_t& slot = head[hash_of(own) & mask];
    next[i] = slot;
    slot = i;
  }
  return first;
}

}  // namespace whittle
