// Axis-aligned boxes.
#pragma once

#include <limits>

#include "base/affine.h"

namespace whittle {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The closed box [lo, hi]. The default box is empty and unites as the neutral element.
struct Box {
  Vec3 lo{kInfinity, kInfinity, kInfinity};
  Vec3 hi{-kInfinity, -kInfinity, -kInfinity};

  bool operator==(const Box&) const = default;

  static Box everything() {
    return {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
  }

  bool is_empty() const { return !(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z); }
  bool is_finite() const { return whittle::is_finite(lo) && whittle::is_finite(hi); }
  Vec3 center() const { return (lo + hi) * 0.5; }
  Vec3 size() const { return hi - lo; }
  /// Length of the diagonal; 0 if empty.
  double diagonal() const { return is_empty() ? 0 : length(size()); }
  bool contains(Vec3 p) const {
    return lo.x <= p.x && p.x <= hi.x && lo.y <= p.y && p.y <= hi.y && lo.z <= p.z && p.z <= hi.z;
  }
  void include(Vec3 p) { lo = min(lo, p), hi = max(hi, p); }
  /// Corner `i` (0..7): bit k of i chooses hi on axis k.
  Vec3 corner(int i) const {
    return {i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z};
  }
};

/// The smallest box that holds both.
inline Box unite(const Box& a, const Box& b) {
  return {min(a.lo, b.lo), max(a.hi, b.hi)};
}

/// What both boxes hold; empty if they are apart.
inline Box intersect(const Box& a, const Box& b) {
  const Box r{max(a.lo, b.lo), min(a.hi, b.hi)};
  return r.is_empty() ? Box{} : r;
}

inline bool overlaps(const Box& a, const Box& b) {
  return !intersect(a, b).is_empty();
}

/// The box of the image of `b`, exact for its corners. Empty and infinite boxes stay as they are.
inline Box transform(const Affine& to_from_box, const Box& b) {
  if (b.is_empty()) return {};
  if (!b.is_finite()) return Box::everything();
  Box r;
  for (int i = 0; i < 8; ++i) r.include(to_from_box.point(b.corner(i)));
  return r;
}

}  // namespace whittle
