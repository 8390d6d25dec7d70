#include "evaluate/budget.h"

#include <fmt/format.h>

namespace whittle {

std::string Budget::message() const {
  if (is_tangled()) return "flat shapes up to this one have too many lines across one another";
  if (facets_ > most_) {
    return fmt::format(
        "with this shape the model has {} facets, more than the limit of {}; a smaller $fn gives "
        "fewer, --curves smooth none, --limit facets=N raises it",
        facets_, most_);
  }
  return fmt::format(
      "flat shapes and hulls up to this one are computed from {} corners, more than the limit of "
      "{}; --limit facets=N raises it",
      work_, kWork * most_);
}

}  // namespace whittle
