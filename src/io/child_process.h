// Another program, run to its end, that does not outlive this one.
//
// Like pending_files.h state that the program shares with itself, for a signal handler.
#pragma once

#include <optional>
#include <string>

namespace whittle {

/// Runs a program without a shell; its input is empty, its output and errors go to the file
/// `messages`. `arguments` end with a null. The status as of waitpid, or the error number in
/// `error`. It is a process group of its own, so what it starts can be ended with it; where this
/// process is killed outright the system kills the program (Linux). May be used from several
/// threads.
std::optional<int> run_program(const std::string& program, const char* const* arguments,
                               const std::string& messages, int& error);

/// Kills every program that runs, with what it has started, and waits for its end: from there on it
/// writes nothing. run_program then never returns. Async-signal-safe: for a handler that then ends
/// this program.
void kill_programs() noexcept;

}  // namespace whittle
