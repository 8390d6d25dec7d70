// whittle cells FILE -o OUT.png: the cells that space is cut into, over the model.
#include <string>

#include "base/timing.h"
#include "command_line.h"
#include "commands.h"
#include "console.h"
#include "image/draw_cells.h"
#include "option_group.h"
#include "progress.h"
#include "statistics.h"
#include "whittle/output.h"

namespace whittle {
namespace {

constexpr CommandHelp kHelp = {
    "whittle cells",
    "Draws the model and over it the cells that space is cut into, as far as a surface\n"
    "is in them. Blue cells are conjunctions, green ones disjunctions, orange ones truth\n"
    "tables, violet ones programs; red cells were too small to be looked at.",
    "FILE -o OUT.png [options]",
    "Examples:\n"
    "  whittle cells part.csg -o cells.png\n"
    "  whittle cells part.csg -o cells.png --paper --pixel-threshold 5\n"
    "  whittle cells part.csg -o boxes.png --show faces --leaf-size 6\n\n"
    "Exit codes: 0 done, 1 bad input, 2 bad usage, 3 refused by the machine."};

struct CellsArguments {
  std::string file, output;
  CellView show = CellView::kEdges;
  Loading loading;
  ViewOptions view;
  ShadeSettings shading;
  bool no_background = false;
  RendererSettings renderer;
  SubdivisionArguments subdivision;
  bool wants_statistics = false;
};

void add_options(CommandLine& line, CellsArguments& a) {
  CLI::App& app = line.app();
  line.add_required("FILE", a.file);
  OptionGroup output(app, "Output"), look(app, "Look"), machine(app, "Machine");
  output.add_text("-o", "PNG", "the picture; '-': standard output", [&](const std::string& path) {
    if (path != "-") {
      const Result<FileFormat> format = format_of(path);
      if (!format || *format != FileFormat::kPng) refuse("-o", "wants a .png file");
    }
    a.output = path;
  });
  output.add_choice("--show", cell_view_choices(), "view of cells",
                    "{}; faces: front faces of the nearest\ncells, translucent",
                    [&](CellView show) { a.show = show; });
  add_view_options(app, a.view, a.loading);
  a.shading.style = Style::kPlain;
  add_style_options(app, a.shading);
  add_color_options(app, a.shading);
  add_shadow_option(app, a.shading);
  look.add_flag("--no-background", a.no_background, "what is not hit is transparent");
  add_loading_options(line, a.loading);
  add_lenient_option(app, a.loading);
  add_machine_options(app, a.renderer, a.loading);
  machine.add_flag("--stats", a.wants_statistics, "say what was done and what it cost");
  add_subdivision_options(app, a.subdivision);
}

Result<Picture> draw(const CellsArguments& a, const Model& model, Renderer& renderer) {
  ProgressLine progress(!a.loading.quiet, "subdividing");
  const Camera camera = renderer.camera(a.view);
  if (Status prepared = renderer.prepare(camera, Refine::kAll); !prepared) return prepared.error();
  progress.stage("tracing");
  const Result<Frame> frame = renderer.trace(camera, {.progress = progress.share()});
  if (!frame) return frame.error();
  progress.stage("drawing");
  Result<Picture> picture = renderer.shade(*frame, camera, a.shading,
                                           default_antialias(a.shading.style, a.shading.quality));
  if (picture) {
    say_if_nothing_is_seen(model, *frame, a.loading);
    draw_cells(*renderer.cells(), renderer.scene()->origin, camera, *frame, a.show, *picture);
  }
  return picture;
}

Result<int> run(CellsArguments& a) {
  const Stopwatch watch;
  if (a.output.empty()) return Error{ErrorKind::kUsage, "give -o FILE.png to make a picture"};
  if (a.renderer.backend == Backend::kOracle) {
    return Error{ErrorKind::kUsage, "backend oracle has no cells"};
  }
  if (Status possible = check_shadows(a.shading); !possible) return possible.error();
  if (Status possible = check_view(a.view); !possible) return possible.error();
  if (Status possible = settle_device(a.renderer); !possible) return possible.error();
  if (Status possible = check_not_input(a.output, a.file); !possible) return possible.error();
  if (Status possible = check_writable(a.output); !possible) return possible.error();
  suit_style(a.shading.style, a.loading);
  a.view.tight = frames_tightly(a.shading.style);
  const Result<Read> read = load(a.file, a.loading);
  if (!read) return read.error();
  RunTimes times{.read = watch.milliseconds()};
  apply(a.subdivision, a.renderer);
  a.shading.background = !a.no_background;
  Result<Renderer> renderer = Renderer::make(read->model, a.renderer);
  if (!renderer) return renderer.error();
  const Result<Picture> picture = draw(a, read->model, *renderer);
  if (!picture) return picture.error();
  const Stopwatch writing;
  const Result<std::string> bytes =
      encode(FileFormat::kPng, Frame(), *picture, a.no_background, a.output, a.renderer.threads);
  if (!bytes) return bytes.error();
  if (Status written = write_output(a.output, *bytes); !written) return written.error();
  times.write = writing.milliseconds();
  times.total = watch.milliseconds();
  if (a.wants_statistics) {
    say_lines(statistics(read->model, *renderer, a.renderer.backend == Backend::kAuto, times));
  }
  return code_for(*read, a.loading, "picture");
}

}  // namespace

int cells_command(Arguments arguments) {
  CommandLine line(kHelp);
  CellsArguments a;
  add_options(line, a);
  if (const std::optional<int> code = line.parse(arguments)) return *code;
  const Result<int> code = run(a);
  return code ? *code : report(code.error());
}

}  // namespace whittle
