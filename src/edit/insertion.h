// Where a statement can be added to a text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "edit/source_document.h"

namespace whittle {

/// What must be written so that a statement can stand there: splices in order, and where among
/// their text the statement itself goes.
struct Insertion {
  std::vector<Splice> splices;
  size_t main = 0;  ///< the splice that takes it
  size_t skip = 0;  ///< bytes of that splice's text before it
};

/// Right before a node, among its siblings. A node that is the only child of its parent, without
/// braces, gets some.
Insertion insertion_before(const SourceDocument& document, uint32_t node);
/// Right behind it.
Insertion insertion_behind(const SourceDocument& document, uint32_t node);
/// Into a node that has no children, or none but one in braces, which goes.
Insertion insertion_into(const SourceDocument& document, uint32_t parent);

}  // namespace whittle
