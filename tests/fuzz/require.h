// What a target does when something does not hold.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

namespace whittle {

/// Stops the program, with `what` as its last words, unless `holds`.
inline void require(bool holds, const std::string& what) {
  if (holds) return;
  std::fprintf(stderr, "fuzzing found: %s\n", what.c_str());
  std::abort();
}

}  // namespace whittle
