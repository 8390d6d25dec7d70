// The table that --stats prints.
#pragma once

#include <string>

#include "model/model.h"
#include "whittle/renderer.h"

namespace whittle {

/// Milliseconds of what is not a stage of the renderer, and of all together.
struct RunTimes {
  double read = 0, write = 0, total = 0;
};

/// What was done and what it cost, as lines for people. `is_auto`: nobody asked for the backend.
std::string statistics(const Model& model, const Renderer& renderer, bool is_auto,
                       const RunTimes& times);

/// The largest memory of this process so far, in bytes.
size_t peak_memory_bytes();

/// Bytes in a unit that people read, as in "1.5 MiB".
std::string describe_bytes(size_t bytes);

}  // namespace whittle
