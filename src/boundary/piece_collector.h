// Pieces that all workers make, in one order.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <stop_token>
#include <utility>
#include <vector>

#include "base/workers.h"
#include "boundary/pieces.h"

namespace whittle {

/// Puts the pieces of chunks behind others. The chunks are empty then.
void append_pieces(std::vector<Pieces>& chunks, const Workers& workers, Pieces& out);

class PieceCollector {
 public:
  struct Limits {
    std::stop_token stop;
    std::function<void(double share)> progress;
    size_t pieces;
  };
  PieceCollector(const Workers& workers, Limits limits)
      : workers_(workers), limits_(std::move(limits)) {}

  /// Adds what `add(maker, i, pieces)` makes for all i < n, some of them at a time by one maker,
  /// which `maker_of(worker)` gives. Of all that is to be done these are the shares `from` to `to`.
  /// False if there are more pieces than may be.
  template <class MakerOf, class Add>
  bool collect(size_t n, size_t at_a_time, const MakerOf& maker_of, const Add& add, double from,
               double to, Pieces& out) const {
    std::atomic<size_t> count = out.count;
    std::vector<Pieces> chunks((n + at_a_time - 1) / at_a_time);
    std::atomic<size_t> done = 0;
    workers_.for_parts(chunks.size(), 1, [&](size_t first, size_t last, size_t worker) {
      auto& maker = maker_of(worker);
      const auto is_over = [&] { return limits_.stop.stop_requested() || count > limits_.pieces; };
      for (size_t chunk = first; chunk < last && !is_over(); ++chunk) {
        for (size_t i = chunk * at_a_time; i < std::min(n, (chunk + 1) * at_a_time); ++i)
          add(maker, i, chunks[chunk]);
        count += chunks[chunk].count;
        if (limits_.progress)
          limits_.progress(from + (to - from) * double(++done) / double(chunks.size()));
      }
    });
    if (count > limits_.pieces) return false;
    append_pieces(chunks, workers_, out);
    return true;
  }

 private:
  const Workers& workers_;
  const Limits limits_;
};

}  // namespace whittle
