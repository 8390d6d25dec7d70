// --views and --angle: several views of a solid.
#pragma once

#include <string>
#include <vector>

#include "option_group.h"
#include "sheet/sheet.h"

namespace whittle {

struct SheetArguments {
  std::vector<NamedView> views;  ///< empty: one picture
  ProjectionAngle angle = ProjectionAngle::kThird;
  bool has_angle = false;
};
void add_sheet_options(CLI::App& app, SheetArguments& sheet);

}  // namespace whittle
