// What the shared arithmetic of *.inl means in C++: the number type is a template parameter, so the
// same text serves double, float and, later, vector lanes.
#pragma once

#include <cmath>

#include "base/vec.h"

namespace whittle {

template <class R>
struct Kernels {
  using Real = R;
  using Bool = bool;
  using Vec3 = Vec3T<R>;
  struct Vec2 {
    R x, y;
  };

  static R select(bool condition, R yes, R no) { return condition ? yes : no; }
  static R pmin(R a, R b) { return b < a ? b : a; }
  static R pmax(R a, R b) { return a < b ? b : a; }
  static R fabs_(R a) { return std::fabs(a); }
  static R sqrt(R a) { return std::sqrt(a); }
  static R dot3(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  static Vec3 make_vec3(R x, R y, R z) { return {x, y, z}; }
  static Vec2 make_vec2(R x, R y) { return {x, y}; }

#define FN static inline
#define K(x) Real(x)
#include "kernels/camera.inl"
#include "kernels/halfspace.inl"
#undef K
#undef FN
};

}  // namespace whittle
