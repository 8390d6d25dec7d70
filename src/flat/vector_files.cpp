#include "flat/outlines.h"

namespace whittle {
Result<Polygons> read_svg(std::string_view, const Import&, const Remark&) {
  return Error{ErrorKind::kInput, "SVG is not read yet"};
}
}  // namespace whittle
