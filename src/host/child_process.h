// Another program, run to its end, that does not outlive this one.
//
// Like pending_files.h state that the program shares with itself, for a signal handler.
#pragma once

#include <optional>
#include <stop_token>
#include <string>

namespace whittle {

/// What a program is given besides its arguments.
struct ProgramSurroundings {
  std::string messages;             ///< the file that its output and errors go to
  std::string input = "/dev/null";  ///< the file that it reads as standard input
  std::string folder{};             ///< where it runs; empty: here
  int input_descriptor = -1;        ///< not negative: an open file that stands for `input`
  std::stop_token stop{};           ///< kills it, with what it has started
};

/// Runs a program without a shell. `arguments` end with a null. The status as of waitpid, or the
/// error number in `error`. It is a process group of its own, so what it starts can be ended with
/// it; where this process is killed outright the system kills the program (Linux). May be used from
/// several threads.
std::optional<int> run_program(const std::string& program, const char* const* arguments,
                               const ProgramSurroundings& surroundings, int& error);

/// Kills every program that runs, with what it has started, and waits for its end: from there on it
/// writes nothing. run_program then never returns. Async-signal-safe: for a handler that then ends
/// this program.
void kill_programs() noexcept;

}  // namespace whittle
