// A whole file as text.
#pragma once

#include <string>

#include "base/result.h"

namespace whittle {

/// The bytes of a file; "-" is standard input. Errors: kInput, with the system's reason;
/// a file of 4 GiB or more is too large.
Result<std::string> read_text(const std::string& path);

}  // namespace whittle
