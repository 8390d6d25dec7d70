// `$vpt`, `$vpr`, `$vpd` and `$vpf` as a file assigns them.
#pragma once

#include <string_view>

#include "csg/values.h"
#include "model/model.h"
#include "model/warnings.h"

namespace whittle {

/// Takes the value of one of them; other names are not looked at. Values of a wrong kind give a
/// warning and leave the view as it is.
void assign_view(std::string_view name, const Value& value, SourceLocation where, FileView& view,
                 Warnings& warnings);

}  // namespace whittle
