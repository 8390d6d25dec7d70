#include "trace/vulkan/leaf_case.h"

#include <cmath>

namespace whittle {
namespace {

/// Curved surfaces whose radius is below this share of the region's longest edge get the arithmetic
/// for small ones, as in docs/numerics.md.
constexpr double kSmall = 1.0 / 64;

FormulaCase conjunction_case(const Leaf& leaf) {
  const std::span<const LeafLiteral> literals = leaf.literals();
  if (literals.size() == 1) return FormulaCase::kLiteral;
  if (literals.size() > 2) return FormulaCase::kConjunction;
  const bool first = (literals[0].literal & 1) != 0, second = (literals[1].literal & 1) != 0;
  return first    ? second ? FormulaCase::kOutside : FormulaCase::kBackDifference
         : second ? FormulaCase::kDifference
                  : FormulaCase::kIntersection;
}

FormulaCase case_of(CellKind kind, const Leaf& leaf) {
  switch (kind) {
    case CellKind::kConjunction:
      return conjunction_case(leaf);
    case CellKind::kDisjunction:
      return leaf.literal_count == 1 ? FormulaCase::kLiteral : FormulaCase::kDisjunction;
    case CellKind::kTable:
      return FormulaCase::kTable;
    default:
      return FormulaCase::kProgram;
  }
}

SurfaceCase surfaces_of(const Scene& scene, const Leaf& leaf) {
  SurfaceCase all = SurfaceCase::kPlanes;
  for (const LeafLiteral& literal : leaf.literals()) {
    switch (shader_surface(scene, scene.half_spaces[literal.literal >> 1])) {
      case ShaderSurface::kPlane:
        break;
      case ShaderSurface::kSphere:
        all = SurfaceCase::kPlanesAndSpheres;
        break;
      default:
        return SurfaceCase::kAny;
    }
  }
  return all;
}

}  // namespace

ShaderSurface shader_surface(const Scene& scene, const HalfSpace& h) {
  if (h.is_plane()) return ShaderSurface::kPlane;
  // As f is scaled, 2 |c| is the radius, or the least one.
  const bool is_small = 2 * std::fabs(h.f.c) < kSmall * max_component(scene.region.size());
  if (h.has_tip()) return is_small ? ShaderSurface::kSmallCone : ShaderSurface::kCone;
  if (is_small) return ShaderSurface::kSmallQuadric;
  return h.kind == SurfaceKind::kSphere ? ShaderSurface::kSphere : ShaderSurface::kQuadric;
}

LeafCase leaf_case(const Scene& scene, CellKind kind, const Leaf& leaf) {
  return LeafCase(uint32_t(case_of(kind, leaf)) * kSurfaceCases +
                  uint32_t(surfaces_of(scene, leaf)));
}

}  // namespace whittle
