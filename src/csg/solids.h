// Statements that are solids: from arguments to shapes.
#pragma once

#include <string>

#include "csg/statements.h"
#include "model/model.h"
#include "model/warnings.h"

namespace whittle {

// Each for a statement of that kind. Arguments of a wrong type leave the default and
// give a warning. Facets are not yet chosen.

Cube make_cube(const Statement& statement, Warnings& warnings);
Sphere make_sphere(const Statement& statement, Warnings& warnings);
Cylinder make_cylinder(const Statement& statement, Warnings& warnings);
Halfspace make_halfspace(const Statement& statement, Warnings& warnings);

/// Points and faces, without planes. Faces of fewer than three corners are left out. A point or a
/// face that is none sets `mistake`, in words, and the result is then of no use.
Polyhedron make_polyhedron(const Statement& statement, std::string& mistake);

}  // namespace whittle
