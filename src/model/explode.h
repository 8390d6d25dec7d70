// Exploded views: the parts of a model, moved apart.
#pragma once

#include "base/result.h"
#include "model/model.h"

namespace whittle {

/// The model with its parts moved: each by `factor` times the way from the middle of the box around
/// all of them to the middle of its own (the boxes of the tree, model/tree_boxes.h). Parts are the
/// operands of the topmost union that has several with a primitive in them; transforms, colours and
/// unions of one are passed through. Nothing else is changed, ids neither. A kInput error if there
/// is but one part, as below a difference, or one without end. Precondition: the factor is finite.
/// Iterative; linear in the model.
Result<Model> explode(const Model& model, double factor);

}  // namespace whittle
