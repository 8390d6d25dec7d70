#include "trace/vulkan/cell_stream.h"

#include <utility>

namespace whittle {

CellStream::CellStream(CellSupply& supply, const Sight& sight, double first_batch_ms)
    : thread_([this, &supply, &sight, first_batch_ms] { run(supply, sight, first_batch_ms); }) {}

CellStream::~CellStream() {
  {
    const std::lock_guard lock(mutex_);
    is_unwanted_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void CellStream::run(CellSupply& supply, const Sight& sight, double first_batch_ms) {
  Status status = Done{};
  std::exception_ptr thrown;
  try {
    const auto solved = [&] {
      const std::lock_guard lock(mutex_);
      return solved_;
    };
    const auto take = [&](CellBatch batch) {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return !batch_ || is_unwanted_; });
      if (is_unwanted_) return false;
      batch_ = std::move(batch);
      changed_.notify_all();
      return true;
    };
    status = supply.stream(sight, first_batch_ms, solved, take);
  } catch (...) {
    thrown = std::current_exception();
  }
  const std::lock_guard lock(mutex_);
  status_ = std::move(status);
  thrown_ = thrown;
  has_ended_ = true;
  changed_.notify_all();
}

Result<CellBatch> CellStream::next() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return batch_ || has_ended_; });
  if (!batch_) {
    if (thrown_) std::rethrow_exception(thrown_);
    return status_.error();
  }
  CellBatch batch = *std::exchange(batch_, std::nullopt);
  changed_.notify_all();
  return batch;
}

void CellStream::hide(CellSupply::Solved solved) {
  const std::lock_guard lock(mutex_);
  solved_ = std::move(solved);
}

}  // namespace whittle
