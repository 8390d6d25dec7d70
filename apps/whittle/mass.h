// whittle info --mass: volume, surface, centre and inertia, as text and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "base/result.h"
#include "command_line.h"
#include "measure/measure.h"

namespace whittle {

struct MassArguments {
  bool is_wanted = false;
  std::optional<double> density;  ///< g/cm3, a unit of length being a millimetre
  double within = 1e-6;
  int threads = 0;
};
void add_mass_options(CLI::App& app, MassArguments& mass, Loading& loading);

/// Shows the progress. Errors name the file.
Result<Measures> measure_solid(const Model& model, const MassArguments& arguments, bool quiet);

/// Lines of a name and a value, as those of `whittle info`.
std::string describe_mass(const Measures& measures, const MassArguments& arguments);
nlohmann::ordered_json mass_json(const Measures& measures, const MassArguments& arguments);

}  // namespace whittle
