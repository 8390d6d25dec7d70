#include "boundary/numbering.h"

#include <gtest/gtest.h>

#include <random>

namespace whittle {
namespace {

std::vector<uint32_t> some_values(size_t n, uint32_t different) {
  std::mt19937_64 random(n);
  std::vector<uint32_t> values(n);
  for (uint32_t& value : values) value = uint32_t(random() % different);
  return values;
}

TEST(Numbering, EqualThingsHaveOneNumberInTheOrderOfTheFirst) {
  for (const size_t n : {0u, 1u, 5'000u, 100'000u})
    for (const uint32_t different : {1u, 7u, 40'000u})
      for (const int threads : {1, 3}) {
        const std::vector<uint32_t> values = some_values(n, different);
        // The hash is poor, so that different things meet.
        const Numbering numbering = number_equals(
            n, [&](size_t i) { return uint32_t(add_to_hash(0, values[i] / 3)); },
            [&](size_t i, size_t j) { return values[i] == values[j]; }, Workers(threads));
        ASSERT_EQ(numbering.numbers.size(), n);
        std::vector<uint32_t> firsts, number_of(different, UINT32_MAX);
        for (uint32_t i = 0; i < n; ++i) {
          uint32_t& number = number_of[values[i]];
          if (number == UINT32_MAX) {
            number = uint32_t(firsts.size());
            firsts.push_back(i);
          }
          ASSERT_EQ(numbering.numbers[i], number);
        }
        EXPECT_EQ(numbering.firsts, firsts);
      }
}

TEST(Buckets, EachHasItsNumbersInOrder) {
  const std::vector<uint32_t> values = some_values(50'000, 9);
  const Buckets buckets = sort_into_buckets(
      values.size(), 10, [&](size_t i) { return values[i]; }, Workers(3));
  ASSERT_EQ(buckets.count(), 10u);
  size_t count = 0;
  for (size_t b = 0; b < 10; ++b) {
    EXPECT_TRUE(std::is_sorted(buckets[b].begin(), buckets[b].end()));
    for (const uint32_t i : buckets[b]) EXPECT_EQ(values[i], b);
    count += buckets[b].size();
  }
  EXPECT_EQ(count, values.size());
}

}  // namespace
}  // namespace whittle
