// What the shared arithmetic means in lanes. Included once for every instruction set.
#if defined(WHITTLE_LANE_MATH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHITTLE_LANE_MATH_INL_H
#undef WHITTLE_LANE_MATH_INL_H
#else
#define WHITTLE_LANE_MATH_INL_H
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "base/vec.h"
#include "trace/cpu/lanes.h"

HWY_BEFORE_NAMESPACE();
namespace whittle {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// A Real is a vector of doubles, a Bool a mask.
struct LaneKernels {
  using D = hn::CappedTag<double, kMaxLanes>;
  using Real = hn::Vec<D>;
  using Bool = hn::Mask<D>;
  struct Vec3 {
    Real x, y, z;
  };
  struct Vec2 {
    Real x, y;
  };

  static HWY_INLINE Real select(Bool condition, Real yes, Real no) {
    return hn::IfThenElse(condition, yes, no);
  }
  static HWY_INLINE Real pmin(Real a, Real b) { return select(b < a, b, a); }
  static HWY_INLINE Real pmax(Real a, Real b) { return select(a < b, b, a); }
  static HWY_INLINE Real fabs_(Real a) { return hn::Abs(a); }
  static HWY_INLINE Real sqrt(Real a) { return hn::Sqrt(a); }
  static HWY_INLINE Real dot3(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  static HWY_INLINE Vec3 make_vec3(Real x, Real y, Real z) { return {x, y, z}; }
  static HWY_INLINE Vec2 make_vec2(Real x, Real y) { return {x, y}; }

#define FN static HWY_INLINE
#define K(x) hn::Set(D(), double(x))
#include "kernels/camera.inl"
#include "kernels/halfspace.inl"
#undef K
#undef FN
};

using L = LaneKernels;
using D = L::D;
using Real = L::Real;
using Bool = L::Bool;
using Words = hn::RebindToUnsigned<D>;  ///< a 64-bit word beside each double
using Word = hn::Vec<Words>;

HWY_INLINE Real set(double x) {
  return hn::Set(D(), x);
}
HWY_INLINE L::Vec3 set(Vec3 v) {
  return {set(v.x), set(v.y), set(v.z)};
}
HWY_INLINE uint32_t bits(Bool mask) {
  uint8_t bytes[8] = {};
  hn::StoreMaskBits(D(), mask, bytes);
  return bytes[0];
}
HWY_INLINE Bool mask_of(uint32_t lanes) {
  const uint8_t bytes[8] = {uint8_t(lanes)};
  return hn::LoadMaskBits(D(), bytes);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace whittle
HWY_AFTER_NAMESPACE();

#endif
