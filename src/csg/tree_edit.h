// Edits of a tree of nodes while it is being read, each one pass over the array.
#pragma once

#include <cstdint>

#include "model/document.h"

namespace whittle {

/// Node::end of a node that is to be removed: no node that stays has it.
inline constexpr uint32_t kRemoved = 0;

/// Removes the nodes whose `end` is kRemoved; their children become their parents' children, in
/// their place. nodes[0] must stay.
void remove_marked(Model& model);

/// Reduces the document to the subtree at `root`, which becomes the only child of nodes[0], and to
/// what the nodes in it name: primitives, leaves, transforms and so on. Nodes may be marked as
/// removed, but not `root`.
void keep_subtree(Document& document, uint32_t root);

}  // namespace whittle
