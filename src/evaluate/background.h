// What `%` marks, as a document of its own: it is no part of the solid, but pictures may show it.
#pragma once

#include "model/document.h"

namespace whittle {

/// The marked statements where they stand, side by side, under the colour that they have there,
/// without their marks. What is marked within one of them is another one. Marks within an operation
/// (a hull, an extrusion) mark nothing that could be shown. Empty but for nodes[0] if there is
/// none.
Document background_of(const Document& document);

}  // namespace whittle
