// What is checked of flat-faced shapes once a whole file is read.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "io/csg_lexer.h"
#include "model/model.h"

namespace whittle {

/// A mistake at the first shape with which the model has more than `limit` facets: faces of
/// facetted spheres and cylinders and of polyhedra.
std::optional<Mistake> check_facets(const Model& model, size_t limit);

/// What was found out about a polyhedron of the tree.
struct PolyhedronNote {
  SourceLocation where;
  bool left_out = false;  ///< it is no convex solid, and empty now; else it is read as `what` says
  std::string what;
};

/// Fills the planes of all polyhedra in the tree. The notes are in the order of the file.
std::vector<PolyhedronNote> build_polyhedra(Model& model);

}  // namespace whittle
