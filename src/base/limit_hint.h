// How messages say that a limit can be raised.
#pragma once

#include <string>
#include <string_view>

namespace whittle {

/// The end of a message about the limit of that name. A program may replace it by how its user can
/// raise the limit.
inline std::string limit_hint(std::string_view name) {
  return "; the limit '" + std::string(name) + "' can be raised";
}

}  // namespace whittle
