// How the functions that edit answer.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "base/result.h"

namespace whittle {

/// Something that cannot be done to a document.
inline Error mistake(std::string message) {
  return {ErrorKind::kInput, std::move(message)};
}

/// The node, if what was done to the document is done.
inline Result<uint32_t> applied(const Status& status, uint32_t node) {
  if (!status) return status.error();
  return node;
}

}  // namespace whittle
