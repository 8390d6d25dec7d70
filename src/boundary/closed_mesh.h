// The solid of a model as one closed mesh: what hulls, sums and projections of what is cut need.
#pragma once

#include "base/result.h"
#include "base/workers.h"
#include "boundary/evaluate_solid.h"
#include "model/model.h"
#include "shape/triangle_mesh.h"

namespace whittle {

/// The boundary of a model's solid (evaluate_solid.h); without triangles if it is empty. Facets are
/// the solid's faces. Errors say in words, without a place, why there is none.
Result<TriangleMesh> closed_mesh(const Model& model, const Workers& workers,
                                 const BoundarySettings& settings = {},
                                 BoundaryStats* stats = nullptr);

}  // namespace whittle
