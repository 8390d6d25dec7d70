#include "boundary/exact_line.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "boundary/numbering.h"

namespace whittle {
namespace {

using Wide4 = WideInt<4>;

Int128 magnitude(Int128 value) {
  return value < 0 ? -value : value;
}

/// The largest integer that is no more than a / b * 2^bits. Precondition: it is less than 2^55.
int64_t floor_of_ratio(const Wide4& a, const Wide4& b, int bits) {
  const long double ratio = std::ldexp(a.rounded() / b.rounded(), bits);
  const long double floor = std::floor(ratio);
  // What rounding made of the ratio decides nothing unless it is next to an integer.
  constexpr long double kRounding = 16 * std::numeric_limits<long double>::epsilon();
  const long double error = std::fabs(ratio) * kRounding;
  if (ratio - error > floor && ratio + error < floor + 1) return int64_t(floor);
  bool is_whole;
  return floor_of_quotient(a.shifted(unsigned(bits)), b, is_whole);
}

}  // namespace

ExactLine line_of(const ExactPlane& a, const ExactPlane& b) {
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

uint32_t hash_of(const ExactLine& line) {
  // Rounded in the same way whatever the scale of the coordinates.
  const size_t axis = size_t(line.axis), u = (axis + 1) % 3, v = (axis + 2) % 3;
  const Wide4 most(line.direction[axis]);
  auto hash = uint64_t(line.axis);
  for (const size_t i : {u, v}) {
    hash = add_to_hash(hash, uint64_t(floor_of_ratio(Wide4(line.direction[i]), most, 40)));
    hash = add_to_hash(hash, uint64_t(floor_of_ratio(Wide4(line.moment[i]), most, 20)));
  }
  return uint32_t(hash);
}

bool is_same(const ExactLine& a, const ExactLine& b) {
  if (a.axis != b.axis) return false;
  const size_t axis = size_t(a.axis);
  const Wide4 a_most(a.direction[axis]), b_most(b.direction[axis]);
  for (size_t i = 0; i < 3; ++i) {
    if (Wide4(a.direction[i]) * b_most != Wide4(b.direction[i]) * a_most) return false;
    if (Wide4(a.moment[i]) * b_most != Wide4(b.moment[i]) * a_most) return false;
  }
  return true;
}

NumberedLines number_lines(size_t n, const std::function<std::array<uint32_t, 2>(size_t)>& pair_of,
                           const ExactGeometry& geometry, const Workers& workers) {
  const auto planes_of = [&](size_t i) {
    const std::array<uint32_t, 2> pair = pair_of(i);
    const auto [low, high] = std::minmax(pair[0], pair[1]);
    return uint64_t(low) << 32 | high;
  };
  Numbering pairs = number_equals(
      n, [&](size_t i) { return uint32_t(add_to_hash(0, planes_of(i))); },
      [&](size_t i, size_t j) { return planes_of(i) == planes_of(j); }, workers);
  const auto line = [&](size_t pair) {
    const uint64_t planes = planes_of(pairs.firsts[pair]);
    return line_of(geometry.plane(uint32_t(planes >> 32)), geometry.plane(uint32_t(planes)));
  };
  std::vector<uint8_t> axes(pairs.firsts.size());
  const Numbering lines = number_equals(
      pairs.firsts.size(),
      [&](size_t i) {
        const ExactLine its_line = line(i);
        axes[i] = uint8_t(its_line.axis);
        return hash_of(its_line);
      },
      [&](size_t i, size_t j) { return is_same(line(i), line(j)); }, workers);
  NumberedLines result;
  for (const uint32_t first : lines.firsts) result.axes.push_back(axes[first]);
  result.numbers = std::move(pairs.numbers);
  for (uint32_t& number : result.numbers) number = lines.numbers[number];
  return result;
}

}  // namespace whittle
