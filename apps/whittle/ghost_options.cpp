#include "ghost_options.h"

namespace whittle {

void add_ghost_options(CLI::App& app, RenderArguments& a) {
  OptionGroup group(app, "Look");
  group.add_flag("--ghosts", a.renderer.ghosts, "what % and # mark is drawn, see-through");
  group.add_text(
      "--cut-color", "NAME",
      "cutter (as in OpenSCAD) or part: whose colour a cut\nhas, the cutter's or that of "
      "what was cut",
      [&](const std::string& name) {
        if (name != "cutter" && name != "part")
          refuse("--cut-color", "wants cutter or part, not " + name);
        a.renderer.part_colors = name == "part";
      });
}

Status settle_ghosts(RenderArguments& a) {
  const bool is_openscad = a.shading.style == Style::kOpenscad;
  const ScadArguments& scad = a.loading.scad;
  if (a.renderer.ghosts && is_openscad && !scad.previews) {
    return Error{ErrorKind::kUsage,
                 "--ghosts: style openscad shows what OpenSCAD's --render does, which has none; "
                 "--preview shows its preview, with them"};
  }
  if (a.renderer.part_colors && is_openscad && !scad.previews) {
    return Error{
        ErrorKind::kUsage,
        "--cut-color part: style openscad shows what OpenSCAD's --render does, which knows "
        "no color(); --preview does"};
  }
  if (scad.previews) {
    a.renderer.ghosts = true;
    a.renderer.thrown_together = scad.thrown_together;
    a.shading.is_preview = a.renderer.frames_bounds = is_openscad;
  }
  a.loading.background = a.renderer.ghosts;
  a.loading.draws_previews = true;
  return Done{};
}

}  // namespace whittle
