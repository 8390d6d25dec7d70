#include "progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "console.h"

namespace whittle {
namespace {

constexpr auto kSilence = std::chrono::seconds(1);
constexpr auto kInterval = std::chrono::milliseconds(100);
constexpr const char* kEraseLine = "\r\x1b[K";

void show(const std::string& text) {
  // Unbuffered, and if the terminal is gone nothing is lost.
  (void)!::write(STDERR_FILENO, text.data(), text.size());
}

}  // namespace

struct ProgressLine::State {
  std::atomic<const char*> stage = nullptr;
  std::atomic<double> share = -1;  ///< negative: not known
  std::mutex mutex;
  std::condition_variable wake;
  bool over = false;
  std::thread thread;

  void run() {
    std::unique_lock lock(mutex);
    if (wake.wait_for(lock, kSilence, [this] { return over; })) return;
    do {
      const double done = share;
      show(done < 0 ? fmt::format("{}{} ...", kEraseLine, stage.load())
                    : fmt::format("{}{} {:.0f} %", kEraseLine, stage.load(), 100 * done));
    } while (!wake.wait_for(lock, kInterval, [this] { return over; }));
    show(kEraseLine);
  }
};

ProgressLine::ProgressLine(bool wanted, const char* stage) {
  if (!wanted || keeps_words() || ::isatty(STDERR_FILENO) == 0) return;
  state_ = std::make_unique<State>();
  state_->stage = stage;
  state_->thread = std::thread(&State::run, state_.get());
}

ProgressLine::~ProgressLine() {
  if (!state_) return;
  {
    const std::lock_guard lock(state_->mutex);
    state_->over = true;
  }
  state_->wake.notify_one();
  state_->thread.join();
}

void ProgressLine::stage(const char* name) {
  if (!state_) return;
  state_->share = -1;
  state_->stage = name;
}

Progress ProgressLine::share() {
  if (!state_) return {};
  return [state = state_.get()](double done) { state->share = done; };
}

void ProgressLine::without_line(const std::function<void()>& say) {
  if (!state_) {
    say();
    return;
  }
  const std::lock_guard lock(state_->mutex);
  show(kEraseLine);
  say();
}

}  // namespace whittle
