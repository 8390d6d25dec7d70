// What is text at all, before it is read as .csg.
#pragma once

#include <string>
#include <string_view>

#include "base/result.h"
#include "csg/read_csg.h"

namespace whittle {

/// The text as it can be read, without a byte-order mark; or why it is none, as its first bytes and
/// its size show. Errors are kInput with their place in `file_name`.
Result<std::string_view> check_text(std::string_view text, const std::string& file_name,
                                    const ReadLimits& limits);

/// An error likewise if there is a NUL in it.
Status check_nul(std::string_view text, const std::string& file_name);

}  // namespace whittle
