// whittle: the program. The first argument names a command; without one, it renders.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "commands.h"
#include "console.h"
#include "host/child_process.h"
#include "host/pending_files.h"
#include "limits.h"
#include "signals.h"

namespace whittle {
namespace {

struct Command {
  const char* name;
  int (*run)(Arguments arguments);
};

constexpr Command kCommands[] = {
    {"info", info_command},   {"cells", cells_command},   {"compare", compare_command},
    {"bench", bench_command}, {"model", model_command},   {"devices", devices_command},
    {"pick", pick_command},   {"cast", cast_command},     {"measure", measure_command},
    {"slice", slice_command}, {"params", params_command}, {"edit", edit_command}};

/// A word that may have been meant for a command: letters only, and no file is called so.
bool looks_like_command(std::string_view word) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return !word.empty() && std::ranges::all_of(word, is_letter) &&
         ::access(std::string(word).c_str(), F_OK) != 0 && errno == ENOENT;
}

int refuse_command(std::string_view word) {
  std::string names;
  for (const Command& command : kCommands) names += fmt::format(", {}", command.name);
  say_lines(
      fmt::format("whittle: there is neither a file nor a command '{}'; commands are: {}\n"
                  "Try 'whittle --help'.",
                  word, names.substr(2)));
  return int(ErrorKind::kUsage);
}

int run(Arguments arguments) {
  if (arguments.empty()) return render_command(arguments);
  for (const Command& command : kCommands) {
    if (std::strcmp(arguments[0], command.name) == 0) return command.run(arguments.subspan(1));
  }
  if (looks_like_command(arguments[0])) return refuse_command(arguments[0]);
  return render_command(arguments);
}

int run_guarded(Arguments arguments) {
  try {
    return run(arguments);
  } catch (const std::bad_alloc&) {
    return report({ErrorKind::kMachine, out_of_memory()});
  } catch (const std::length_error&) {
    // What std::vector throws for a size beyond any memory.
    return report({ErrorKind::kMachine, out_of_memory()});
  } catch (const std::exception& e) {
    return report({ErrorKind::kMachine, e.what()});
  }
}

/// What one picture took is kept for the next: to get memory from the system again, page by page,
/// can take longer than tracing.
void keep_memory() {
#ifdef __GLIBC__
  constexpr int kMostBlock = 1 << 25, kMostKept = 1 << 28;
  ::mallopt(M_MMAP_THRESHOLD, kMostBlock);
  ::mallopt(M_TRIM_THRESHOLD, kMostKept);
#endif
}

/// For what no one can catch: what is thrown through a library that is not written in C++.
[[noreturn]] void end_clearly() {
  // Several threads may get here at once; the first one speaks for all.
  static std::atomic_flag is_ending;
  while (is_ending.test_and_set()) ::pause();
  int code = int(ErrorKind::kMachine);
  try {
    if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const std::exception& e) {
    code = report({ErrorKind::kMachine, e.what()});
  } catch (...) {
  }
  kill_programs();
  remove_pending_files();
  ::_exit(code);
}

}  // namespace
}  // namespace whittle

int main(int argc, char** argv) {
  whittle::prepare_for_interruption();
  std::set_terminate(whittle::end_clearly);
  whittle::keep_memory();
  whittle::limit_memory(whittle::physical_memory());
  const std::vector<const char*> arguments(argv + (argc > 0), argv + argc);
  return whittle::run_guarded(arguments);
}
