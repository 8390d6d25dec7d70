#include "csg/check_text.h"

#include <fmt/format.h>

#include "base/limit_hint.h"
#include "model/model.h"

namespace whittle {

Result<std::string_view> check_text(std::string_view text, const std::string& file_name,
                                    const ReadLimits& limits) {
  const auto refuse = [&](SourceLocation where, std::string_view why) {
    return Error{ErrorKind::kInput, message_at(file_name, where, fmt::format("error: {}", why))};
  };
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) {
    return refuse({1, 1}, "the file is UTF-16 text; save it as UTF-8");
  }
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  if (text.size() > limits.bytes) {
    return refuse({1, 1}, fmt::format("larger than the limit of {} bytes{}", limits.bytes,
                                      limit_hint("bytes")));
  }
  if (text.size() > kMostTextBytes) return refuse({1, 1}, "larger than 4 GiB");
  return text;
}

Status check_nul(std::string_view text, const std::string& file_name) {
  const size_t at = text.find('\0');
  if (at == std::string_view::npos) return Done{};
  SourceLocation where{1, 1};
  for (const char c : text.substr(0, at)) {
    where = c == '\n' ? SourceLocation{where.line + 1, 1}
                      : SourceLocation{where.line, where.column + 1};
  }
  return Error{ErrorKind::kInput,
               message_at(file_name, where, "error: a NUL byte; this is not a text file")};
}

}  // namespace whittle
