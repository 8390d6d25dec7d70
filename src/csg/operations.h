// Statements that make one shape of what they hold.
#pragma once

#include <optional>

#include "csg/statements.h"
#include "model/document.h"
#include "model/warnings.h"

namespace whittle {

/// For a statement from kLinearExtrude to kRoof. Arguments of a wrong type leave the default and
/// give a warning. The $fn, $fa and $fs of the result are not yet set.
Operation make_operation(const Statement& statement, Warnings& warnings);

/// What an extrusion of old files reads in place of children, if it is one.
std::optional<Import> extruded_file(const Statement& statement, Warnings& warnings);

}  // namespace whittle
