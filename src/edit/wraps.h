// Colours and maps of statements: those around them are changed, or new ones put there.
#pragma once

#include <cstdint>

#include "base/affine.h"
#include "base/result.h"
#include "edit/source_document.h"

namespace whittle {

/// Red, green, blue and alpha, 0 to 1.
struct PaintColor {
  double r = 0, g = 0, b = 0, a = 1;
};

// What the functions return, and their errors, are as in parameters.h.

/// Paints a node: a `color` gets another value, and so does one that holds nothing but the node;
/// else the node is put into a `color`, which is what is returned. Its marks stand before that.
Result<uint32_t> set_color(SourceDocument& document, uint32_t node, const PaintColor& color,
                           SourceDocument::Step step = SourceDocument::Step::kOwn);

/// Moves a node by a map of the space that it stands in: a `multmatrix` gets another matrix, a
/// `translate` that is only moved another vector; else a `multmatrix` that holds nothing but the
/// node, or a new one around it, which is what is returned.
Result<uint32_t> transform_node(SourceDocument& document, uint32_t node, const Affine& by,
                                SourceDocument::Step step = SourceDocument::Step::kOwn);

}  // namespace whittle
