// Statements that are flat shapes, or shapes that stand in files.
#pragma once

#include <string>

#include "csg/statements.h"
#include "model/document.h"
#include "model/warnings.h"

namespace whittle {

// Each for a statement of that kind. Arguments of a wrong type leave the default and give a
// warning. The $fn, $fa and $fs of the results are not yet set.

Square make_square(const Statement& statement, Warnings& warnings);
Circle make_circle(const Statement& statement, Warnings& warnings);

/// Points that are none, and paths that are none, are left out, with a warning.
Polygon make_polygon(const Statement& statement, Warnings& warnings);

/// `is_dumped` says that the arguments stand as OpenSCAD prints them: then the text is not escaped.
Text make_text(const Statement& statement, bool is_dumped, Warnings& warnings);

Import make_import(const Statement& statement, Warnings& warnings);
HeightMap make_height_map(const Statement& statement, Warnings& warnings);

}  // namespace whittle
