// Who refines an open cell: one thread, while others that need it wait.
#pragma once

#include <chrono>
#include <optional>
#include <thread>

#include "subdivide/open_cell.h"

namespace whittle {

/// The right to refine an open cell. Where it ends without a result, the cell is open as before.
class CellClaim {
 public:
  /// Waits as long as another thread has it. None if the cell is not open; then `known` is what it
  /// is.
  static std::optional<CellClaim> take(const Cell& cell, CellLink& known) {
    for (int round = 0;; ++round) {
      known = cell.link();
      if (known.kind() != CellKind::kOpen) return std::nullopt;
      uint64_t bits = known.bits();
      if ((bits & CellLink::kBusy) == 0 &&
          cell.bits.compare_exchange_strong(bits, bits | CellLink::kBusy))
        return CellClaim(cell, known);
      wait_a_little(round);
    }
  }
  CellClaim(CellClaim&& other) noexcept : cell_(other.cell_), open_(other.open_) {
    other.cell_ = nullptr;
  }
  CellClaim& operator=(CellClaim&&) = delete;
  ~CellClaim() {
    if (cell_ != nullptr) become(open_);
  }

  /// The link of the open cell, and what it leads to.
  CellLink link() const { return open_; }
  const OpenCell& open() const { return *static_cast<const OpenCell*>(open_.target()); }

  /// From here on all threads see the result, and the claim is over.
  void become(CellLink result) {
    cell_->bits.store(result.bits(), std::memory_order_release);
    cell_ = nullptr;
  }

 private:
  CellClaim(const Cell& cell, CellLink open) : cell_(&cell), open_(open) {}

  /// Those who wait look so many times in a row, and then now and then.
  static void wait_a_little(int round) {
    constexpr int kSpins = 200;
    constexpr std::chrono::microseconds kNap{20};
    if (round < kSpins)
      std::this_thread::yield();
    else
      std::this_thread::sleep_for(kNap);
  }

  const Cell* cell_;
  CellLink open_;
};

}  // namespace whittle
