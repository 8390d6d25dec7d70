// Cells are refined on one thread while another draws those that are ready.
#pragma once

#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include "trace/vulkan/cell_supply.h"

namespace whittle {

/// A CellSupply's stream, which runs on a thread of its own. It is at most one batch ahead of the
/// drawing, because what has been drawn tells it what need not be refined at all.
class CellStream {
 public:
  /// Until it ends, nobody else may use the supply. The arguments must outlive it.
  CellStream(CellSupply& supply, const Sight& sight, double first_batch_ms);
  ~CellStream();
  CellStream(const CellStream&) = delete;
  CellStream& operator=(const CellStream&) = delete;

  /// Waits for the next batch. Not after the last, nor after an error. Throws what refining threw.
  Result<CellBatch> next();
  /// Cells that are hidden by this need not be refined from now on.
  void hide(CellSupply::Solved solved);

 private:
  void run(CellSupply& supply, const Sight& sight, double first_batch_ms);

  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<CellBatch> batch_;  ///< the next
  CellSupply::Solved solved_;
  Status status_ = Done{};
  std::exception_ptr thrown_;
  bool has_ended_ = false;  ///< no batch comes any more
  bool is_unwanted_ = false;
  std::thread thread_;  // last: it uses all above
};

}  // namespace whittle
