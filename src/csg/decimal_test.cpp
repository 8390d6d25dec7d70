#include "csg/decimal.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <random>
#include <string>

namespace whittle {
namespace {

/// Each of the ways to read a number reads this one right, or not at all. How many read all of it.
int readers_of(const std::string& number) {
  const std::string text = number + ", 1.5, 2.25, 3.125]";
  double right = 0;
  std::from_chars(text.data(), text.data() + text.size(), right);
  int readers = 0;
  double value = 0;
  const auto check = [&](const char* end) {
    if (end == nullptr || end != text.data() + number.size()) return;
    ++readers;
    EXPECT_EQ(value, right) << number;
  };
  check(short_decimal(text.data(), value));
  check(longer_decimal(text.data(), value));
  check(exact_decimal(text.data(), text.data() + text.size(), value));
  return readers;
}

TEST(Decimal, PrintedNumbersAreReadRight) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-30, 30), digits(1, 10);
  for (int i = 0; i < 200'000; ++i) {
    const double x = digits(random) * std::pow(10, exponent(random));
    for (const char* form : {"{:.6g}", "{:.17g}", "{:.3f}", "{:.9g}", "{:.15e}"}) {
      readers_of(fmt::format(fmt::runtime(form), x));
    }
  }
}

TEST(Decimal, NumbersOfSixDigitsAreReadFast) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> exponent(-4, 6), digits(1, 9.9999);
  for (int i = 0; i < 100'000; ++i) {
    const double x = digits(random) * std::pow(10, exponent(random));
    const std::string text = fmt::format("{:.6g}", x);
    // By two of the three: one of those for a number of its length, and the one for all.
    if (text.find('e') == std::string::npos) {
      EXPECT_EQ(readers_of(text), 2) << text;
    }
  }
  for (const char* text : {"0", "1", "12", ".5", "1.", "0.5", "1234567", "123.456"})
    EXPECT_EQ(readers_of(text), 2) << text;
  for (const char* text : {"1e5", "1.43982e-16", "12345678", "1.5e22", "123456789012"})
    EXPECT_EQ(readers_of(text), 1) << text;
}

TEST(Decimal, WhatCannotBeReadExactlyIsLeft) {
  for (const char* text : {".", "", "e5", "1e", "1e+", "1e23", "1e-23", "9007199254740993",
                           "99999999999999999999", "0.00000000000000000000001", "1e99999"})
    EXPECT_EQ(readers_of(text), 0) << text;
}

}  // namespace
}  // namespace whittle
