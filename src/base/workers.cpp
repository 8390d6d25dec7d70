#include "base/workers.h"

#if defined(WHITTLE_SANITIZED_THREADS)
#include <algorithm>
#include <exception>
#include <thread>
#else
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace whittle {

#if defined(WHITTLE_SANITIZED_THREADS)

// The thread sanitizer does not see how oneTBB, which is not built with it, hands work from thread
// to thread, and would take that for races. These are threads that it does see.

struct Workers::State {
  size_t count;
};

Workers::Workers(int threads) : state_(new State{}) {
  constexpr size_t kFew = 4;  // a race needs no more
  state_->count = threads > 0 ? size_t(threads) : kFew;
}

Workers::~Workers() = default;

size_t Workers::count() const {
  return state_->count;
}

void Workers::for_parts(size_t n, size_t grain, const Body& body) const {
  std::vector<std::exception_ptr> thrown(count());
  const auto work = [&](size_t worker) {
    try {
      for (size_t first = worker * grain; first < n; first += count() * grain)
        body(first, std::min(n, first + grain), worker);
    } catch (...) {
      thrown[worker] = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    for (size_t worker = 1; worker < count(); ++worker) others.emplace_back(work, worker);
    work(0);
  }
  for (const std::exception_ptr& exception : thrown)
    if (exception) std::rethrow_exception(exception);
}

#else

struct Workers::State {
  std::optional<tbb::global_control> more_than_machine;
  tbb::task_arena arena;
};

Workers::Workers(int threads) : state_(new State{}) {
  if (threads > tbb::info::default_concurrency())
    state_->more_than_machine.emplace(tbb::global_control::max_allowed_parallelism,
                                      size_t(threads));
  state_->arena.initialize(threads > 0 ? threads : tbb::task_arena::automatic);
}

Workers::~Workers() = default;

size_t Workers::count() const {
  return size_t(state_->arena.max_concurrency());
}

void Workers::for_parts(size_t n, size_t grain, const Body& body) const {
  state_->arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<size_t>(0, n, grain), [&](const auto& part) {
      body(part.begin(), part.end(), size_t(tbb::this_task_arena::current_thread_index()));
    });
  });
}

#endif

}  // namespace whittle
