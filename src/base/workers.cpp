#include "base/workers.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>

namespace whittle {
namespace {

/// How long a thread looks for what comes next before it sleeps: to be woken takes about as long,
/// and one loop often follows another.
constexpr std::chrono::microseconds kAwake{100};

/// Waits for a short time, as far as others leave the processor to it. False if in vain.
template <class Condition>
bool watch_for(const Condition& condition) {
  if (condition()) return true;
  const auto end = std::chrono::steady_clock::now() + kAwake;
  do {
    std::this_thread::yield();
    if (condition()) return true;
  } while (std::chrono::steady_clock::now() < end);
  return false;
}

/// What is being done, and how far it is.
class Loop {
 public:
  Loop(size_t n, size_t grain, size_t workers, const Workers::Body& body)
      : n_(n), grain_(std::max<size_t>(grain, 1)), workers_(workers), body_(body) {}

  /// Does parts until none is left.
  void work(size_t worker) {
    try {
      size_t first = 0, last = 0;
      while (take(first, last)) body_(first, last, worker);
    } catch (...) {
      next_.store(n_, std::memory_order_relaxed);
      const std::lock_guard lock(thrown_mutex_);
      if (!thrown_) thrown_ = std::current_exception();
    }
  }

  /// Nobody may be at work any more.
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  /// Large parts first, and smaller ones the less is left, so that all end at about the same time.
  bool take(size_t& first, size_t& last) {
    constexpr size_t kPartsEach = 4;
    first = next_.load(std::memory_order_relaxed);
    do {
      if (first >= n_) return false;
      const size_t left = n_ - first;
      last = first + std::min(left, std::max(grain_, left / (kPartsEach * workers_)));
    } while (!next_.compare_exchange_weak(first, last, std::memory_order_relaxed));
    return true;
  }

  const size_t n_, grain_, workers_;
  const Workers::Body& body_;
  std::atomic<size_t> next_ = 0;
  std::mutex thrown_mutex_;
  std::exception_ptr thrown_;
};

}  // namespace

struct Workers::State {
  explicit State(size_t workers) : count(workers) {}

  /// Has up to that many threads besides the caller's. Fewer do as well, where the machine refuses.
  void have(size_t others) {
    try {
      while (threads.size() < others) {
        threads.emplace_back([this, worker = threads.size() + 1] { serve(worker); });
      }
    } catch (const std::system_error&) {
    }
  }

  /// A thread's life: to join whatever loop there is, until the end.
  void serve(size_t worker) {
    for (uint64_t seen = 0;;) {
      watch_for([&] { return begun.load(std::memory_order_relaxed) != seen; });
      std::unique_lock lock(mutex);
      changed.wait(lock, [&] { return ended || (loop != nullptr && begun != seen); });
      if (ended) return;
      seen = begun;
      Loop& joined = *loop;
      ++inside;
      lock.unlock();
      joined.work(worker);
      lock.lock();
      if (--inside == 0) left.notify_one();
    }
  }

  void run(Loop& what) {
    {
      const std::lock_guard lock(mutex);
      loop = &what;
      ++begun;
    }
    changed.notify_all();
    what.work(0);
    {
      // Nobody joins any more.
      const std::lock_guard lock(mutex);
      loop = nullptr;
    }
    watch_for([&] { return inside == 0; });
    std::unique_lock lock(mutex);
    left.wait(lock, [&] { return inside == 0; });
  }

  const size_t count;
  std::mutex turn;                   ///< one loop at a time
  std::vector<std::thread> threads;  ///< changes in a turn
  // Below: written under `mutex`; the numbers are also watched without.
  std::mutex mutex;
  std::condition_variable changed, left;
  Loop* loop = nullptr;
  std::atomic<uint64_t> begun = 0;  ///< loops so far, and the end
  std::atomic<size_t> inside = 0;   ///< threads in the loop, without the caller's
  bool ended = false;
};

Workers::Workers(int threads)
    : state_(new State(threads > 0 ? size_t(threads)
                                   : std::max(1u, std::thread::hardware_concurrency()))) {}

Workers::~Workers() {
  {
    const std::lock_guard lock(state_->mutex);
    state_->ended = true;
    ++state_->begun;  // for who watches
  }
  state_->changed.notify_all();
  for (std::thread& thread : state_->threads) thread.join();
}

size_t Workers::count() const {
  return state_->count;
}

void Workers::for_parts(size_t n, size_t grain, const Body& body) const {
  if (n == 0) return;
  const size_t parts = grain < n ? (n - 1) / std::max<size_t>(grain, 1) + 1 : 1;
  Loop loop(n, grain, state_->count, body);
  const std::lock_guard turn(state_->turn);
  state_->have(std::min(state_->count, parts) - 1);
  if (parts == 1 || state_->threads.empty())
    loop.work(0);
  else
    state_->run(loop);
  loop.rethrow();
}

}  // namespace whittle
