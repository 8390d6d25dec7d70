#include "viewer/file_watch.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <thread>
#include <tuple>
#include <utility>

namespace whittle {
namespace {

/// An editor may write a file in several steps.
constexpr int kQuietMilliseconds = 15;

/// What a file is, as far as can be told without reading it; none of it if it is not there.
using Signature = std::tuple<uint64_t, uint64_t, int64_t, int64_t, int64_t>;

Signature signature_of(const std::string& file, int64_t* written = nullptr) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return {};
  constexpr int64_t kNanoseconds = 1'000'000'000;
  if (written != nullptr)
    *written = int64_t(status.st_mtim.tv_sec) * kNanoseconds + status.st_mtim.tv_nsec;
  return {status.st_dev, status.st_ino, status.st_size, status.st_mtim.tv_sec,
          status.st_mtim.tv_nsec};
}

}  // namespace

struct FileWatch::State {
  std::function<void()> changed;
  int notes = -1, wake = -1;
  std::mutex mutex;
  std::map<int, std::set<std::string>> names;  ///< in each folder that is watched
  std::map<std::string, Signature> files;
  bool is_late = false;  ///< one was written before it was watched
  std::jthread thread;

  void watch_name(const std::filesystem::path& file);
  void replace(const std::vector<std::string>& list, Time since);
  /// Reads what the system tells; whether it is about one of the files.
  bool read_notes();
  bool has_changed();
  void run(const std::stop_token& quit);
  void wake_up() const {
    const uint64_t one = 1;
    (void)!::write(wake, &one, sizeof one);
  }
};

void FileWatch::State::watch_name(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  const int watched = ::inotify_add_watch(notes, folder.c_str(), IN_CLOSE_WRITE | IN_MOVED_TO);
  if (watched >= 0) names[watched].insert(file.filename().string());
}

void FileWatch::State::replace(const std::vector<std::string>& list, Time since) {
  const std::lock_guard lock(mutex);
  for (const auto& [watched, unused] : names) ::inotify_rm_watch(notes, watched);
  names.clear();
  const std::map<std::string, Signature> before = std::exchange(files, {});
  const int64_t from =
      std::chrono::duration_cast<std::chrono::nanoseconds>(since.time_since_epoch()).count();
  for (const std::string& file : list) {
    watch_name(file);
    // What a link points at is saved elsewhere.
    std::error_code failed;
    const std::filesystem::path target = std::filesystem::canonical(file, failed);
    if (!failed) watch_name(target);
    int64_t written = 0;
    const Signature now = files[file] = signature_of(file, &written);
    // A clock elsewhere may be ahead of this one; what is as it was is not late.
    const auto known = before.find(file);
    is_late = is_late || (written > from && (known == before.end() || known->second != now));
  }
}

bool FileWatch::State::read_notes() {
  alignas(inotify_event) std::array<char, 4096> buffer;
  bool is_one_of_them = false;
  for (ssize_t size = 0; (size = ::read(notes, buffer.data(), buffer.size())) > 0;) {
    const std::lock_guard lock(mutex);
    for (const char* at = buffer.data(); at < buffer.data() + size;) {
      const auto* const event = reinterpret_cast<const inotify_event*>(at);
      at += sizeof(inotify_event) + event->len;
      const auto folder = names.find(event->wd);
      is_one_of_them =
          is_one_of_them || (event->mask & IN_Q_OVERFLOW) != 0 ||
          (event->len > 0 && folder != names.end() && folder->second.contains(event->name));
    }
  }
  return is_one_of_them;
}

bool FileWatch::State::has_changed() {
  const std::lock_guard lock(mutex);
  bool any = std::exchange(is_late, false);
  for (auto& [file, known] : files) {
    const Signature now = signature_of(file);
    // One that is not there is being replaced.
    if (now == known || now == Signature{}) continue;
    known = now;
    any = true;
  }
  return any;
}

void FileWatch::State::run(const std::stop_token& quit) {
  bool is_waiting_for_quiet = false;
  while (!quit.stop_requested()) {
    std::array<pollfd, 2> ends{{{notes, POLLIN, 0}, {wake, POLLIN, 0}}};
    const int ready =
        ::poll(ends.data(), ends.size(), is_waiting_for_quiet ? kQuietMilliseconds : -1);
    if (ready < 0 && errno != EINTR) return;
    if ((ends[1].revents & POLLIN) != 0) {
      uint64_t count = 0;
      (void)!::read(wake, &count, sizeof count);
    }
    const bool told = read_notes();
    {
      const std::lock_guard lock(mutex);
      is_waiting_for_quiet = is_waiting_for_quiet || told || is_late;
    }
    if (!is_waiting_for_quiet || ready > 0) continue;
    is_waiting_for_quiet = false;
    if (has_changed()) changed();
  }
}

FileWatch::FileWatch(std::function<void()> changed) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.changed = std::move(changed);
  s.notes = ::inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
  s.wake = ::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  // Where the system has no more of them nothing is watched.
  if (s.notes >= 0 && s.wake >= 0)
    s.thread = std::jthread([&s](const std::stop_token& quit) { s.run(quit); });
}

FileWatch::~FileWatch() {
  State& s = *state_;
  s.thread.request_stop();
  if (s.thread.joinable()) {
    s.wake_up();
    s.thread.join();
  }
  if (s.notes >= 0) ::close(s.notes);
  if (s.wake >= 0) ::close(s.wake);
}

void FileWatch::watch(const std::vector<std::string>& files, Time since) {
  if (!state_->thread.joinable()) return;
  state_->replace(files, since);
  state_->wake_up();
}

}  // namespace whittle
