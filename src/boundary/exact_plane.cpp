#include "boundary/exact_plane.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace whittle {
namespace {

constexpr int kNormalBits = 52;
/// Coordinates in the region are below 2^kCoordinateBits.
constexpr int kCoordinateBits = 25;
/// Distances of planes that are square to an axis are rounded to so many bits less, so that their
/// coordinates are exact in an ExactPoint.
constexpr int kSquareBits = 18;

Int128 round_to_int(long double value) {
  // What is farther out has no point in the region.
  constexpr long double kMost = 0x1p79L;
  return Int128(std::round(std::clamp(value, -kMost, kMost)));
}

}  // namespace

ExactGrid::ExactGrid(const Box& region) {
  const double most = max_component(max(abs(region.lo), abs(region.hi)));
  per_unit_ = std::ldexp(1.0, kCoordinateBits - 1 - std::ilogb(most > 0 ? most : 1.0));
}

ExactPlane ExactGrid::make(Vec3 n, long double d, PlaneSide& above) const {
  const double size = max_component(abs(n));
  std::array<int64_t, 3> whole;
  int64_t divisor = 0;
  for (int i = 0; i < 3; ++i) {
    whole[size_t(i)] = std::llround(std::ldexp(n[i], kNormalBits));
    divisor = std::gcd(divisor, whole[size_t(i)]);
  }
  // One direction has one normal, whatever its length was.
  int64_t most = 0;
  for (int64_t& component : whole) {
    component /= divisor;
    most = std::max(most, std::abs(component));
  }
  const int64_t factor = (int64_t(1) << kNormalBits) / most;
  const int64_t first = whole[0] != 0 ? whole[0] : whole[1] != 0 ? whole[1] : whole[2];
  above = first < 0 ? -1 : 1;
  ExactPlane plane;
  for (size_t i = 0; i < 3; ++i) plane.n[i] = whole[i] * factor * above;
  const long double scale = (long double)(most * factor) / size * above * (long double)(per_unit_);
  plane.d = round_to_int(d * scale);
  const bool is_square = std::count(whole.begin(), whole.end(), 0) == 2;
  if (is_square) {
    const Int128 half = Int128(1) << (kSquareBits - 1);
    plane.d = ((plane.d + half) >> kSquareBits) << kSquareBits;
  }
  return plane;
}

ExactPlane ExactGrid::plane(const HalfSpace& h, PlaneSide& inside) const {
  // f(p) = 2 b.(p - center) + c, inside where it is not positive.
  const Vec3 n = h.f.b * 2;
  const long double d = (long double)(n.x) * h.center.x + (long double)(n.y) * h.center.y +
                        (long double)(n.z) * h.center.z - h.f.c;
  PlaneSide above;
  const ExactPlane plane = make(n, d, above);
  inside = PlaneSide(-above);
  return plane;
}

ExactPlane ExactGrid::square_plane(int axis, double at) const {
  Vec3 n;
  n[axis] = 1;
  PlaneSide above;
  return make(n, at, above);
}

size_t PlaneTable::slot_of(const ExactPlane& plane) const {
  uint64_t hash = uint64_t(plane.d) ^ uint64_t(UInt128(plane.d) >> 64);
  for (const int64_t component : plane.n)
    hash = (hash ^ uint64_t(component)) * 0x9e3779b97f4a7c15, hash ^= hash >> 32;
  size_t at = hash & (slots_.size() - 1);
  while (slots_[at] != kFree && planes_[slots_[at]] != plane) at = (at + 1) & (slots_.size() - 1);
  return at;
}

void PlaneTable::grow() {
  const std::vector<uint32_t> before =
      std::exchange(slots_, std::vector<uint32_t>(4 * slots_.size(), kFree));
  for (const uint32_t number : before)
    if (number != kFree) slots_[slot_of(planes_[number])] = number;
}

uint32_t PlaneTable::add(const ExactPlane& plane) {
  if (2 * (taken_ + 1) > slots_.size()) grow();
  uint32_t& number = slots_[slot_of(plane)];
  if (number != kFree) return number;
  ++taken_;
  number = uint32_t(planes_.size());
  planes_.push_back(plane);
  constexpr double kUnit = 1.0 / double(int64_t(1) << kNormalBits);
  RoundedPlane rounded;
  for (int i = 0; i < 3; ++i) rounded.n[i] = double(plane.n[size_t(i)]) * kUnit;
  rounded.d = double(plane.d) * kUnit;
  rounded_.push_back(rounded);
  return number;
}

uint32_t PlaneTable::add_copy(uint32_t number) {
  planes_.push_back(ExactPlane(planes_[number]));
  rounded_.push_back(RoundedPlane(rounded_[number]));
  return uint32_t(planes_.size() - 1);
}

}  // namespace whittle
