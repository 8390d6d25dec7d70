// Gives the faces of a scene their half-spaces: one that lies on an earlier one gets the earlier
// one's, the others keep what they were written as.
#pragma once

#include "base/workers.h"
#include "lower/scene.h"
#include "lower/unit_maker.h"
#include "model/model.h"

namespace whittle {

/// The scene is as the maker left it. Its half-spaces are numbered in the order of the faces, those
/// that no face has any more are gone, and what merging may have moved is grown. Faces that stand
/// alone, nearly all of most models, are done on all threads; the rest one after another, as each
/// depends on those before it.
void merge_faces(const Model& model, UnitMaker& made, double least_tolerance,
                 const Workers* workers, Scene& scene);

}  // namespace whittle
