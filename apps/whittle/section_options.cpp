#include "section_options.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>

#include "base/printable.h"
#include "csg/color_names.h"
#include "model/explode.h"
#include "option_group.h"
#include "whittle/section_text.h"

namespace whittle {
namespace {

constexpr size_t kMostSections = 16;
constexpr double kFarthestExplosion = 1000;

}  // namespace

void add_section_options(CLI::App& app, SectionArguments& section) {
  OptionGroup group(app, "Section");
  group.add_each("--section", "S",
                 "cut the solid open: x=0, z>3.5 (what is taken away), n=[1,1,0],d=3,\n"
                 "x>0,y<0 (a quarter); each --section cuts",
                 [&](const std::string& text) {
                   const Result<Section> read = parse_section(text);
                   if (!read) refuse("--section", read.error().message);
                   if (section.sections.size() == kMostSections)
                     refuse("--section", fmt::format("there are more than {}", kMostSections));
                   section.sections.push_back(*read);
                 });
  group.add_each("--section-keep", "COLOR", "parts of this colour stay whole: a name or #rrggbb",
                 [&](const std::string& text) {
                   const std::optional<Rgba> color = parse_color(text);
                   if (!color)
                     refuse("--section-keep", fmt::format("'{}' is not a colour", printable(text)));
                   section.kept.push_back(*color);
                 });
  group.add_text("--explode", "F", "move the parts apart: F times the way from the common middle",
                 [&](const std::string& text) {
                   const double factor = parse_number("--explode", text);
                   if (factor < 0 || factor > kFarthestExplosion)
                     refuse("--explode", fmt::format("wants a number, 0 to {}, not {}",
                                                     kFarthestExplosion, printable(text)));
                   section.explode = factor;
                 });
}

Status open_if_asked(const SectionArguments& section, Model& model) {
  if (section.explode) {
    Result<Model> moved = explode(model, *section.explode);
    if (!moved) return moved.error();
    model = *std::move(moved);
  }
  if (!section.is_wanted()) {
    if (section.kept.empty()) return Done{};
    return Error{ErrorKind::kUsage, "--section-keep is for --section"};
  }
  Result<Model> cut = cut_open(model, section.sections, section.kept);
  if (!cut) return cut.error();
  model = *std::move(cut);
  return Done{};
}

}  // namespace whittle
