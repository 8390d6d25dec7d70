#include "render_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "host/input_kinds.h"
#include "option_group.h"

namespace whittle {
namespace {

constexpr double kLeastScale = 1e-6, kMostScale = 1e6;

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
  output.add_text(
      "--export-format", "NAME", names_of(export_format_choices()) + ",\nwhatever OUT ends in",
      [&](const std::string& name) {
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
  add_summary_options(app, a.summary);
  add_reference_options(app, a.reference);
  add_view_options(app, a.view, a.loading);
  add_style_options(app, a.shading);
  add_color_options(app, a.shading);
  add_shadow_option(app, a.shading);
  look.add_count("--aa", "N", a.antialias, 1, kMostAntialias,
                 "N x N rays a pixel at edges, 1 to 16 (studio: 3, plain: 4)");
  look.add_flag("--no-background", a.no_background, "what is not hit is transparent");
  add_loading_options(line, a.loading);
  add_lenient_option(app, a.loading);
  add_machine_options(app, a.renderer, a.loading);
  machine.add_flag("--stats", a.wants_statistics, "say what was done and what it cost");
  add_subdivision_options(app, a.subdivision);
  line.add_version("whittle " WHITTLE_VERSION);
}

Result<std::vector<Output>> choose_outputs(const RenderArguments& a) {
  if (a.outputs.empty() && !a.reference.file) {
    return Error{ErrorKind::kUsage,
                 "there is no window yet; give -o FILE, which may end in " + export_endings()};
  }
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
  for (const Output& output : outputs) templates.push_back({"-o", output.path, true});
  if (a.openscad.dependency_file) templates.push_back({"-d", *a.openscad.dependency_file, false});
  if (a.summary.file) templates.push_back({"--summary-file", *a.summary.file, false});
  if (a.reference.file) templates.push_back({"--reference", *a.reference.file, false});
  if (a.reference.difference)
    templates.push_back({"--reference-difference", *a.reference.difference, false});
  return templates;
}

std::string frame_output(const RenderArguments& a, const std::string& pattern, int frame) {
  const std::string path =
      *fill_template(pattern, {template_name(a.file), fmt::format("{:05}", frame)});
  return has_word(pattern, "n") ? path : frame_path(path, frame);
}

Status check_possible(const RenderArguments& a, const std::vector<Output>& outputs) {
  if (Status possible = check_shadows(a.shading); !possible) return possible;
  if (Status possible = check_view(a.view); !possible) return possible;
  if (Status possible = check_loading(a.file, a.loading); !possible) return possible;
  if (Status possible = check_reference(a.reference); !possible) return possible;
  if (a.scale && !a.view.orthographic)
    return Error{ErrorKind::kUsage, "--scale is for --projection ortho; no other view has a scale"};
  const Animation& animation = a.openscad.animation;
  if (animation.shards > 1 && animation.frames == 0) {
    return Error{ErrorKind::kUsage, "--animate_sharding is for --animate N"};
  }
  if (animation.frames > 0 && kind_of_input(a.file) != InputKind::kScad) {
    return Error{ErrorKind::kUsage,
                 fmt::format("--animate: {} has no time; only a .scad file has", a.file)};
  }
  if (animation.frames > 0 && a.reference.file) {
    return Error{ErrorKind::kUsage, "--reference is for one picture, and --animate makes many"};
  }
  std::vector<std::string> paths;
  for (const Output& output : outputs) {
    if (animation.frames > 0 && !output.is_picture()) {
      return Error{ErrorKind::kUsage, "--animate makes pictures, .png or .exr"};
    }
    if (animation.frames > 0 && output.path == "-") {
      return Error{ErrorKind::kUsage, "--animate makes many files; -o - is one"};
    }
    paths.push_back(animation.frames > 0 ? frame_output(a, output.path, animation.first())
                                         : output.path);
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
