// Answers worked out on paper, in long double: where a ray meets a sphere, a cylinder, a cone or a
// box, and what is seen of two such bodies put together. Shares nothing with the program but its
// camera.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "trace/camera.h"

namespace whittle {

using Exact = long double;
using ExactVec = Vec3T<Exact>;

inline constexpr Exact kExactInfinity = std::numeric_limits<Exact>::infinity();

inline ExactVec exact(Vec3 v) {
  return {v.x, v.y, v.z};
}

struct ExactRay {
  ExactVec origin, direction;  ///< the direction is unit
  Exact t_min = 0;

  ExactVec at(Exact t) const { return origin + direction * t; }
};

/// Camera::ray without its rounding: the camera's numbers are taken as they are.
ExactRay exact_ray(const Camera& camera, Exact px, Exact py);

/// What a ray sees.
struct Known {
  uint32_t id = 0;  ///< 0: nothing
  Exact distance = kExactInfinity;
  ExactVec normal;  ///< unit, outward from the solid
};

/// The part of a ray in a convex body, with the body's unit outward normals at its ends.
struct ExactSpan {
  uint32_t id = 0;
  Exact t0 = kExactInfinity, t1 = -kExactInfinity;
  ExactVec n0, n1;

  bool is_empty() const { return !(t0 < t1); }
};

ExactSpan slab(uint32_t id, const ExactRay& ray, int axis, Exact low, Exact high);
ExactSpan box(uint32_t id, const ExactRay& ray, ExactVec low, ExactVec high);
/// Semi-axes along the coordinate axes.
ExactSpan ellipsoid(uint32_t id, const ExactRay& ray, ExactVec center, ExactVec semi_axes);
ExactSpan sphere(uint32_t id, const ExactRay& ray, ExactVec center, Exact r);
/// From `foot` along `axis` (0, 1, 2) over `height`.
ExactSpan cylinder(uint32_t id, const ExactRay& ray, int axis, ExactVec foot, Exact r,
                   Exact height);
/// Upright, with the tip `height` above (or, if negative, below) the middle of its base.
ExactSpan cone(uint32_t id, const ExactRay& ray, ExactVec foot, Exact r, Exact height);

// What is seen of bodies put together, by an eye that may be anywhere. Ties go to the first.
Known seen_of_union(const ExactRay& ray, const std::vector<ExactSpan>& bodies);
Known seen_of_intersection(const ExactRay& ray, const std::vector<ExactSpan>& bodies);
/// The first body minus the others.
Known seen_of_difference(const ExactRay& ray, const std::vector<ExactSpan>& bodies);

/// The answer to a ray.
using Answer = std::function<Known(const ExactRay&)>;

}  // namespace whittle
