// What evaluating may cost.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "flat/sweep_work.h"
#include "model/model.h"

namespace whittle {

/// Counts facets that are made, and corners that are computed with, before memory or time is spent
/// on them.
class Budget {
 public:
  explicit Budget(size_t most_facets) : most_(most_facets) {}

  /// False if there are more facets now than the limit.
  bool spend(uint64_t facets) {
    facets_ = saturated(facets_, facets);
    return facets_ <= most_;
  }

  /// False if what was computed with has more corners now than kWork times the limit.
  bool work(uint64_t corners) {
    work_ = saturated(work_, corners);
    return work_ / kWork <= most_;
  }

  /// False if outlines so far would take longer than kMostSweepWork to take apart where they cross
  /// themselves or one another.
  bool sweep(std::span<const Contour> outlines) {
    sweep_ = saturated(sweep_, estimate_sweep_work(outlines));
    return !is_tangled();
  }

  /// Spends all of it: something takes too much that was not counted here, for a reason in words.
  void refuse(std::string why) { why_ = std::move(why); }

  bool is_spent() const {
    return facets_ > most_ || work_ / kWork > most_ || is_tangled() || !why_.empty();
  }

  /// Why it is spent, in words.
  std::string message() const;

 private:
  static constexpr uint64_t kWork = 30;
  bool is_tangled() const { return sweep_ > kMostSweepWork; }
  static uint64_t saturated(uint64_t a, uint64_t b) { return a + b < a ? UINT64_MAX : a + b; }

  uint64_t most_, facets_ = 0, work_ = 0, sweep_ = 0;
  std::string why_;
};

}  // namespace whittle
