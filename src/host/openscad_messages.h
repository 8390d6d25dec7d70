// What the openscad program says while it evaluates a file.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace whittle {

/// Several lines as one.
std::string in_one_line(std::string_view text);

/// The first error among what openscad said, as `file:line: error: openscad: ...`. It goes on after
/// one, without what comes then, and its exit code may be 0. `path` is what the user calls the
/// file, `source` what openscad was given; a place after its end, of which it speaks where
/// something is not closed, is its last line.
std::optional<Error> first_error(std::string_view messages, const std::string& path,
                                 const std::string& source, std::string_view source_text);

/// Why openscad did not evaluate a file, in its own words; empty if it said none.
std::string why_it_ended(std::string_view messages);

/// The lines that are not empty.
std::vector<std::string> lines_of(std::string_view text);

}  // namespace whittle
