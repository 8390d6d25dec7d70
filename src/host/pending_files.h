// Files that must not outlive an interrupted run: a list that a signal handler can act on.
//
// State that the program shares with itself, as child_process.h is: a signal handler can be given
// nothing else.
#pragma once

#include <string>

namespace whittle {

/// While it lives, `remove_pending_files` removes `path` (a file, or a directory that is empty by
/// then). Objects are counted: beyond kMost at a time the others are not remembered.
/// May be used from several threads.
class PendingFile {
 public:
  static constexpr int kMost = 64;

  explicit PendingFile(const std::string& path);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

 private:
  int slot_ = -1;
};

/// Removes what is pending, the latest first. Async-signal-safe: for a handler that then ends the
/// program.
void remove_pending_files() noexcept;

}  // namespace whittle
