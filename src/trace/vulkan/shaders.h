// The shaders, as they were compiled when the program was built.
#pragma once

#include <cstdint>
#include <span>

namespace whittle {

/// SPIR-V, one set for each way to compute and to read.
struct ShaderSet {
  std::span<const uint32_t> cells;    ///< vertices
  std::span<const uint32_t> visible;  ///< fragments
  // Compute:
  std::span<const uint32_t> resolve, pyramid, hidden;
};
ShaderSet shaders(bool doubles, bool storage);

}  // namespace whittle
