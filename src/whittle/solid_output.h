// From a model to what files of its shape hold.
#pragma once

#include "base/result.h"
#include "boundary/evaluate_solid.h"
#include "model/model.h"
#include "shape/fragments.h"

namespace whittle {

/// The curves of files of the shape, where these were chosen: OpenSCAD's facets, unless true curves
/// were asked for, which no such file can hold.
constexpr Curves curves_of_shape(Curves chosen) {
  return chosen == Curves::kSmooth ? chosen : Curves::kOpenscad2021;
}

/// Whether anything in the solid is a true curve.
bool has_true_curves(const Model& model);

/// The boundary of a model's solid, with its colours, which are its paints. A kInput error, with
/// the file's name, if there is none: the model is flat, empty, without end, or has true curves.
Result<SolidMesh> solid_of(const Model& model, const Workers& workers,
                           BoundaryStats* stats = nullptr, BoundarySettings settings = {});

/// The same; without triangles if the solid is empty.
Result<SolidMesh> solid_or_nothing_of(const Model& model, const Workers& workers,
                                      BoundaryStats* stats = nullptr,
                                      BoundarySettings settings = {});

/// The loops around a model that is flat; it was read with Drawing's outlines. A kInput error, with
/// the file's name, if it is not, or is empty.
Result<std::vector<std::vector<Vec2>>> drawing_of(const Model& model);

}  // namespace whittle
