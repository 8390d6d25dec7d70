// What the generators share: repeatable chance, and lines of `.csg` text.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/vec.h"

namespace whittle {

/// SplitMix64 (Steele, Lea, Flood: Fast Splittable Pseudorandom Number Generators, 2014). Integers
/// and exact divisions only, so that every platform draws the same numbers; the distributions of
/// the standard library do not promise that.
class Chance {
 public:
  explicit Chance(uint64_t seed) : state_(seed) {}

  uint64_t bits() {
    uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  /// Uniform in [0, 1), a multiple of 2^-53.
  double unit() { return double(bits() >> 11) * 0x1p-53; }
  double between(double lo, double hi) { return lo + (hi - lo) * unit(); }
  /// Uniform in lo..hi, both included. Precondition: lo <= hi.
  int integer(int lo, int hi) { return lo + int(unit() * (double(hi) - lo + 1)); }
  bool happens(double probability) { return unit() < probability; }

 private:
  uint64_t state_;
};

/// `.csg` text in the making. Numbers are written in plain decimals, at most three of them.
class CsgText {
 public:
  /// A whole line of comment; "" is an empty line without the slashes.
  void comment(std::string_view text);
  /// Opens `head {`, which close() ends.
  void open(std::string_view head);
  void close();
  /// One statement, `;` included, on a line of its own.
  void line(std::string_view statement);

  std::string take() && { return std::move(text_); }

 private:
  void indent();

  std::string text_;
  int depth_ = 0;
};

/// A number as text: rounded to three decimals, no trailing zeros, never "-0", never an exponent.
/// Precondition: |value| < 1e12.
std::string number(double value);

/// `[x, y, z]`
std::string vector(Vec3 v);

}  // namespace whittle
