// The cases of leaves that have shaders of their own, as in section 3.3 of the paper (Romeiro,
// Velho, de Figueiredo 2008), which has one for each case of the intersection of two primitives.
#pragma once

#include <cstdint>

#include "subdivide/cells.h"

namespace whittle {

/// How a half-space is solved; shaders/scene.glsl has the same numbers.
enum class ShaderSurface : uint32_t { kPlane, kSphere, kQuadric, kSmallQuadric, kCone, kSmallCone };
ShaderSurface shader_surface(const Scene& scene, const HalfSpace& half_space);

/// What a shader knows of the leaf's formula; shaders/cases.glsl has the same numbers. One literal
/// needs no case for its complement: the surface is seen from either side.
enum class FormulaCase : uint32_t {
  kAny,
  kLiteral,
  kIntersection,    ///< of two half-spaces A and B; along a ray a segment and a segment
  kDifference,      ///< A without B: a segment and two semi-intervals
  kBackDifference,  ///< B without A: two semi-intervals and a segment
  kOutside,         ///< outside of both: two semi-intervals and two semi-intervals
  kConjunction,     ///< of more
  kDisjunction,
  kTable,
  kProgram,
};
/// And of its surfaces.
enum class SurfaceCase : uint32_t { kAny, kPlanes, kPlanesAndSpheres };

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
