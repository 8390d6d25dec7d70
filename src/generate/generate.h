// Models made to measure: the paper's own, and more, as commented `.csg` text that OpenSCAD reads.
//
// The same name, size and seed give the same bytes on every platform.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/result.h"

namespace whittle {

/// A kind of model that can be made.
struct Generator {
  const char* name;
  const char* summary;    ///< one line for people
  int default_n;          ///< 0: the model has no size
  int min_n, max_n;       ///< what N may be; both 0 if the model has no size
  const char* n_meaning;  ///< what N counts, as in "N spheres"; empty if the model has no size
};

/// The seed of the examples, and of models for which none is asked.
inline constexpr uint64_t kDefaultSeed = 1;

/// Every kind of model, the paper's first.
std::span<const Generator> generators();

/// The text of a model; `n` absent means the default size. Cost and length are linear in the
/// number of primitives.
/// Errors (kUsage): an unknown name (the message lists the known ones), a size out of range, a size
/// for a model that has none.
Result<std::string> generate_model(std::string_view name, std::optional<int> n, uint64_t seed);

}  // namespace whittle
