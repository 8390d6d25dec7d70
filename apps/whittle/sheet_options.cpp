#include "sheet_options.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace whittle {
namespace {

constexpr std::array<Choice<ProjectionAngle>, 2> kAngles = {
    {{"first", ProjectionAngle::kFirst}, {"third", ProjectionAngle::kThird}}};

std::vector<NamedView> parse_views(std::string_view text) {
  std::vector<NamedView> views;
  while (true) {
    const size_t comma = text.find(',');
    const std::string_view name = text.substr(0, comma);
    const Result<NamedView> view = choose(named_view_choices(), "view", name);
    if (!view) refuse("--views", view.error().message);
    if (std::ranges::find(views, *view) != views.end())
      refuse("--views", "'" + std::string(name) + "' is there twice");
    views.push_back(*view);
    if (comma == std::string_view::npos) return views;
    text.remove_prefix(comma + 1);
  }
}

}  // namespace

void add_sheet_options(CLI::App& app, SheetArguments& sheet) {
  OptionGroup group(app, "View, as in OpenSCAD");
  group.add_text("--views", "A,B,...",
                 "several views by name on one sheet, with dimensions;\n"
                 "with {view} in OUT a picture each",
                 [&](const std::string& text) { sheet.views = parse_views(text); });
  group.add_choice("--angle", Choices<ProjectionAngle>(kAngles), "projection angle",
                   "of such a sheet: {} (third)", [&](ProjectionAngle angle) {
                     sheet.angle = angle;
                     sheet.has_angle = true;
                   });
}

}  // namespace whittle
