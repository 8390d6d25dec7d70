#include "boundary/exact_line.h"

#include <algorithm>
#include <utility>

namespace whittle {
namespace {

using Wide4 = WideInt<4>;

Int128 magnitude(Int128 value) {
  return value < 0 ? -value : value;
}

}  // namespace

ExactLine LineTable::make(uint32_t plane_a, uint32_t plane_b) const {
  const ExactPlane &a = geometry_.plane(plane_a), &b = geometry_.plane(plane_b);
  ExactLine line;
  line.direction = direction(a, b);
  for (int i = 1; i < 3; ++i)
    if (magnitude(line.direction[size_t(i)]) > magnitude(line.direction[size_t(line.axis)]))
      line.axis = i;
  // y x (a x b) = a (b.y) - b (a.y), and on the line these products are known.
  for (size_t i = 0; i < 3; ++i) line.moment[i] = product(b.d, a.n[i]) - product(a.d, b.n[i]);
  if (line.direction[size_t(line.axis)] < 0) {
    for (Int128& component : line.direction) component = -component;
    for (WideInt<3>& component : line.moment) component = -component;
  }
  return line;
}

/// Rounded in the same way whatever the scale of the coordinates.
LineTable::Key LineTable::key(const ExactLine& line) {
  const size_t axis = size_t(line.axis), u = (axis + 1) % 3, v = (axis + 2) % 3;
  const Wide4 most(line.direction[axis]);
  const auto quotient = [&](const Wide4& value, unsigned bits) {
    bool is_whole;
    return floor_of_quotient(value.shifted(bits), most, is_whole);
  };
  return {quotient(Wide4(line.direction[u]), 60) * 4 + line.axis,
          quotient(Wide4(line.direction[v]), 60), quotient(Wide4(line.moment[u]), 30),
          quotient(Wide4(line.moment[v]), 30)};
}

bool LineTable::is_same(const ExactLine& a, const ExactLine& b) {
  if (a.axis != b.axis) return false;
  const size_t axis = size_t(a.axis);
  const Wide4 a_most(a.direction[axis]), b_most(b.direction[axis]);
  for (size_t i = 0; i < 3; ++i) {
    if (Wide4(a.direction[i]) * b_most != Wide4(b.direction[i]) * a_most) return false;
    if (Wide4(a.moment[i]) * b_most != Wide4(b.moment[i]) * a_most) return false;
  }
  return true;
}

LineTable::Named& LineTable::place_of(uint64_t planes) {
  uint64_t hash = planes * 0x9e3779b97f4a7c15;
  hash ^= hash >> 32;
  const size_t mask = named_.size() - 1;
  size_t at = hash & mask;
  while (named_[at].planes != UINT64_MAX && named_[at].planes != planes) at = (at + 1) & mask;
  return named_[at];
}

uint32_t LineTable::number(uint32_t plane_a, uint32_t plane_b) {
  const auto [low, high] = std::minmax(plane_a, plane_b);
  const uint64_t planes = uint64_t(low) << 32 | high;
  if (const Named& known = place_of(planes); known.planes == planes) return known.line;
  const ExactLine line = make(low, high);
  const Key its_key = key(line);
  const auto [first, last] = by_key_.equal_range(its_key);
  const auto equal = std::find_if(
      first, last, [&](const auto& entry) { return is_same(line, lines_[entry.second]); });
  const uint32_t number = equal != last ? equal->second : uint32_t(lines_.size());
  if (equal == last) {
    lines_.push_back(line);
    by_key_.emplace(its_key, number);
  }
  if (2 * ++named_count_ > named_.size()) {
    const std::vector<Named> before = std::exchange(named_, std::vector<Named>(2 * named_.size()));
    for (const Named& named : before)
      if (named.planes != UINT64_MAX) place_of(named.planes) = named;
  }
  place_of(planes) = {planes, number};
  return number;
}

size_t LineTable::Hash::operator()(const Key& key) const {
  uint64_t hash = 0;
  for (const int64_t part : key)
    hash = (hash ^ uint64_t(part)) * 0x9e3779b97f4a7c15, hash ^= hash >> 32;
  return hash;
}

}  // namespace whittle
