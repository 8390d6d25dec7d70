// What is checked of flat-faced shapes once a whole file is read.
#pragma once

#include <cstddef>
#include <optional>

#include "io/csg_lexer.h"
#include "model/model.h"

namespace whittle {

/// A mistake at the first shape with which the model has more than `limit` facets: faces of
/// facetted spheres and cylinders and of polyhedra.
std::optional<Mistake> check_facets(const Model& model, size_t limit);

/// Fills the planes of all polyhedra in the tree; a mistake at the first that is no convex solid.
std::optional<Mistake> build_polyhedra(Model& model);

}  // namespace whittle
