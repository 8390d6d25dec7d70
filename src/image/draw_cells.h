// The cells that space was cut into, drawn over the picture of the model: Figures 3 and 4 of the
// paper (Romeiro, Velho, de Figueiredo 2008).
//
// Only cells are drawn that rays would have to solve, and those that were ignored; what is empty or
// full has no surface in it.
#pragma once

#include "image/picture.h"
#include "subdivide/cells.h"
#include "trace/camera.h"
#include "trace/frame.h"

namespace whittle {

enum class CellView {
  kEdges,  ///< the edges of the boxes; what stands in front of an edge hides it
  kFaces,  ///< the front faces of the nearest boxes, translucent, and their edges
};

/// Blue conjunctions, green disjunctions, orange tables, violet programs, red ignored cells.
/// Precondition: one of those kinds.
Rgb8 cell_color(CellKind kind);

/// Draws over the picture. `frame` holds what the camera sees, `origin` is the scene's. Lines are
/// antialiased; those of boxes that are only a few pixels large are fainter, so that many of them
/// do not cover the model. Precondition: picture and frame have the camera's size.
void draw_cells(const CellTree& cells, Vec3 origin, const Camera& camera, const Frame& frame,
                CellView view, Picture& picture);

}  // namespace whittle
