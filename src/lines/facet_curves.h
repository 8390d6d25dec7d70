// True curves become facets that are finer than what a drawing shows.
#pragma once

#include "base/result.h"
#include "lines/projection.h"
#include "model/model.h"

namespace whittle {

/// The same model, whose spheres, cylinders and cones have facets instead of true curves. Their
/// corners lie on the curve, and facets are nowhere farther from it than fineness(), but for some
/// that fill the whole picture. Curves of one body have equally many, so that its parts fit
/// together, and so have equal ones wherever they are. Facets that are there already stay. A
/// kMachine error for more than `most_facets`.
Result<Model> facet_curves(const Model& model, const ViewProjection& projection,
                           size_t most_facets);

/// A round shape's radius where it stands, about; 0 of what has none.
double curve_radius(const Shape& shape, const Affine& world_from_object);

}  // namespace whittle
