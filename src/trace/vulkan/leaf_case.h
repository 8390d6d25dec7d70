// The cases of leaves that have shaders of their own, as in section 3.3 of the paper (Romeiro,
// Velho, de Figueiredo 2008), which has one for each case of the intersection of two primitives.
#pragma once

#include <cstdint>

#include "subdivide/cells.h"
#include "trace/vulkan/shader_constants.h"

namespace whittle {

/// What a shader knows of a leaf.
using shader::FormulaCase;
using shader::SurfaceCase;

/// Both in one number, which also orders the draws. 0: a shader that takes every leaf.
using LeafCase = uint8_t;
inline constexpr uint32_t kSurfaceCases = 3;
inline constexpr uint32_t kLeafCases = 10 * kSurfaceCases;
inline constexpr LeafCase kAnyLeaf = 0;

LeafCase leaf_case(const Scene& scene, CellKind kind, const Leaf& leaf);
constexpr FormulaCase formula_case(LeafCase leaf) {
  return FormulaCase(leaf / kSurfaceCases);
}
constexpr SurfaceCase surface_case(LeafCase leaf) {
  return SurfaceCase(leaf % kSurfaceCases);
}

}  // namespace whittle
