// Dependency files for make, as openscad writes them: `target: \` and then a file a line.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace whittle {

/// The files that a dependency file names, its targets left out.
std::vector<std::string> read_dependencies(std::string_view text);

/// A dependency file: each of the targets is to be made again when any of the files has changed.
/// What make takes for more than a letter of a name is escaped.
std::string write_dependencies(std::span<const std::string> targets,
                               std::span<const std::string> files);

}  // namespace whittle
