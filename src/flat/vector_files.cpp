#include "flat/outlines.h"

namespace whittle {
Result<Polygons> read_dxf(std::string_view, const Import&, const Remark&) {
  return Error{ErrorKind::kInput, "DXF is not read yet"};
}
}  // namespace whittle
