// The window, as the rest of the program sees it.
#pragma once

#include "../commands.h"
#include "../render_arguments.h"

namespace whittle {

/// Shows the files until the window is closed; the exit code. `arguments` are the words that `a`
/// was read from. Errors are those of the command line and of the machine (there is no display);
/// what is wrong with a file is said in the window.
Result<int> show_window(const RenderArguments& a, Arguments arguments);

}  // namespace whittle
