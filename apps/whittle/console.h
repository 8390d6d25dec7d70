// What the program says on standard error and standard output.
#pragma once

#include <string>
#include <string_view>

#include "base/result.h"

namespace whittle {

inline constexpr int kExitDone = 0;

/// One line to standard error, whatever is in it (printable.h).
void say(std::string_view line);

/// Several lines of our own, the last one's end left out.
void say_lines(std::string_view lines);

/// What say_lines() would say, each line with its end; nothing for nothing.
void say_all(std::string_view lines);

/// While it lives, what this thread says is kept, for whoever wants to say it later. Not more than
/// one at a time in a thread.
class KeptWords {
 public:
  KeptWords();
  ~KeptWords();
  KeptWords(const KeptWords&) = delete;
  KeptWords& operator=(const KeptWords&) = delete;

  /// All that was said so far, every line with its end.
  std::string take();

 private:
  std::string words_;
};

/// Whether what this thread says is kept.
bool keeps_words();

/// Says the error in one line, and returns the exit code for it.
int report(const Error& error);

/// Prints to standard output; the exit code, which is not 0 if nobody can read it.
int print(std::string_view text);

}  // namespace whittle
