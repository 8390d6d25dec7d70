// Decimal numbers as OpenSCAD prints them, read as fast as may be and rounded exactly.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <iterator>

namespace whittle {

/// 10^0 to 10^22, all of them doubles without an error.
inline constexpr double kPowersOfTen[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                          1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                          1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// The value of eight decimal digits in the order of the text, the first in the lowest byte; each
/// byte is a digit's value. Pairs are made of bytes, then quadruples of pairs, then all of it.
inline uint64_t value_of_eight_digits(uint64_t digits) {
  digits = digits * 10 + (digits >> 8);
  constexpr uint64_t kMask = 0x000000ff000000ff;
  return ((digits & kMask) * (100 + (uint64_t{1000000} << 32)) +
          ((digits >> 16) & kMask) * (1 + (uint64_t{10000} << 32))) >>
         32;
}

/// Digits with or without a point among the first eight characters at `from`, of which at least
/// eight can be read. Returns the end of the number; null if it does not end within them, or if it
/// is none. What comes next is not looked at: there may be more of the number, such as an exponent.
///
/// Without a branch on how long the number is, which cannot be foretold.
inline const char* short_decimal(const char* from, double& value) {
  if constexpr (std::endian::native != std::endian::little) return nullptr;
  uint64_t text;
  std::memcpy(&text, from, sizeof text);
  constexpr uint64_t kEach = 0x0101010101010101;
  // The high bit of each byte that is no digit; beyond the first that is no ASCII character some
  // may be wrong, by a carry, but never the first.
  const uint64_t flipped = text ^ (kEach * '0');
  const uint64_t others = ((flipped + kEach * 0x76) | flipped) & (kEach * 0x80);
  if (others == 0) return nullptr;
  const int whole = std::countr_zero(others) & ~7;  // bits of the digits before the point
  const bool has_point = ((text >> whole) & 0xff) == '.';
  const uint64_t after = others & (others - 1);
  if (has_point && after == 0) return nullptr;
  const int end = has_point ? std::countr_zero(after) & ~7 : whole;
  const int digits = end - (has_point ? 8 : 0);
  if (digits <= 0) return nullptr;
  const uint64_t before = (uint64_t{1} << whole) - 1;
  const uint64_t joined = has_point ? (flipped & before) | ((flipped >> 8) & ~before) : flipped;
  const int decimals = (digits - whole) >> 3;
  // Zeros come in front; what is behind the number goes.
  value =
      static_cast<double>(value_of_eight_digits(joined << (64 - digits))) / kPowersOfTen[decimals];
  return from + (end >> 3);
}

/// The same of sixteen characters, of which the first eight are digits and a point: what
/// short_decimal() leaves over of numbers of six digits, as 0.0123456 is.
inline const char* longer_decimal(const char* from, double& value) {
  if constexpr (std::endian::native != std::endian::little) return nullptr;
  uint64_t first, second;
  std::memcpy(&first, from, sizeof first);
  std::memcpy(&second, from + sizeof first, sizeof second);
  constexpr uint64_t kEach = 0x0101010101010101;
  const uint64_t flipped = first ^ (kEach * '0'), rest = second ^ (kEach * '0');
  const uint64_t others = ((flipped + kEach * 0x76) | flipped) & (kEach * 0x80);
  const uint64_t ends = ((rest + kEach * 0x76) | rest) & (kEach * 0x80);
  if (others == 0 || (others & (others - 1)) != 0 || ends == 0) return nullptr;
  const int whole = std::countr_zero(others) & ~7;
  if (((first >> whole) & 0xff) != '.') return nullptr;
  const uint64_t before = (uint64_t{1} << whole) - 1;
  const uint64_t joined = (flipped & before) | ((flipped >> 8) & ~before);
  const int more = std::countr_zero(ends) & ~7;
  const int count = more >> 3;
  const uint64_t tail = more == 0 ? 0 : value_of_eight_digits(rest << (64 - more));
  constexpr uint64_t kWhole[] = {1, 10, 100, 1000, 10000, 100000, 1000000, 10000000};
  const uint64_t digits = value_of_eight_digits(joined << 8) * kWhole[count] + tail;
  value = static_cast<double>(digits) / kPowersOfTen[7 - (whole >> 3) + count];
  return from + 8 + count;
}

/// Digits with or without a point, then perhaps an exponent. Returns their end; null if this is no
/// number, or none whose digits and power of ten are doubles without an error, so that one
/// multiplication or division rounds as it should (Clinger, How to read floating point numbers
/// accurately, 1990).
inline const char* exact_decimal(const char* from, const char* end, double& value) {
  constexpr uint64_t kMostDigits = uint64_t{1} << 53;
  const auto is_digit = [](char c) { return static_cast<unsigned char>(c - '0') < 10; };
  uint64_t digits = 0;
  const char* to = from;
  const auto take_digits = [&] {
    for (; to != end && is_digit(*to); ++to) {
      if (digits >= kMostDigits) return false;
      digits = digits * 10 + static_cast<uint64_t>(*to - '0');
    }
    return true;
  };
  if (!take_digits()) return nullptr;
  auto count = to - from;
  int exponent = 0;
  if (to != end && *to == '.') {
    const char* const point = ++to;
    if (!take_digits()) return nullptr;
    if (to - point > 400) return nullptr;
    count += to - point;
    exponent = -static_cast<int>(to - point);
  }
  if (count == 0 || digits >= kMostDigits) return nullptr;
  if (to != end && (*to == 'e' || *to == 'E')) {
    ++to;
    const bool negative = to != end && *to == '-';
    if (to != end && (*to == '-' || *to == '+')) ++to;
    const char* const first = to;
    int written = 0;
    for (; to != end && is_digit(*to); ++to) {
      if (to - first > 4) return nullptr;
      written = written * 10 + (*to - '0');
    }
    if (to == first) return nullptr;
    exponent += negative ? -written : written;
  }
  constexpr int kMost = static_cast<int>(std::size(kPowersOfTen)) - 1;
  if (exponent < -kMost || exponent > kMost) return nullptr;
  const auto exact = static_cast<double>(digits);
  value = exponent < 0 ? exact / kPowersOfTen[-exponent] : exact * kPowersOfTen[exponent];
  return to;
}

}  // namespace whittle
