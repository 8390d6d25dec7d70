// Integers of a fixed number of 64-bit words, as large as exact decisions need.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace whittle {

__extension__ using Int128 = __int128;
__extension__ using UInt128 = unsigned __int128;

/// Two's complement. Sums and products must fit; what does not is cut off.
template <size_t N>
class WideInt {
 public:
  constexpr WideInt() = default;
  constexpr explicit WideInt(Int128 value) {
    words_.fill(value < 0 ? ~uint64_t(0) : 0);
    words_[0] = uint64_t(value);
    words_[1] = uint64_t(UInt128(value) >> 64);
  }
  template <size_t M>
  requires(M < N) constexpr explicit WideInt(const WideInt<M>& value) {
    words_.fill(value.sign() < 0 ? ~uint64_t(0) : 0);
    for (size_t i = 0; i < M; ++i) words_[i] = value.word(i);
  }

  static constexpr WideInt of_words(const std::array<uint64_t, N>& words) {
    WideInt result;
    result.words_ = words;
    return result;
  }

  constexpr uint64_t word(size_t i) const { return words_[i]; }
  constexpr bool is_negative() const { return words_[N - 1] >> 63; }
  /// -1, 0 or 1.
  constexpr int sign() const {
    if (is_negative()) return -1;
    for (const uint64_t word : words_)
      if (word != 0) return 1;
    return 0;
  }

  constexpr bool operator==(const WideInt&) const = default;

  constexpr WideInt& operator+=(const WideInt& other) {
    uint64_t carry = 0;
    for (size_t i = 0; i < N; ++i) {
      const UInt128 sum = UInt128(words_[i]) + other.words_[i] + carry;
      words_[i] = uint64_t(sum);
      carry = uint64_t(sum >> 64);
    }
    return *this;
  }
  constexpr WideInt operator-() const {
    WideInt negated;
    uint64_t carry = 1;
    for (size_t i = 0; i < N; ++i) {
      negated.words_[i] = ~words_[i] + carry;
      carry = carry != 0 && negated.words_[i] == 0;
    }
    return negated;
  }
  constexpr WideInt& operator-=(const WideInt& other) { return *this += -other; }
  friend constexpr WideInt operator+(WideInt a, const WideInt& b) { return a += b; }
  friend constexpr WideInt operator-(WideInt a, const WideInt& b) { return a -= b; }

  friend constexpr WideInt operator*(const WideInt& a, const WideInt& b) {
    WideInt product;
    for (size_t i = 0; i < N; ++i) {
      uint64_t carry = 0;
      for (size_t j = 0; i + j < N; ++j) {
        const UInt128 sum = UInt128(a.words_[i]) * b.words_[j] + product.words_[i + j] + carry;
        product.words_[i + j] = uint64_t(sum);
        carry = uint64_t(sum >> 64);
      }
    }
    return product;
  }

  constexpr WideInt times(int64_t factor) const {
    const uint64_t size = factor < 0 ? -uint64_t(factor) : uint64_t(factor);
    WideInt product;
    uint64_t carry = 0;
    for (size_t i = 0; i < N; ++i) {
      const UInt128 sum = UInt128(words_[i]) * size + carry;
      product.words_[i] = uint64_t(sum);
      carry = uint64_t(sum >> 64);
    }
    return factor < 0 ? -product : product;
  }

  /// Times 2^bits.
  constexpr WideInt shifted(unsigned bits) const {
    WideInt result;
    const size_t words = bits / 64;
    const unsigned rest = bits % 64;
    for (size_t i = N; i-- > words;) {
      result.words_[i] = words_[i - words] << rest;
      if (rest > 0 && i > words) result.words_[i] |= words_[i - words - 1] >> (64 - rest);
    }
    return result;
  }

  /// To about the precision of a long double.
  long double rounded() const {
    if (is_negative()) return -(-*this).rounded();
    long double value = 0;
    for (size_t i = N; i-- > 0;) value = value * 0x1p64L + (long double)(words_[i]);
    return value;
  }

 private:
  std::array<uint64_t, N> words_{};
};

/// The product of two numbers, if it is less than 2^191.
constexpr WideInt<3> product(Int128 a, Int128 b) {
  const UInt128 x = a < 0 ? -UInt128(a) : UInt128(a), y = b < 0 ? -UInt128(b) : UInt128(b);
  const auto x_low = uint64_t(x), x_high = uint64_t(x >> 64), y_low = uint64_t(y),
             y_high = uint64_t(y >> 64);
  const UInt128 low = UInt128(x_low) * y_low;
  const UInt128 middle = UInt128(x_low) * y_high + uint64_t(low >> 64);
  const UInt128 other = UInt128(x_high) * y_low + uint64_t(middle);
  const uint64_t high = x_high * y_high + uint64_t(middle >> 64) + uint64_t(other >> 64);
  const auto size = WideInt<3>::of_words({uint64_t(low), uint64_t(other), high});
  return (a < 0) != (b < 0) ? -size : size;
}

/// The largest integer that is no more than a / b, and whether it is the quotient itself.
/// Precondition: b > 0, and the quotient is less than 2^62.
template <size_t N>
int64_t floor_of_quotient(WideInt<N> a, const WideInt<N>& b, bool& is_whole) {
  // A round leaves of the rest what a long double does not know.
  constexpr int kRounds = std::numeric_limits<long double>::digits >= 64 ? 1 : 2;
  const long double divisor = b.rounded();
  int64_t quotient = 0;
  for (int round = 0; round < kRounds; ++round) {
    const auto part = int64_t(std::floor(a.rounded() / divisor));
    quotient += part;
    a -= b.times(part);
  }
  for (; a.is_negative(); a += b) --quotient;
  for (WideInt<N> less = a - b; !less.is_negative(); less -= b) ++quotient, a = less;
  is_whole = a.sign() == 0;
  return quotient;
}

}  // namespace whittle
