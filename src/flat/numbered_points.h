// Points of a plane as sweeps know them: by number, and by how three of them turn.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "flat/orientation.h"

namespace whittle {

/// Points that differ, numbered by x, then by y. What their coordinates are, nobody is told.
class NumberedPoints {
 public:
  virtual ~NumberedPoints() = default;
  virtual size_t size() const = 0;
  /// Positive if c lies to the left of the line from a to b, negative if to the right, 0 if on it.
  /// Exact.
  virtual double turn(uint32_t a, uint32_t b, uint32_t c) const = 0;
};

/// Points with coordinates; they must outlive this.
class PlanePoints final : public NumberedPoints {
 public:
  explicit PlanePoints(const std::vector<Vec2>& points) : points_(points) {}
  size_t size() const override { return points_.size(); }
  double turn(uint32_t a, uint32_t b, uint32_t c) const override {
    return orientation(points_[a], points_[b], points_[c]);
  }

 private:
  const std::vector<Vec2>& points_;
};

}  // namespace whittle
