// Models of boxes whose corners lie on a grid, answered cell by cell: every cell is inside or
// outside of each box, no number is rounded and no tolerance is needed, so it says what is right
// where faces coincide. Walls between cells that differ are the surface; their owner is found by
// the rule as docs/conventions.md words it.
#pragma once

#include <memory>
#include <string>

#include "coincident/scenes.h"

namespace whittle {

/// What a ray sees of the model `text`: cubes, and half-spaces square to an axis, whose sides lie
/// on multiples of `cell`. The solid must be bounded.
RayFormula grid_formula(const std::string& text, double cell = 1);

}  // namespace whittle
