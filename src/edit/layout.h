// How statements stand on the lines of a text, so that what is added looks like what is there.
#pragma once

#include <string>
#include <string_view>

#include "csg/syntax_tree.h"

namespace whittle {

/// The blanks before a statement on its line; empty if there is anything else before it.
std::string_view indentation(std::string_view text, const SyntaxNode& node);

/// Whether nothing but blanks stands beside a statement on its lines.
bool is_alone(std::string_view text, const SyntaxNode& node);

/// The bytes of a statement; with the rest of its lines, and their last end, if it is alone there.
TextRange own_lines(std::string_view text, const SyntaxNode& node);

/// How lines end in this text.
std::string_view line_end(std::string_view text);

}  // namespace whittle
