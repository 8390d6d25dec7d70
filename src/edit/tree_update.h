// The tree of a text's statements after bytes of the text were replaced.
#pragma once

#include <cstddef>
#include <string_view>

#include "csg/syntax_tree.h"
#include "whittle/options.h"

namespace whittle {

/// Makes `tree` that of `text`, which differs from the text that it was of in the bytes `changed`
/// (places in the old text) and became `growth` bytes longer. Only whole statements around them
/// that have one parent are read again; the places of all that stands behind them move, which is
/// one pass over the array.
///
/// False if that does not do, because the change reaches further than those statements: nothing has
/// changed then, and all must be read.
bool update_tree(SyntaxTree& tree, TextRange changed, ptrdiff_t growth, std::string_view text,
                 const ReadLimits& limits);

}  // namespace whittle
