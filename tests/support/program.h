// Runs the program in a folder of its own and looks at what it left.
#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/folder_for_test.h"

namespace whittle {

/// How a run ended, and what it said.
struct Ended {
  int exit_code = -1;  ///< -1: ended by a signal
  int signal = 0;      ///< that ended it; SIGALRM: it had hung
  uint64_t peak_memory_bytes = 0;
  std::string out, err;
};

/// Where standard output goes.
enum class StandardOutput { kCaptured, kDevFull, kClosedPipe, kClosed };

struct RunSettings {
  std::string in{};  ///< standard input
  StandardOutput out = StandardOutput::kCaptured;
  std::optional<uint64_t> memory_limit{};  ///< bytes of address space
  std::optional<uint64_t> file_limit{};    ///< bytes of any file
  bool obeys_permissions = false;          ///< even where root runs the tests
};

class ProgramTest : public testing::Test {
 protected:
  /// Runs to the end, in the folder of the test.
  Ended run(const std::vector<std::string>& arguments, const RunSettings& settings = {}) const;
  /// Starts a run, ends it by a signal after that time, and waits. Says nothing of what it printed.
  Ended run_and_signal(const std::vector<std::string>& arguments, int signal,
                       int after_microseconds) const;

  /// The same, by a signal as soon as `wait` returns.
  Ended run_and_signal(const std::vector<std::string>& arguments, int signal,
                       const std::function<void()>& wait) const;

  std::string path(const std::string& name) const { return folder_ / name; }
  void write(const std::string& name, const std::string& text) const;
  /// The whole of a file; a failure if it is not there.
  std::string read(const std::string& name) const;
  /// The names in the folder, sorted, hidden ones too.
  std::vector<std::string> files() const;

 private:
  pid_t start(const std::vector<std::string>& arguments, const RunSettings& settings, int in,
              int out, int err) const;

  const TestFolder folder_;
};

}  // namespace whittle
