// Taking statements away, doubling, moving and grouping them, and what they do with their children.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "edit/source_document.h"

namespace whittle {

// What the functions return, and their errors, are as in parameters.h. Nodes are statements,
// assignments and blocks, never the file.

/// Takes nodes away with all that is in them, in one step. What they stood in.
Result<uint32_t> remove_nodes(SourceDocument& document, std::vector<uint32_t> nodes);

/// Adds a copy of a node behind it; the copy.
Result<uint32_t> duplicate_node(SourceDocument& document, uint32_t node);

/// Moves a node into `parent`, before the child that is there at `position` when the node itself
/// does not count; behind them all if there are not so many. The same parent is allowed.
Result<uint32_t> move_node(SourceDocument& document, uint32_t node, uint32_t parent,
                           size_t position);

/// Puts nodes of one parent together into a new statement, `group` or another operation, where the
/// first of them is; the new statement. An assignment cannot be grouped.
Result<uint32_t> group_nodes(SourceDocument& document, std::vector<uint32_t> nodes,
                             std::string_view operation = "group");

/// Whether `change_operation` knows the name.
bool is_operation_name(std::string_view name);

/// Makes an operation another one: group, union, difference, intersection, hull, minkowski.
/// Arguments go that the new one does not take.
Result<uint32_t> change_operation(SourceDocument& document, uint32_t node, std::string_view name);

}  // namespace whittle
