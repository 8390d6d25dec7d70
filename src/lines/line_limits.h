// What the lines of a drawing may cost.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "base/result.h"

namespace whittle {

struct LineLimits {
  size_t parts = size_t(1) << 25;  ///< that lines are cut into
  /// Of lines that are tested since they are near one another; this many take a minute.
  uint64_t pairs = uint64_t(1) << 32;
};

/// Counts parts and pairs, from any thread.
class LineBudget {
 public:
  explicit LineBudget(const LineLimits& limits) : limits_(limits) {}

  void add(uint64_t pairs, size_t parts) {
    pairs_.fetch_add(pairs, std::memory_order_relaxed);
    parts_.fetch_add(parts, std::memory_order_relaxed);
  }

  /// Stays so once it is.
  bool is_spent() const { return parts() > limits_.parts || pairs() > limits_.pairs; }

  /// What is too much, of kMachine. Precondition: is_spent().
  Error error() const {
    return {ErrorKind::kMachine, pairs() > limits_.pairs
                                     ? "too many lines of the drawing run close to one another"
                                     : "the lines of the drawing cross too often"};
  }

 private:
  size_t parts() const { return parts_.load(std::memory_order_relaxed); }
  uint64_t pairs() const { return pairs_.load(std::memory_order_relaxed); }

  LineLimits limits_;
  std::atomic<size_t> parts_{0};
  std::atomic<uint64_t> pairs_{0};
};

}  // namespace whittle
