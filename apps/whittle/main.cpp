// whittle: the program. The first argument names a command; without one, it renders.
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <vector>

#include "commands.h"
#include "console.h"
#include "signals.h"

namespace whittle {
namespace {

struct Command {
  const char* name;
  int (*run)(Arguments arguments);
};

constexpr Command kCommands[] = {{"info", info_command},
                                 {"compare", compare_command},
                                 {"bench", bench_command},
                                 {"model", model_command}};

int run(Arguments arguments) {
  for (const Command& command : kCommands) {
    if (!arguments.empty() && std::strcmp(arguments[0], command.name) == 0) {
      return command.run(arguments.subspan(1));
    }
  }
  return render_command(arguments);
}

int run_guarded(Arguments arguments) {
  try {
    return run(arguments);
  } catch (const std::bad_alloc&) {
    return report({ErrorKind::kMachine, "out of memory"});
  } catch (const std::length_error&) {
    // What std::vector throws for a size beyond any memory.
    return report({ErrorKind::kMachine, "out of memory"});
  } catch (const std::exception& e) {
    return report({ErrorKind::kMachine, e.what()});
  }
}

}  // namespace
}  // namespace whittle

int main(int argc, char** argv) {
  whittle::prepare_for_interruption();
  const std::vector<const char*> arguments(argv + (argc > 0), argv + argc);
  return whittle::run_guarded(arguments);
}
