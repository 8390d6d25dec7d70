// Numbers for things of which some are equal, and things sorted by number, on all threads. Nothing
// depends on how many there are.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/workers.h"

namespace whittle {

/// The numbers below some n in buckets, each of them in order.
struct Buckets {
  std::vector<uint32_t> items;
  /// Where each bucket begins in items, and the end.
  std::vector<size_t> firsts;

  size_t count() const { return firsts.size() - 1; }
  std::span<const uint32_t> operator[](size_t bucket) const {
    return std::span(items).subspan(firsts[bucket], firsts[bucket + 1] - firsts[bucket]);
  }
};

/// `bucket_of(i)` is below `buckets`.
template <class BucketOf>
Buckets sort_into_buckets(size_t n, size_t buckets, const BucketOf& bucket_of,
                          const Workers& workers) {
  constexpr size_t kLeastChunk = 1 << 14, kMostChunks = 32;
  const size_t chunk = std::max(kLeastChunk, n / kMostChunks + 1);
  const size_t chunks = (n + chunk - 1) / chunk;
  std::vector<uint32_t> next(chunks * buckets);
  const auto for_chunks = [&](const auto& visit) {
    workers.for_parts(chunks, 1, [&](size_t begin, size_t end, size_t) {
      for (size_t c = begin; c < end; ++c)
        for (size_t i = c * chunk; i < std::min(n, (c + 1) * chunk); ++i)
          visit(uint32_t(i), next[c * buckets + bucket_of(i)]);
    });
  };
  for_chunks([](uint32_t, uint32_t& count) { ++count; });
  Buckets result;
  result.items.resize(n);
  uint32_t sum = 0;
  for (size_t b = 0; b < buckets; ++b) {
    result.firsts.push_back(sum);
    for (size_t c = 0; c < chunks; ++c) {
      const uint32_t count = next[c * buckets + b];
      next[c * buckets + b] = sum;
      sum += count;
    }
  }
  result.firsts.push_back(n);
  for_chunks([&](uint32_t i, uint32_t& at) { result.items[at++] = i; });
  return result;
}

/// Which of n things are equal.
struct Numbering {
  std::vector<uint32_t> numbers;  ///< of each thing; those that are equal have the same
  std::vector<uint32_t> firsts;   ///< by number the first of those that have it: they rise
};

/// `hash_of(i)`: the same for things that are equal, and good in all its bits. `is_same(i, j)` is
/// asked of things with one hash.
template <class HashOf, class IsSame>
Numbering number_equals(size_t n, const HashOf& hash_of, const IsSame& is_same,
                        const Workers& workers) {
  constexpr uint32_t kFree = UINT32_MAX;
  constexpr int kMostBits = 10;
  // A bucket's table should stay in a core's cache.
  const int bits = std::clamp(int(std::bit_width(n >> 11)), 1, kMostBits);
  std::vector<uint32_t> hashes(n);
  workers.for_parts(n, 1024, [&](size_t begin, size_t end, size_t) {
    for (size_t i = begin; i < end; ++i) hashes[i] = hash_of(i);
  });
  const Buckets buckets = sort_into_buckets(
      n, size_t(1) << bits, [&](size_t i) { return size_t(hashes[i] >> (32 - bits)); }, workers);
  Numbering result;
  std::vector<uint32_t>& numbers = result.numbers;
  numbers.resize(n);
  // At first of each thing the first that is equal.
  workers.for_parts(buckets.count(), 1, [&](size_t begin, size_t end, size_t) {
    std::vector<uint32_t> places;
    for (size_t b = begin; b < end; ++b) {
      const size_t size = std::bit_ceil(2 * buckets[b].size() + 1);
      places.assign(size, kFree);
      for (const uint32_t item : buckets[b]) {
        size_t at = hashes[item] & (size - 1);
        while (places[at] != kFree &&
               !(hashes[places[at]] == hashes[item] && is_same(places[at], item)))
          at = (at + 1) & (size - 1);
        if (places[at] == kFree) places[at] = item;
        numbers[item] = places[at];
      }
    }
  });
  for (uint32_t i = 0; i < n; ++i) {
    if (numbers[i] == i) {
      numbers[i] = uint32_t(result.firsts.size());
      result.firsts.push_back(i);
    } else {
      numbers[i] = numbers[numbers[i]];
    }
  }
  return result;
}

/// A hash that is good in all its bits, of numbers one after the other.
inline uint64_t add_to_hash(uint64_t hash, uint64_t part) {
  hash = (hash ^ part) * 0x9e3779b97f4a7c15;
  return hash ^ hash >> 32;
}

}  // namespace whittle
