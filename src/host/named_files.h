// Files that a text names, as import() and surface() do.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "csg/read_csg.h"

namespace whittle {

/// Reads files by the names that a text in `folder` gives them (an empty folder is the current
/// one). With `root`, only what lies in that folder tree, all links resolved. Of all that it reads
/// together at most `most_bytes`. Errors: kInput, in words without the name.
NamedFiles named_files(std::string folder, std::optional<std::string> root, size_t most_bytes);

}  // namespace whittle
