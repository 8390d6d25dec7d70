#include "console.h"

#include <cstdio>
#include <string>
#include <utility>

#include "base/printable.h"
#include "whittle/output.h"

namespace whittle {
namespace {

/// Where what the thread says is kept, if it is.
thread_local std::string* kept_words = nullptr;

}  // namespace

KeptWords::KeptWords() {
  kept_words = &words_;
}

KeptWords::~KeptWords() {
  kept_words = nullptr;
}

std::string KeptWords::take() {
  return std::exchange(words_, {});
}

bool keeps_words() {
  return kept_words != nullptr;
}

void say(std::string_view line) {
  say_lines(printable(line));
}

void say_lines(std::string_view lines) {
  say_all(std::string(lines) + "\n");
}

void say_all(std::string_view lines) {
  if (kept_words != nullptr) {
    *kept_words += lines;
    return;
  }
  // One call, so that lines of several threads or programs do not mix.
  std::fwrite(lines.data(), 1, lines.size(), stderr);
}

int report(const Error& error) {
  // What is wrong with an input begins with the input's name, as a compiler's messages do.
  say(error.kind == ErrorKind::kInput ? error.message : "whittle: " + error.message);
  return static_cast<int>(error.kind);
}

int print(std::string_view text) {
  const Status written = write_standard_output(text);
  return written ? kExitDone : report(written.error());
}

}  // namespace whittle
