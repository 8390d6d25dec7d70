// A model turned in space as a file would say it: by matrices of six digits.
#pragma once

#include "model/model.h"

namespace whittle {

/// Puts the model's middle at the origin and turns it by odd angles about all axes; perhaps mirrors
/// it before.
Affine turn_of(const Model& model, bool mirrored);

/// The model moved by `turn`, which must keep lengths. Every primitive gets transforms of its own
/// with numbers of six digits, as OpenSCAD prints them, by two routes in turn: the product of all
/// that moves it, or the turn around what moved it before. Faces that coincided are then equal only
/// as far as six digits go.
Model turned(const Model& model, const Affine& turn);

}  // namespace whittle
