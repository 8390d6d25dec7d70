// A thread for work of which only the latest is wanted.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>

namespace whittle {

/// Runs one job at a time. A new one asks the one that runs to stop, and the result of that is
/// dropped.
template <class T>
class LatestJob {
 public:
  using Job = std::function<T(const std::stop_token&)>;

  /// `notify` is called from that thread when there is a result.
  explicit LatestJob(std::function<void()> notify)
      : notify_(std::move(notify)), thread_([this](const std::stop_token& quit) { run(quit); }) {}
  ~LatestJob() {
    thread_.request_stop();
    {
      const std::lock_guard lock(mutex_);
      stop_.request_stop();
    }
    thread_.join();
  }
  LatestJob(const LatestJob&) = delete;
  LatestJob& operator=(const LatestJob&) = delete;

  void start(Job job) {
    {
      const std::lock_guard lock(mutex_);
      stop_.request_stop();
      next_ = std::move(job);
      result_.reset();
      is_busy_ = true;
    }
    changed_.notify_all();
  }

  /// Whether there is a job without a result.
  bool is_busy() const {
    const std::lock_guard lock(mutex_);
    return is_busy_;
  }

  /// The result of the latest job, once.
  std::optional<T> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(result_, std::nullopt);
  }

 private:
  void run(const std::stop_token& quit) {
    std::unique_lock lock(mutex_);
    while (changed_.wait(lock, quit, [this] { return next_ != nullptr; })) {
      const Job job = std::exchange(next_, nullptr);
      stop_ = std::stop_source();
      if (quit.stop_requested()) break;
      const std::stop_token stop = stop_.get_token();
      lock.unlock();
      std::optional<T> result = job(stop);
      lock.lock();
      if (next_ != nullptr) continue;
      result_ = std::move(result);
      is_busy_ = false;
      lock.unlock();
      notify_();
      lock.lock();
    }
  }

  const std::function<void()> notify_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  Job next_;
  std::stop_source stop_;
  std::optional<T> result_;
  bool is_busy_ = false;
  std::jthread thread_;  ///< last: it uses all the others
};

}  // namespace whittle
