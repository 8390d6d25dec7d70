#include "render_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "ghost_options.h"
#include "host/input_kinds.h"
#include "option_group.h"

namespace whittle {
namespace {

constexpr double kLeastScale = 1e-6, kMostScale = 1e6;

/// On two lines.
std::string help_of_formats() {
  std::string help = names_of(export_format_choices()) + "; whatever OUT ends in";
  // Films begin the second.
  help.replace(help.find(" gif"), 1, "\n");
  return help;
}

TemplateWords words_of(const RenderArguments& a) {
  TemplateWords words{template_name(a.file)};
  if (a.view.named) words.view = name_of(named_view_choices(), *a.view.named);
  return words;
}

/// What cannot be where there are frames.
Status check_frames(const RenderArguments& a) {
  const Animation& animation = a.openscad.animation;
  const auto refused = [](std::string why) { return Error{ErrorKind::kUsage, std::move(why)}; };
  if (animation.shards > 1 && animation.frames == 0)
    return refused("--animate_sharding is for --animate N");
  if (animation.frames > 0 && a.film.turntable > 0)
    return refused("--animate and --turntable each make frames; give one");
  if (animation.frames > 0 && kind_of_input(a.file) != InputKind::kScad)
    return refused(fmt::format("--animate: {} has no time; only a .scad file has", a.file));
  if (a.film.has_fps && !a.moves()) return refused("--fps is for --animate N and --turntable N");
  if (a.moves() && a.reference.file)
    return refused(fmt::format("--reference is for one picture, and {} makes many",
                               a.film.turntable > 0 ? "--turntable" : "--animate"));
  return Done{};
}

/// What cannot be where there are several views.
Status check_views(const RenderArguments& a, const std::vector<Output>& outputs) {
  const auto refused = [](std::string why) { return Error{ErrorKind::kUsage, std::move(why)}; };
  if (a.sheet.views.empty())
    return a.sheet.has_angle ? refused("--angle is for a sheet of --views A,B,...")
                             : Status(Done{});
  if (gives_camera(a.view))
    return refused("--views says where the eye is; so do --from and --camera: give one");
  if (a.moves()) return refused("--views is for pictures that have no frames");
  if (a.reference.file) return refused("--reference is for one picture, and --views makes many");
  if (a.summary.is_wanted()) return refused("--summary is for one picture; --views has many");
  for (const Output& output : outputs) {
    const bool is_svg = output.format == ExportFormat(DrawingFormat::kSvg);
    if (!output.is_picture() && !is_svg)
      return refused(fmt::format("-o {}: --views makes pictures, .png or .exr, and drawings, .svg",
                                 output.path));
    if (has_word(output.path, "view")) continue;
    if (output.is(FileFormat::kExr))
      return refused(
          fmt::format("-o {}: facts are of one view; with {{view}} in its name there is "
                      "a file of each",
                      output.path));
    if (a.pass != Pass::kColor)
      return refused(
          fmt::format("--pass {}: a sheet shows colours", name_of(pass_choices(), a.pass)));
    if (a.overlays.axes || a.overlays.grid || a.overlays.scale_bar)
      return refused("a sheet has dimensions; --axes, --grid and --scale-bar are for one view");
  }
  return Done{};
}

Status check_overlays(const RenderArguments& a) {
  if (!a.overlays.any()) return Done{};
  if (a.overlays.scale_bar && !a.view.orthographic)
    return Error{ErrorKind::kUsage,
                 "--scale-bar is for --projection ortho; no other view has a scale"};
  if (a.pass != Pass::kColor)
    return Error{ErrorKind::kUsage, fmt::format("--pass {}: --axes, --grid, --scale-bar and "
                                                "--title are drawn over colours",
                                                name_of(pass_choices(), a.pass))};
  return Done{};
}

/// Where an output goes; of frames the first.
std::vector<std::string> paths_of(const RenderArguments& a, const Output& output) {
  if (a.moves() && !output.is_film())
    return {frame_output(a, output.path, a.openscad.animation.first())};
  if (a.moves()) return {still_output(a, output.path)};
  if (a.sheet.views.empty()) return {output.path};
  if (!has_word(output.path, "view")) return {still_output(a, output.path)};
  std::vector<std::string> paths;
  for (const NamedView view : a.sheet.views) paths.push_back(view_output(a, output.path, view));
  return paths;
}

/// What cannot be an output of theirs.
Status check_frame_output(const RenderArguments& a, const Output& output) {
  const auto refused = [](std::string why) { return Error{ErrorKind::kUsage, std::move(why)}; };
  const char* const option = a.film.turntable > 0 ? "--turntable" : "--animate";
  if (output.is_film())
    return a.moves() ? check_film(a.film, std::get<FilmFormat>(output.format), output.path,
                                  a.no_background)
                     : refused(fmt::format("-o {}: a film has frames, of --turntable N or, of a "
                                           ".scad, --animate N",
                                           output.path));
  if (!a.moves()) return Done{};
  if (!output.is_picture())
    return refused(
        fmt::format("{} makes pictures, .png or .exr, and films, .gif, .apng, .mp4 or "
                    ".webm",
                    option));
  if (output.path == "-") return refused(fmt::format("{} makes many files; -o - is one", option));
  return Done{};
}

}  // namespace

void add_options(CommandLine& line, RenderArguments& a) {
  CLI::App& app = line.app();
  line.add_required("FILE", a.files);
  OptionGroup output(app, "Output"), look(app, "Look"), machine(app, "Machine");
  output.add_each("-o", "OUT",
                  "a picture (.png, .exr), the solid (.stl, .off, .obj, .3mf, .amf)\n"
                  "or a drawing (.svg, .dxf; of a solid an .svg, in lines), each -o\n"
                  "one; '-': standard output; {name} in it is FILE's name",
                  [&](const std::string& path) { a.outputs.push_back(path); });
  output.add_text("--export-format", "NAME", help_of_formats(), [&](const std::string& name) {
    const Result<ExportFormat> format = choose(export_format_choices(), "format", name);
    if (!format)
      refuse("--export-format", refusal_of_format(name).value_or(format.error().message));
    a.export_format = *format;
  });
  output.add_choice("--pass", pass_choices(), "pass", "what a PNG shows: {}",
                    [&](Pass pass) { a.pass = pass; });
  output.add_flag("--hidden-lines", a.lines.hidden, "an .svg shows hidden lines, dashed");
  output.add_text(
      "--scale", "S", "of an .svg with --projection ortho: millimetres for one unit (1)",
      [&](const std::string& text) {
        a.scale = parse_number("--scale", text);
        if (*a.scale < kLeastScale || *a.scale > kMostScale)
          refuse("--scale",
                 fmt::format("'{}' is not between {} and {}", text, kLeastScale, kMostScale));
      });
  add_openscad_options(line, a.openscad);
  add_film_options(app, a.film);
  add_summary_options(app, a.summary);
  add_reference_options(app, a.reference);
  add_view_options(app, a.view, a.loading);
  add_sheet_options(app, a.sheet);
  add_style_options(app, a.shading);
  add_color_options(app, a.shading);
  add_shadow_option(app, a.shading);
  add_ghost_options(app, a);
  add_section_options(app, a.loading.section);
  OptionGroup(app, "Section")
      .add_flag("--hatch", a.shading.hatch, "caps are hatched, another way for each colour");
  look.add_flag("--xray", a.xray, "all walls at once, the outer ones faint");
  look.add_count("--aa", "N", a.antialias, 1, kMostAntialias,
                 "N x N rays a pixel at edges, 1 to 16 (studio: 3, plain: 4)");
  add_overlay_options(app, a.overlays);
  look.add_flag("--no-background", a.no_background, "what is not hit is transparent");
  add_loading_options(line, a.loading);
  add_lenient_option(app, a.loading);
  add_machine_options(app, a.renderer, a.loading);
  machine.add_flag("--stats", a.wants_statistics, "say what was done and what it cost");
  add_subdivision_options(app, a.subdivision);
  line.add_version("whittle " WHITTLE_VERSION);
}

LineSettings line_settings(const RenderArguments& a) {
  LineSettings lines = a.lines;
  lines.scale = a.scale.value_or(1);
  return lines;
}

Result<std::vector<Output>> choose_outputs(const RenderArguments& a) {
  std::vector<Output> outputs;
  for (const std::string& path : a.outputs) {
    const auto is_standard = [](const Output& other) { return other.path == "-"; };
    if (path == "-" && std::ranges::any_of(outputs, is_standard)) {
      return Error{ErrorKind::kUsage, "-o - (standard output) is given more than once"};
    }
    if (a.export_format) {
      outputs.push_back({path, *a.export_format});
      continue;
    }
    if (path == "-") {
      return Error{ErrorKind::kUsage, fmt::format("-o - (standard output) needs --export-format {}",
                                                  names_of(export_format_choices()))};
    }
    const Result<ExportFormat> format = export_format_of(path);
    if (!format) {
      return Error{ErrorKind::kUsage, refusal_of_format(path).value_or(format.error().message)};
    }
    outputs.push_back({path, *format});
  }
  return outputs;
}

std::vector<OutputTemplate> templates_of(const RenderArguments& a,
                                         const std::vector<Output>& outputs) {
  std::vector<OutputTemplate> templates;
  for (const Output& output : outputs)
    templates.push_back({"-o", output.path, !output.is_film(), true});
  const auto add = [&](const char* option, const std::string& path) {
    templates.push_back({option, path, false, false});
  };
  if (a.openscad.dependency_file) add("-d", *a.openscad.dependency_file);
  if (a.summary.file) add("--summary-file", *a.summary.file);
  if (a.reference.file) add("--reference", *a.reference.file);
  if (a.reference.difference) add("--reference-difference", *a.reference.difference);
  return templates;
}

std::string still_output(const RenderArguments& a, const std::string& pattern) {
  return *fill_template(pattern, words_of(a));
}

std::string view_output(const RenderArguments& a, const std::string& pattern, NamedView view) {
  TemplateWords words = words_of(a);
  words.view = name_of(named_view_choices(), view);
  return *fill_template(pattern, words);
}

std::string frame_output(const RenderArguments& a, const std::string& pattern, int frame) {
  TemplateWords words = words_of(a);
  words.n = fmt::format("{:05}", frame);
  const std::string path = *fill_template(pattern, words);
  return has_word(pattern, "n") ? path : frame_path(path, frame);
}

Status check_possible(const RenderArguments& a, const std::vector<Output>& outputs) {
  if (Status possible = check_shadows(a.shading); !possible) return possible;
  if (Status possible = check_view(a.view); !possible) return possible;
  if (Status possible = check_loading(a.file, a.loading); !possible) return possible;
  if (Status possible = check_reference(a.reference); !possible) return possible;
  if (Status possible = check_views(a, outputs); !possible) return possible;
  if (Status possible = check_overlays(a); !possible) return possible;
  if (a.shading.hatch && !a.loading.section.is_wanted())
    return Error{ErrorKind::kUsage, "--hatch is for --section; nothing is cut open"};
  if (a.xray && a.pass != Pass::kColor)
    return Error{ErrorKind::kUsage, "--xray is a picture of its own; it has no --pass"};
  if (a.xray && a.shading.shadows)
    return Error{ErrorKind::kUsage, "--xray has no --shadows; light goes through the solid"};
  if ((a.renderer.ghosts || a.renderer.thrown_together) &&
      (a.loading.section.is_wanted() || a.xray)) {
    return Error{ErrorKind::kUsage,
                 "--section and --xray show the solid alone; --ghosts and --preview do not"};
  }
  // All that is to scale on a sheet is orthographic by itself.
  if (a.scale && !a.view.orthographic && a.sheet.views.empty())
    return Error{ErrorKind::kUsage, "--scale is for --projection ortho; no other view has a scale"};
  if (Status possible = check_frames(a); !possible) return possible;
  std::vector<std::string> paths;
  for (const Output& output : outputs) {
    if (Status possible = check_frame_output(a, output); !possible) return possible;
    const std::vector<std::string> more = paths_of(a, output);
    paths.insert(paths.end(), more.begin(), more.end());
  }
  if (a.openscad.dependency_file) paths.push_back(*a.openscad.dependency_file);
  if (a.summary.file) paths.push_back(*a.summary.file);
  if (a.reference.difference) paths.push_back(*a.reference.difference);
  for (const std::string& path : paths) {
    if (Status possible = check_not_input(path, a.file); !possible) return possible;
    if (a.reference.file) {
      if (Status possible = check_not_input(path, *a.reference.file); !possible) return possible;
    }
    if (Status possible = check_writable(path); !possible) return possible;
  }
  return Done{};
}

}  // namespace whittle
