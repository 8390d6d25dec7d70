// The commands, one file each. Each takes the command line after its name and returns the program's
// exit code: 0 done, 1 bad input, 2 bad usage, 3 refused by the machine.
#pragma once

#include <span>

namespace whittle {

using Arguments = std::span<const char* const>;

int render_command(Arguments arguments);
int info_command(Arguments arguments);
int cells_command(Arguments arguments);
int compare_command(Arguments arguments);
int bench_command(Arguments arguments);
int model_command(Arguments arguments);
int devices_command(Arguments arguments);
int pick_command(Arguments arguments);
int cast_command(Arguments arguments);
int measure_command(Arguments arguments);
int slice_command(Arguments arguments);
int params_command(Arguments arguments);
int edit_command(Arguments arguments);

}  // namespace whittle
