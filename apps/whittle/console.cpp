#include "console.h"

#include <cstdio>
#include <string>

#include "base/printable.h"
#include "whittle/output.h"

namespace whittle {

void say(std::string_view line) {
  say_lines(printable(line));
}

void say_lines(std::string_view lines) {
  // One call, so that lines of several threads or programs do not mix.
  const std::string whole = std::string(lines) + "\n";
  std::fwrite(whole.data(), 1, whole.size(), stderr);
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
