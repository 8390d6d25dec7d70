#include "many_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <new>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "console.h"
#include "limits.h"
#include "progress.h"

namespace whittle {
namespace {

/// As many programs can be ended when this one is (child_process.h).
constexpr size_t kMostAtATime = 16;

/// What a file is expected to take, bytes: a little for any, and so many times its text.
constexpr uint64_t kLeastMemory = uint64_t(32) << 20;
constexpr uint64_t kMemoryOfText = 16;

/// A text that takes so much memory that it is given back behind it, bytes.
constexpr uint64_t kLargeText = uint64_t(1) << 20;

uint64_t bytes_of(const std::string& file) {
  struct stat status {};
  return ::stat(file.c_str(), &status) == 0 && S_ISREG(status.st_mode) ? uint64_t(status.st_size)
                                                                       : 0;
}

/// Bytes of this process that are in memory now; 0 where nobody says. Takes none itself, as there
/// may be none left.
uint64_t memory_in_use() {
  const int file = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0;
  char text[128] = {};
  const ssize_t length = ::read(file, text, sizeof(text) - 1);
  ::close(file);
  if (length <= 0) return 0;
  char* resident = nullptr;
  std::strtoull(text, &resident, 10);
  return std::strtoull(resident, nullptr, 10) * uint64_t(::sysconf(_SC_PAGESIZE));
}

/// Which file is next, and when.
class Schedule {
 public:
  struct Task {
    size_t file = 0;
    int threads = 1;
    bool is_alone = false;  ///< nothing else runs beside it
  };

  Schedule(const ManyFiles& many, size_t threads)
      : threads_(threads),
        most_at_a_time_(many.one_at_a_time ? 1 : std::min(threads, kMostAtATime)),
        unfinished_(many.files.size()) {
    for (const std::string& file : many.files) bytes_.push_back(bytes_of(file));
    total_bytes_ =
        std::max<uint64_t>(1, std::accumulate(bytes_.begin(), bytes_.end(), uint64_t(0)));
    waiting_.resize(bytes_.size());
    again_.reserve(bytes_.size());
    std::iota(waiting_.begin(), waiting_.end(), size_t(0));
    // The largest first: at the end nobody waits long for the last.
    std::ranges::stable_sort(waiting_, [&](size_t a, size_t b) { return bytes_[a] > bytes_[b]; });
  }

  size_t most_at_a_time() const { return std::min(most_at_a_time_, bytes_.size()); }

  /// Waits until a file may be drawn; none if all are, or will be by others.
  std::optional<Task> take() {
    std::unique_lock lock(mutex_);
    while (true) {
      if (waiting_.empty() && again_.empty() && running_ == 0) return std::nullopt;
      const uint64_t in_use = std::max(memory_in_use(), expected_);
      const auto fits =
          std::ranges::find_if(waiting_, [&](size_t file) { return may_start(file, in_use); });
      if (fits != waiting_.end()) {
        const size_t file = *fits;
        waiting_.erase(fits);
        return start(file, false);
      }
      if (waiting_.empty() && !again_.empty() && running_ == 0) {
        const size_t file = again_.back();
        again_.pop_back();
        return start(file, true);
      }
      changed_.wait(lock);
    }
  }

  void finish(const Task& task) {
    {
      const std::lock_guard lock(mutex_);
      leave(task);
      --unfinished_;
    }
    changed_.notify_all();
  }

  /// There was no memory for it beside others.
  void put_back(const Task& task) {
    {
      const std::lock_guard lock(mutex_);
      leave(task);
      again_.push_back(task.file);
    }
    changed_.notify_all();
  }

 private:
  uint64_t expected(size_t file) const { return kLeastMemory + kMemoryOfText * bytes_[file]; }

  bool may_start(size_t file, uint64_t in_use) const {
    if (running_ == 0) return true;
    return !is_alone_ && in_use + expected(file) <= memory_limit() / 2;
  }

  Task start(size_t file, bool alone) {
    ++running_;
    is_alone_ = alone;
    expected_ += expected(file);
    const double share = double(bytes_[file]) / double(total_bytes_);
    const size_t among = std::min(unfinished_, most_at_a_time_);
    const double wanted =
        alone ? double(threads_)
              : std::max(std::round(double(threads_) * share), double(threads_ / among));
    return {file, int(std::clamp(wanted, 1.0, double(threads_))), alone};
  }

  void leave(const Task& task) {
    --running_;
    is_alone_ = false;
    expected_ -= expected(task.file);
#ifdef __GLIBC__
    // What is kept for the next picture would count against the next file.
    if (bytes_[task.file] > kLargeText) ::malloc_trim(0);
#endif
  }

  const size_t threads_, most_at_a_time_;
  std::vector<uint64_t> bytes_;  ///< by file
  uint64_t total_bytes_ = 1;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<size_t> waiting_, again_;
  size_t unfinished_;
  size_t running_ = 0;
  bool is_alone_ = false;
  uint64_t expected_ = 0;  ///< of those that run
};

/// What a file had to say, and its exit code.
struct Said {
  std::string lines;
  int code = kExitDone;
};

/// What the files have said, told in their order.
class Told {
 public:
  Told(const std::vector<std::string>& files, bool quiet)
      : files_(files), said_(files.size()), progress_(!quiet, "drawing the files") {}

  void add(size_t file, Said said) {
    const std::lock_guard lock(mutex_);
    said_[file] = std::move(said);
    ++done_;
    if (share_) share_(double(done_) / double(files_.size()));
    if (file == next_) tell();
  }

  /// The exit code, when all are done.
  int end() {
    tell();
    std::vector<size_t> bad;
    int code = kExitDone;
    for (size_t i = 0; i < files_.size(); ++i) {
      if (said_[i]->code != kExitDone) bad.push_back(i);
      code = std::max(code, said_[i]->code);
    }
    if (bad.empty()) return code;
    constexpr size_t kMostNames = 20;
    std::string names;
    for (size_t i = 0; i < std::min(bad.size(), kMostNames); ++i)
      names += (i > 0 ? ", " : "") + files_[bad[i]];
    if (bad.size() > kMostNames) names += fmt::format(", and {} more", bad.size() - kMostNames);
    progress_.without_line([&] {
      say(fmt::format("whittle: {} of {} files have errors: {}", bad.size(), files_.size(), names));
    });
    return code;
  }

 private:
  /// What can be told in order.
  void tell() {
    if (next_ == said_.size() || !said_[next_]) return;
    progress_.without_line([&] {
      for (; next_ < said_.size() && said_[next_]; ++next_) say_all(said_[next_]->lines);
    });
  }

  const std::vector<std::string>& files_;
  std::mutex mutex_;
  std::vector<std::optional<Said>> said_;  ///< by file; none: not yet done
  size_t next_ = 0, done_ = 0;
  ProgressLine progress_;
  Progress share_ = progress_.share();
};

/// Draws a file; nothing if memory ran out and others had some of it.
std::optional<Said> drawn(const std::string& file, bool is_alone,
                          const std::function<int()>& draw) {
  KeptWords kept;
  bool has_memory = true;
  int code = kExitDone;
  try {
    code = draw();
  } catch (const std::bad_alloc&) {
    has_memory = false;
  } catch (const std::length_error&) {
    // What std::vector throws for a size beyond any memory.
    has_memory = false;
  } catch (const std::exception& e) {
    code = report({ErrorKind::kMachine, fmt::format("{}: {}", file, e.what())});
  }
  if (!has_memory) {
    if (!is_alone) return std::nullopt;
    code = report({ErrorKind::kMachine, fmt::format("{}: {}", file, out_of_memory())});
  }
  return Said{kept.take(), code};
}

}  // namespace

int draw_all(const ManyFiles& many, const std::function<int(size_t file, int threads)>& draw) {
  const size_t threads =
      many.threads > 0 ? size_t(many.threads) : std::max(1u, std::thread::hardware_concurrency());
  Schedule schedule(many, threads);
  Told told(many.files, many.quiet);
  // Beside other threads nothing may be thrown here, also where there is no memory for words.
  const auto serve = [&] {
    while (const std::optional<Schedule::Task> task = schedule.take()) {
      std::optional<Said> said = Said{{}, int(ErrorKind::kMachine)};
      try {
        said = drawn(many.files[task->file], task->is_alone,
                     [&] { return draw(task->file, task->threads); });
      } catch (const std::bad_alloc&) {
        // The exit code and the last line tell of it.
      }
      if (said) {
        try {
          told.add(task->file, *std::move(said));
        } catch (const std::bad_alloc&) {
          // Its words come with those of a later file.
        }
        schedule.finish(*task);
      } else {
        schedule.put_back(*task);
      }
    }
  };
  std::vector<std::thread> others;
  others.reserve(schedule.most_at_a_time());
  try {
    while (others.size() + 1 < schedule.most_at_a_time()) others.emplace_back(serve);
  } catch (const std::system_error&) {
    // Fewer do as well.
  } catch (const std::bad_alloc&) {
    // Likewise.
  }
  serve();
  for (std::thread& other : others) other.join();
  return told.end();
}

}  // namespace whittle
