// From .csg text to what it says.
#pragma once

#include <string>
#include <string_view>

#include "base/result.h"
#include "csg/read_csg.h"
#include "csg/text_source.h"
#include "model/document.h"
#include "model/warnings.h"

namespace whittle {

/// Reads text that check_text() has passed; that there is no NUL in it is found out here.
/// `file_name` is what messages call it. The result does not refer to `text`. Errors are kInput
/// with one line `file:line:column: error: ...`. One pass, linear in the text; nesting costs
/// memory, never stack. A text of several pieces is read on `options.threads`; what is read, and
/// what is said, is the same on any number of them.
Result<Document> read_document(TextSource& source, const std::string& file_name,
                               const ReadOptions& options, Warnings& warnings);
Result<Document> read_document(std::string_view text, const std::string& file_name,
                               const ReadOptions& options, Warnings& warnings);

}  // namespace whittle
