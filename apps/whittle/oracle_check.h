// Is a tracer right? A look at a coarse grid of places, before anything is measured.
#pragma once

#include <string>

#include "trace/tracer.h"

namespace whittle {

/// What a look at kCheckedSide x kCheckedSide places of the picture says.
struct OracleCheck {
  size_t certain = 0;    ///< places that count
  size_t ambiguous = 0;  ///< left out: 0.001 pixels away the oracle sees something else
  size_t wrong = 0;      ///< of the certain ones
  std::string first;     ///< the first wrong place, and what is seen there; empty if none is wrong
};
inline constexpr int kCheckedSide = 48;

/// Compares hit, id, distance and normal, by the measures of image/compare.h. Only where the two
/// differ does it ask whether the place is ambiguous, so the oracle costs little more than a ray a
/// place; places where they agree all count as certain.
OracleCheck check_against_oracle(Tracer& tracer, Tracer& oracle, const Camera& camera);

}  // namespace whittle
