#include "evaluate/budget.h"

#include <fmt/format.h>

#include "base/limit_hint.h"

namespace whittle {

std::string Budget::message() const {
  if (!why_.empty()) return why_;
  if (is_tangled()) return "flat shapes up to this one have too many lines across one another";
  if (facets_ > most_) {
    return fmt::format(
        "with this shape the model has {} facets, more than the limit of {}; a smaller $fn gives "
        "fewer, smooth curves none{}",
        facets_, most_, limit_hint("facets"));
  }
  return fmt::format(
      "flat shapes, hulls and sums up to this one are computed from {} corners, more than the "
      "limit of {}{}",
      work_, kWork * most_, limit_hint("facets"));
}

}  // namespace whittle
