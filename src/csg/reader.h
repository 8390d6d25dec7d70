// From .csg text to what it says.
#pragma once

#include <string>
#include <string_view>

#include "base/result.h"
#include "csg/read_csg.h"
#include "model/document.h"
#include "model/warnings.h"

namespace whittle {

/// Reads text that check_text() has passed. `file_name` is what messages call it. The result does
/// not refer to `text`. Errors are kInput with one line `file:line:column: error: ...`. One pass,
/// linear in the text; nesting costs memory, never stack.
Result<Document> read_document(std::string_view text, const std::string& file_name,
                               const ReadOptions& options, Warnings& warnings);

}  // namespace whittle
