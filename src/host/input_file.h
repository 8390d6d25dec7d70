// A whole file as text, or as bytes.
#pragma once

#include <cstddef>
#include <string>

#include "base/result.h"
#include "csg/read_csg.h"

namespace whittle {

/// The bytes of a file; "-" is standard input. What has a zero byte in it is no text, and may end
/// there: devices never do. Errors: kInput, with the system's reason, or that it has more bytes
/// than `most_bytes` (at most kMostTextBytes).
Result<std::string> read_text(const std::string& path, size_t most_bytes = kMostTextBytes);

/// The bytes of a file, whatever they are; of no device, pipe or folder. Errors: kInput, why it
/// cannot be read, without its name.
Result<std::string> read_bytes(const std::string& path, size_t most_bytes);

}  // namespace whittle
