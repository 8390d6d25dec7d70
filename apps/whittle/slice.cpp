// whittle slice FILE --z 0:0.2:40 -o layers.svg: layers, for printers and cutters.
#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "command_line.h"
#include "commands.h"
#include "console.h"
#include "option_group.h"
#include "output_template.h"
#include "slice/layer_heights.h"
#include "slice_files.h"
#include "whittle/export_format.h"
#include "whittle/output.h"
#include "whittle/solid_output.h"

namespace whittle {
namespace {

constexpr CommandHelp kHelp = {
    "whittle slice",
    "Cuts a solid into layers: one .svg with a group a layer, for cutters, or a .png a\n"
    "layer, white where the solid is, for resin printers. A layer is the section just\n"
    "above its height. Curves have facets, as in files of solids.",
    "FILE --z HEIGHTS -o OUT [options]",
    "Examples:\n"
    "  whittle slice part.csg --z 0.1:0.2:40 -o layers.svg\n"
    "  whittle slice part.csg --z 0:0.05:30 -o 'layers/{n}.png' --imgsize 1440,2560 \\\n"
    "      --pixel-size 0.05\n"
    "  whittle slice part.csg --z 5,12.5 -o sections.svg\n\n"
    "Exit codes: 0 done, 1 bad input, or something in FILE is not shown (--lenient: 0),\n"
    "2 bad usage, 3 refused by the machine."};

struct SliceArguments {
  std::string file, output;
  std::vector<double> heights;
  std::optional<std::pair<int, int>> size;
  double pixel = 0;
  int threads = 0;
  Loading loading;
};

void add_options(CommandLine& line, SliceArguments& a) {
  CLI::App& app = line.app();
  line.add_required("FILE", a.file);
  OptionGroup output(app, "Output");
  output.add_text("--z", "HEIGHTS",
                  "numbers and ranges start:step:end, as in 0:0.2:40,\n"
                  "separated by commas, mm",
                  [&](const std::string& text) {
                    Result<std::vector<double>> heights = parse_heights(text);
                    if (!heights) refuse("--z", heights.error().message);
                    a.heights = *std::move(heights);
                  });
  output.add_text("-o", "OUT",
                  "an .svg, or .png files: '{n}.png'; {n} is the number of\n"
                  "the layer from 00000, {name} that of FILE",
                  [&](const std::string& path) { a.output = path; });
  OptionGroup pictures(app, "Pictures");
  add_size_option(pictures, [&](int width, int height) { a.size = {width, height}; });
  pictures.add_text("--pixel-size", "MM", "a pixel's side; else the solid's box fits the picture",
                    [&](const std::string& text) {
                      a.pixel = parse_number("--pixel-size", text);
                      if (a.pixel > 0) return;
                      refuse("--pixel-size", fmt::format("wants a number above 0, not {}", text));
                    });
  OptionGroup(app, "Machine")
      .add_count("--threads", "N", a.threads, 0, kMostThreads,
                 "0 (all) to 1024; the layers are the same");
  a.loading.threads = &a.threads;
  add_loading_options(line, a.loading);
  add_lenient_option(app, a.loading);
  add_section_options(app, a.loading.section);
}

/// Which files there will be. Fails at once where writing them would fail after the work.
Status settle_output(const SliceArguments& a, SliceSettings& settings) {
  const auto refused = [](const std::string& why) { return Error{ErrorKind::kUsage, why}; };
  const Result<ExportFormat> format = export_format_of(a.output);
  settings.is_svg = format && *format == ExportFormat(DrawingFormat::kSvg);
  if (!settings.is_svg && !(format && *format == ExportFormat(FileFormat::kPng)))
    return refused(fmt::format("-o wants an .svg or .png file, not '{}'", a.output));
  if (settings.is_svg && (a.size || a.pixel > 0))
    return refused("--imgsize and --pixel-size are for .png; an .svg is in millimetres");
  if (settings.is_svg && has_word(a.output, "n"))
    return refused(fmt::format("-o '{}': an .svg holds all layers; {{n}} is for .png", a.output));
  const size_t files = settings.is_svg ? 1 : a.heights.size();
  if (files > 1 && !has_word(a.output, "n")) {
    return refused(
        fmt::format("there are {} layers and one -o {}; with {{n}} in it, as in "
                    "'{{n}}.png', each has its own",
                    files, a.output));
  }
  for (size_t i = 0; i < files; ++i) {
    const Result<std::string> path =
        fill_template(a.output, {template_name(a.file), fmt::format("{:05}", i)});
    if (!path) return refused("-o " + path.error().message);
    if (Status possible = check_not_input(*path, a.file); !possible) return possible;
    // To try all would take long, and they are usually in one folder.
    if (i == 0 || i + 1 == files) {
      if (Status possible = check_writable(*path); !possible) return possible;
    }
    settings.paths.push_back(*path);
  }
  return Done{};
}

}  // namespace

int slice_command(Arguments arguments) {
  CommandLine line(kHelp);
  SliceArguments a;
  add_options(line, a);
  if (const std::optional<int> code = line.parse(arguments)) return *code;
  if (a.heights.empty())
    return report({ErrorKind::kUsage, "--z is required: the layers' heights, as in 0:0.2:40"});
  if (a.output.empty()) return report({ErrorKind::kUsage, "-o is required: an .svg, or '{n}.png'"});

  const ViewOptions usual;
  const auto [width, height] = a.size.value_or(std::pair(usual.width, usual.height));
  SliceSettings settings{.heights = a.heights,
                         .width = width,
                         .height = height,
                         .pixel = a.pixel,
                         .curves = a.loading.curves,
                         .threads = a.threads,
                         .quiet = a.loading.quiet};
  if (Status possible = settle_output(a, settings); !possible) return report(possible.error());
  a.loading.curves = curves_of_shape(a.loading.curves);
  const Result<Read> read = load(a.file, a.loading);
  if (!read) return report(read.error());
  if (Status written = write_slices(read->model, settings); !written)
    return report(written.error());
  return code_for(*read, a.loading, "stack of layers");
}

}  // namespace whittle
