// The marks before a statement that hide it, show it alone, and the like.
#pragma once

#include <cstdint>

#include "base/result.h"
#include "edit/source_document.h"

namespace whittle {

enum class Mark : char {
  kDisabled = '*',    ///< hidden
  kRoot = '!',        ///< shown alone
  kHighlight = '#',   ///< marked by a viewer
  kBackground = '%',  ///< not a part of the solid
};

bool has_mark(const SyntaxNode& node, Mark mark);

/// Puts the mark before a statement or takes it away. Only one statement of a file can be shown
/// alone: kRoot is taken from all others. Returns the node and errors as parameters.h.
Result<uint32_t> set_mark(SourceDocument& document, uint32_t node, Mark mark, bool is_set);

}  // namespace whittle
