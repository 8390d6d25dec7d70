// A bounded group of threads for parallel loops (oneTBB underneath).
#pragma once

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <optional>

namespace whittle {

class Workers {
 public:
  /// `threads` 0 or less means as many as the machine has. More than it has are allowed.
  explicit Workers(int threads) : arena_(threads > 0 ? threads : tbb::task_arena::automatic) {
    if (threads > tbb::info::default_concurrency())
      limit_.emplace(tbb::global_control::max_allowed_parallelism, size_t(threads));
  }

  /// Runs `work`; parallel loops inside it use these threads. Returns when it is done.
  template <class Work>
  void run(Work&& work) {
    arena_.execute(work);
  }

 private:
  std::optional<tbb::global_control> limit_;
  tbb::task_arena arena_;
};

}  // namespace whittle
