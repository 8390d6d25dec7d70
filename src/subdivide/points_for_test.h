// Random points for tests.
#pragma once

#include <random>

#include "base/box.h"

namespace whittle {

/// Random points of a box, and some on its sides and corners.
class Points {
 public:
  explicit Points(uint64_t seed) : random_(seed) {}
  Vec3 in(const Box& box) {
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis) {
      const double u = random_() % 8 == 0 ? double(random_() % 2) : unit_(random_);
      p[axis] = box.lo[axis] + u * (box.hi[axis] - box.lo[axis]);
    }
    return max(box.lo, min(p, box.hi));
  }
  Box box_in(const Box& box) {
    Box b;
    b.include(in(box)), b.include(in(box));
    return b;
  }

 private:
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> unit_{0, 1};
};

}  // namespace whittle
