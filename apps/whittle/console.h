// What the program says on standard error and standard output.
#pragma once

#include <string_view>

#include "base/result.h"

namespace whittle {

inline constexpr int kExitDone = 0;

/// One line to standard error, whatever is in it (printable.h).
void say(std::string_view line);

/// Several lines of our own, the last one's end left out.
void say_lines(std::string_view lines);

/// Says the error in one line, and returns the exit code for it.
int report(const Error& error);

/// Prints to standard output; the exit code, which is not 0 if nobody can read it.
int print(std::string_view text);

}  // namespace whittle
