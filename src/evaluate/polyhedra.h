// Primitives with flat faces: how many they have, and which are convex.
#pragma once

#include <cstdint>

#include "evaluate/budget.h"
#include "model/model.h"
#include "model/warnings.h"

namespace whittle {

/// Digits of a number in a text.
inline constexpr int kPrintedDigits = 6;

/// The facets of a facetted sphere or cylinder, of a polyhedron or a mesh.
uint64_t facet_count(const Shape& shape);

/// Fills the planes of the polyhedra in the tree, and makes meshes of those that are not convex, on
/// so many threads (0: all). What stays open is empty, with a warning. Spends their facets; stops
/// where they pass the budget, which `where` then tells.
void build_polyhedra(Model& model, int threads, Budget& budget, Warnings& warnings,
                     SourceLocation& where);

}  // namespace whittle
