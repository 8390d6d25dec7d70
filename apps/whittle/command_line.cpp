#include "command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "console.h"
#include "host/input_kinds.h"
#include "option_group.h"
#include "progress.h"
#include "statistics.h"
#include "whittle/camera_text.h"
#include "whittle/reading.h"

namespace whittle {

void add_loading_options(CommandLine& line, Loading& loading) {
  CLI::App& app = line.app();
  OptionGroup group(app, "Reading");
  group.add_choice("--curves", curves_choices(), "kind of curves",
                   "{}; auto: facets where $fn asks\nfor them, and in style openscad",
                   [&](Curves curves) { loading.curves = curves; });
  group.add_choice("--matrices", matrices_choices(), "kind of matrices",
                   "{}; polished: rotations printed\nwith six digits are rotations again",
                   [&](bool polish) { loading.polish = polish; });
  group.add_flag("--strict", loading.strict, "fail if anything in FILE is not shown");
  group.add_flag("-q,--quiet", loading.quiet, "say nothing but errors");
  group.add_text("--import-root", "DIR", "read files that FILE names only from this folder tree",
                 [&](const std::string& folder) { loading.import_root = folder; });
  add_limit_option(app, loading.limits);
  add_scad_options(line, loading.scad);
}

void add_lenient_option(CLI::App& app, Loading& loading) {
  OptionGroup(app, "Reading")
      .add_flag("--lenient", loading.lenient,
                "exit code 0 although something in FILE is not shown");
}

Status check_loading(const std::string& file, const Loading& loading) {
  if (Status possible = check_scad(file, loading.scad); !possible) return possible;
  if (loading.scad.thrown_together && !loading.draws_previews) {
    return Error{ErrorKind::kUsage,
                 "--preview=throwntogether is for pictures: whittle FILE -o OUT.png"};
  }
  if (!loading.import_root || kind_of_input(file) != InputKind::kScad) return Done{};
  return Error{ErrorKind::kUsage,
               "--import-root: openscad, which evaluates a .scad file, reads whatever the file "
               "names; make a .csg of it where it can do no harm"};
}

void suit_style(Style style, Loading& loading) {
  loading.curves = curves_in_style(style, loading.curves);
  loading.outlines = has_outlines(loading.curves);
}

FileOptions read_options(const Loading& loading) {
  FlattenOptions flatten = loading.scad.flatten;
  // Programs may look at it, and openscad has a remark less.
  if (loading.view && gives_camera(*loading.view)) {
    flatten.arguments.push_back("--camera=" + camera_text(*loading.view));
  }
  return {.reading = {.curves = loading.curves,
                      .polish = loading.polish,
                      .threads = loading.threads ? *loading.threads : 0,
                      .limits = loading.limits,
                      .outlines = loading.outlines,
                      .background = loading.background,
                      .solid_box = box_maker(loading.threads ? *loading.threads : 0),
                      .closed_mesh = mesh_maker(loading.threads ? *loading.threads : 0)},
          .import_root = loading.import_root,
          .flatten = std::move(flatten),
          .standard_input = loading.standard_input.get()};
}

Status say_warnings(const Read& read, const Loading& loading) {
  const std::string said = read.model.file + ": openscad: ";
  const auto is_openscads = [&](const std::string& line) {
    return line.starts_with(said + "WARNING: ");
  };
  if (loading.strict) {
    if (read.unsupported) return Error{ErrorKind::kInput, read.refusal + " (--strict)"};
    if (!read.missing_file.empty()) {
      return Error{ErrorKind::kInput, read.missing_file + " (--strict)"};
    }
    const auto first = std::ranges::find_if(read.warnings, is_openscads);
    if (first != read.warnings.end()) return Error{ErrorKind::kInput, *first + " (--strict)"};
  }
  if (loading.scad.hard_warnings) {
    // Not all that openscad says is a warning.
    const auto first = std::ranges::find_if(read.warnings, [&](const std::string& line) {
      return is_openscads(line) || !line.starts_with(said);
    });
    if (first != read.warnings.end()) {
      return Error{ErrorKind::kInput, *first + " (--hardwarnings)"};
    }
  }
  if (loading.quiet) return Done{};
  for (const std::string& warning : read.warnings) say(warning);
  return Done{};
}

Result<Read> load(const std::string& file, const Loading& loading) {
  const auto read_with_progress = [&] {
    const ProgressLine progress(!loading.quiet, "reading");
    return with_limit_option(read_file(file, read_options(loading)));
  };
  if (Status possible = check_loading(file, loading); !possible) return possible.error();
  Result<Read> read = read_with_progress();
  if (!read) return read;
  if (Status fit = say_warnings(*read, loading); !fit) return fit.error();
  if (Status opened = open_if_asked(loading.section, read->model); !opened) return opened.error();
  return read;
}

void say_if_nothing_is_seen(const Model& model, const Frame& frame, const Loading& loading) {
  if (loading.quiet) return;
  if (std::ranges::any_of(frame.hits, [](const Hit& hit) { return hit.hit(); })) return;
  const int threads = loading.threads ? *loading.threads : 0;
  const bool is_empty = tight_box(model, threads).is_empty();
  say(fmt::format("{}: warning: {}", model.file,
                  is_empty ? "the solid is empty" : "nothing is in view"));
}

int code_for(const Read& read, const Loading& loading, const char* made) {
  if (!read.unsupported || loading.lenient) return kExitDone;
  return report({ErrorKind::kInput,
                 fmt::format("{}; so the {} is not what was meant (--lenient accepts that)",
                             read.refusal, made)});
}

void add_view_options(CLI::App& app, ViewOptions& view, Loading& loading) {
  add_view_options(app, view);
  loading.view = &view;
}

void add_size_option(OptionGroup& group, const std::function<void(int, int)>& set) {
  group.add_text(
      "--imgsize", "W,H", "pixels (512,512); each at most 65535, together 2^28",
      [set](const std::string& text) {
        if (text.find_first_of("xX*") != std::string::npos && text.find(',') == std::string::npos) {
          refuse("--imgsize", fmt::format("wants W,H as in 800,600, not {}", text));
        }
        const std::vector<double> size = parse_numbers("--imgsize", text, 2);
        const double width = size[0], height = size[1];
        if (width != std::floor(width) || height != std::floor(height)) {
          refuse("--imgsize", fmt::format("wants whole numbers, not {}", text));
        }
        // Any number that a double holds is not one that an integer holds.
        constexpr double kTooMuch = 1e9;
        if (std::fmax(std::fabs(width), std::fabs(height)) > kTooMuch) {
          refuse("--imgsize", fmt::format("wants sides of 1 to {}, not {}", kMostSide, text));
        }
        const Status possible = check_picture_size(int64_t(width), int64_t(height));
        if (!possible) refuse("--imgsize", possible.error().message);
        set(int(width), int(height));
      });
}

void add_view_options(CLI::App& app, ViewOptions& view) {
  OptionGroup group(app, "View, as in OpenSCAD");
  add_size_option(group, [&view](int width, int height) {
    view.width = width;
    view.height = height;
  });
  group.add_text("--camera", "NUMBERS",
                 "tx,ty,tz,rx,ry,rz,d: target, degrees, distance; or\n"
                 "ex,ey,ez,cx,cy,cz: eye, and the point it looks at",
                 [&](const std::string& text) {
                   Result<ViewOptions> parsed = parse_camera(text, view);
                   if (!parsed) refuse("--camera", parsed.error().message);
                   view = *std::move(parsed);
                 });
  group.add_choice("--from", named_view_choices(), "view", "{}:\nall of the solid from there",
                   [&view](NamedView named) { view.named = named; });
  group.add_flag("--viewall", view.view_all, "choose the distance so that all is seen");
  group.add_flag("--autocenter", view.auto_center, "with --viewall: look at the middle");
  group.add_choice("--projection", projection_choices(), "projection", "{}",
                   [&](bool orthographic) { view.orthographic = orthographic; });
  group.add_text("--fov", "DEGREES", "vertical field of view (22.5)", [&](const std::string& text) {
    const double degrees = parse_number("--fov", text);
    if (!(degrees > 0 && degrees < 180)) {
      refuse("--fov", fmt::format("wants an angle between 0 and 180, not {}", text));
    }
    view.fov_degrees = degrees;
  });
}

void add_color_options(CLI::App& app, ShadeSettings& shading) {
  OptionGroup group(app, "Look");
  group.add_text("--colorscheme", "NAME", "OpenSCAD's colours of that name, in any style",
                 [&](const std::string& name) {
                   shading.scheme = find_color_scheme(name);
                   if (shading.scheme != nullptr) return;
                   refuse("--colorscheme", fmt::format("unknown colour scheme '{}'; there are: {}",
                                                       name, color_scheme_names()));
                 });
  group.add_text("--light", "X,Y,Z", "style blinn: where the light stands (the eye)",
                 [&](const std::string& text) {
                   const std::vector<double> at = parse_numbers("--light", text, 3);
                   shading.light = Vec3{at[0], at[1], at[2]};
                 });
}

void add_shadow_option(CLI::App& app, ShadeSettings& shading) {
  OptionGroup(app, "Look")
      .add_flag("--shadows", shading.shadows,
                "lights reach only what they see (not in style openscad)");
}

void add_style_option(CLI::App& app, Style& style) {
  OptionGroup(app, "Look").add_choice("--style", style_choices(), "style", "{}", [&](Style chosen) {
    style = chosen;
  });
}

void add_style_options(CLI::App& app, ShadeSettings& shading) {
  add_style_option(app, shading.style);
  OptionGroup group(app, "Look");
  group.add_choice("--quality", quality_choices(), "quality",
                   "style studio: {} (good); draft: no rays for\nshadows, best: many",
                   [&](Quality quality) { shading.quality = quality; });
  group.add_flag(
      "--no-ground", [&] { shading.ground = false; }, "style studio: no shadow on the ground");
}

void add_machine_options(CLI::App& app, RendererSettings& settings, Loading& loading) {
  OptionGroup group(app, "Machine");
  group.add_text("--backend", "NAME",
                 fmt::format("{}; auto: the fastest that works here", names_of(backend_choices())),
                 [&](const std::string& name) {
                   const std::string lower = to_lower(name);
                   if (lower == "manifold" || lower == "cgal") return;
                   const Result<Backend> chosen = choose(backend_choices(), "backend", name);
                   if (!chosen) refuse("--backend", chosen.error().message);
                   settings.backend = *chosen;
                 });
  group.add_text("--device", "DEVICE",
                 "of vulkan backends: its number or a part of its name\n"
                 "(see whittle devices)",
                 [&](const std::string& device) { settings.device = device; });
  group.add_choice("--shaders", shaders_choices(), "kind of shaders",
                   "of vulkan-raster: {}; one for\neach case of cells, or one for all",
                   [&](ShaderCases shaders) { settings.shaders = shaders; });
  group.add_choice(
      "--culling", culling_choices(), "kind of culling",
      "of vulkan-raster: {}; whether cells\nbehind others are left out, for measurements",
      [&](bool culling) { settings.culling = culling; });
  group.add_count("--threads", "N", settings.threads, 0, kMostThreads,
                  "0 (all) to 1024; the picture is the same");
  loading.threads = &settings.threads;
}

Status settle_device(RendererSettings& settings) {
  if (settings.device.empty()) return Done{};
  if (settings.backend == Backend::kAuto) settings.backend = Backend::kVulkanRaster;
  if (settings.backend == Backend::kVulkanRaster) return Done{};
  return Error{ErrorKind::kUsage, "--device names a device for --backend vulkan-raster"};
}

void add_subdivision_options(CLI::App& app, SubdivisionArguments& arguments) {
  constexpr uint32_t kMostLeafSize = 1000;
  OptionGroup group(app, "Subdivision");
  group.add_text("--leaf-size", "K",
                 fmt::format("half-spaces a leaf, 1 to {}, or auto (auto): as many as\n"
                             "cost the rays less than splitting would",
                             kMostLeafSize),
                 [&](const std::string& text) {
                   arguments.leaf_size =
                       text == "auto"
                           ? kAutoLeafSize
                           : uint32_t(parse_count("--leaf-size", text, 1, kMostLeafSize));
                 });
  group.add_choice("--split", split_choices(), "split rule", "which axis is cut: {}",
                   [&](SplitRule rule) { arguments.split = rule; });
  group.add_text("--pixel-threshold", "PIXELS", "split no cell whose edges all look shorter (0)",
                 [&](const std::string& text) {
                   const double pixels = parse_number("--pixel-threshold", text);
                   if (pixels < 0) {
                     refuse("--pixel-threshold",
                            fmt::format("wants a number from 0 on, not {}", text));
                   }
                   arguments.pixel_threshold = pixels;
                 });
  group.add_choice("--small-cells", small_cells_choices(), "fate of small cells",
                   "below that threshold: {}",
                   [&](bool ignore) { arguments.ignore_small = ignore; });
  group.add_text("--memory", "SIZE",
                 fmt::format("what cells may take ({}), as in 100K, 100M, 2G; with\n"
                             "less the picture takes longer, but is the same",
                             describe_bytes(SubdivideSettings{}.memory)),
                 [&](const std::string& text) {
                   arguments.memory = parse_bytes("--memory", text, kMostMemory);
                 });
  group.add_flag("--paper", arguments.paper,
                 "the paper's rules: --split xyz, two primitives a leaf\n"
                 "(--leaf-size 2) or a union of any number,\n"
                 "--pixel-threshold 1, --small-cells ignore");
}

void apply(const SubdivisionArguments& arguments, RendererSettings& settings) {
  SubdivideSettings& s = settings.subdivide;
  if (arguments.paper) {
    s.leaf_size = 2;
    s.leaf = LeafRule::kPrimitives;
    s.split = SplitRule::kXyz;
    s.ignore_small = true;
    settings.pixel_threshold = 1;
  }
  s.leaf_size = arguments.leaf_size.value_or(s.leaf_size);
  s.memory = arguments.memory.value_or(s.memory);
  s.split = arguments.split.value_or(s.split);
  s.ignore_small = arguments.ignore_small.value_or(s.ignore_small);
  settings.pixel_threshold = arguments.pixel_threshold.value_or(settings.pixel_threshold);
}

}  // namespace whittle
