// Tells when files are saved: written in place, or renamed over, as editors do it.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace whittle {

/// Costs nothing while nothing is saved (Linux: inotify). What is on a network may be saved
/// elsewhere without notice.
class FileWatch {
 public:
  using Time = std::chrono::system_clock::time_point;

  /// `changed` is called from a thread of its own.
  explicit FileWatch(std::function<void()> changed);
  ~FileWatch();
  FileWatch(const FileWatch&) = delete;
  FileWatch& operator=(const FileWatch&) = delete;

  /// Watches these from now on, and no others. If one of them was written after `since`, that is
  /// told too. Files need not be there yet, but their folders.
  void watch(const std::vector<std::string>& files, Time since);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace whittle
