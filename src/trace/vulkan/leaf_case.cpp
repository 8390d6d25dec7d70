#include "trace/vulkan/leaf_case.h"

namespace whittle {
namespace {

FormulaCase conjunction_case(const Leaf& leaf) {
  const std::span<const LeafLiteral> literals = leaf.literals();
  if (literals.size() == 1) return FormulaCase::kOneLiteral;
  if (literals.size() > 2) return FormulaCase::kConjunctions;
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
      return leaf.literal_count == 1 ? FormulaCase::kOneLiteral : FormulaCase::kDisjunctions;
    case CellKind::kTable:
      return FormulaCase::kTables;
    default:
      return FormulaCase::kPrograms;
  }
}

SurfaceCase surfaces_of(const Scene& scene, const Leaf& leaf) {
  SurfaceCase all = SurfaceCase::kPlanes;
  for (const LeafLiteral& literal : leaf.literals()) {
    switch (scene.half_spaces[literal.literal >> 1].kind) {
      case SurfaceKind::kPlane:
        break;
      case SurfaceKind::kSphere:
        all = SurfaceCase::kPlanesAndSpheres;
        break;
      default:
        return SurfaceCase::kAnySurfaces;
    }
  }
  return all;
}

}  // namespace

LeafCase leaf_case(const Scene& scene, CellKind kind, const Leaf& leaf) {
  return LeafCase(uint32_t(case_of(kind, leaf)) * kSurfaceCases +
                  uint32_t(surfaces_of(scene, leaf)));
}

}  // namespace whittle
