#include "model/model.h"

#include <fmt/format.h>

namespace whittle {

std::string message_at(const std::string& file, SourceLocation where, const std::string& message) {
  return fmt::format("{}:{}:{}: {}", file, where.line, where.column, message);
}

}  // namespace whittle
