// whittle FILE -o OUT: makes pictures of a model.
#include <string>
#include <vector>

#include "commands.h"
#include "console.h"
#include "film_files.h"
#include "ghost_options.h"
#include "host/dependencies.h"
#include "many_files.h"
#include "render_arguments.h"
#include "render_files.h"
#include "sheet_files.h"
#include "window/show_window.h"

namespace whittle {
namespace {

constexpr CommandHelp kHelp = {
    "whittle", "Exact pictures of Constructive Solid Geometry, from OpenSCAD files.",
    "FILE -o OUT [options]      makes a picture, or a file to print or cut (the default)\n"
    "       whittle FILE... -o '{name}.png'    draws many files, several at a time\n"
    "       whittle FILE...                    opens a window that shows it (H: its keys)\n"
    "       whittle info FILE                  says what is in a file\n"
    "       whittle pick FILE --at X,Y         says what is seen at a place\n"
    "       whittle measure FILE --at X,Y ...  measures where one points\n"
    "       whittle cast FILE X,Y,Z DX,DY,DZ   says what rays meet\n"
    "       whittle slice FILE --z Z -o OUT    cuts a solid into layers\n"
    "       whittle edit FILE --set PLACE=V    changes values in a .csg, and nothing else\n"
    "       whittle params FILE.scad           lists what a program offers to be set\n"
    "       whittle cells FILE -o OUT.png      draws the cells over the model\n"
    "       whittle compare A.exr B.exr        compares the facts of two pictures\n"
    "       whittle bench FILE...              measures every stage\n"
    "       whittle model NAME [N] [-o OUT]    writes a model made to measure\n"
    "       whittle devices                    lists Vulkan's devices\n\n"
    "FILE is .csg, or .scad if openscad is installed, or what import() reads (.stl,\n"
    ".off, .obj, .3mf, .amf, .svg, .dxf); '-' is standard input, as .csg. Each command\n"
    "has its own --help. A file that is called like a command is ./info.",
    "Examples:\n"
    "  whittle part.csg -o part.png\n"
    "  whittle part.csg -o part.png -o facts.exr --imgsize 1920,1080\n"
    "  whittle part.csg -o top.png --camera 0,0,0,0,0,0,200 --projection ortho\n"
    "  whittle part.csg -o part.stl\n"
    "  whittle part.csg --views front,right,top,iso -o sheet.png\n"
    "  whittle part.csg --turntable 72 -o part.gif\n"
    "  whittle *.csg -o 'pictures/{name}.png'\n"
    "  whittle part.csg -o part.svg --projection ortho --hidden-lines\n"
    "  openscad -o - --export-format csg part.scad | whittle - -o part.png\n\n"
    "  whittle part.scad -o lid.png -D 'part=\"lid\"'\n\n"
    "Exit codes: 0 done, 1 bad input, or something in it is not shown (--lenient: 0),\n"
    "2 bad usage, 3 refused by the machine (device, memory, disk).\n\n"
    "OpenSCAD's --render and --preview decide $preview of a .scad. --backend Manifold or\n"
    "CGAL, --csglimit, --debug, --check-parameters and --check-parameter-ranges change\n"
    "no picture. --preview also draws what % and # mark. Other views (--view) are refused."};

/// One file. The outputs are templates.
Result<int> run_one(RenderArguments& a, std::vector<Output> outputs) {
  const auto fill = [&](std::string& path) { path = still_output(a, path); };
  const bool has_templates = a.moves() || !a.sheet.views.empty();
  for (Output& output : outputs)
    if (!has_templates) fill(output.path);
  if (a.openscad.dependency_file) fill(*a.openscad.dependency_file);
  if (a.summary.file) fill(*a.summary.file);
  if (a.reference.file) fill(*a.reference.file);
  if (a.reference.difference) fill(*a.reference.difference);
  if (Status possible = check_possible(a, outputs); !possible) return possible.error();
  Made made;
  Status done = a.film.turntable > 0     ? render_turntable(a, outputs, made)
                : a.moves()              ? render_frames(a, outputs, made)
                : !a.sheet.views.empty() ? render_views(a, outputs, made)
                                         : render_still(a, outputs, made);
  if (done && a.openscad.dependency_file) {
    done = write_output(*a.openscad.dependency_file, write_dependencies(made.targets, made.files));
  }
  if (!done) return done.error();
  if (!made.compared) return made.compared.error();
  return made.code;
}

int run_many(const RenderArguments& all, const std::vector<Output>& outputs) {
  // A device serves one tracer at a time, and to open it for each file takes longer than a file.
  const bool on_device = all.renderer.backend == Backend::kVulkanRaster;
  const ManyFiles many{all.files, all.renderer.threads, on_device, all.loading.quiet};
  const auto draw = [&](size_t file, int threads) {
    RenderArguments a = all;
    a.file = all.files[file];
    if (a.renderer.backend == Backend::kAuto) a.renderer.backend = Backend::kCpu;
    a.renderer.threads = threads;
    a.loading.threads = &a.renderer.threads;
    const Result<int> code = run_one(a, outputs);
    return code ? *code : report(code.error());
  };
  return draw_all(many, draw);
}

Result<int> run(RenderArguments& a, Arguments arguments) {
  if (a.outputs.empty() && !a.reference.file) {
    if (Status possible = settle_device(a.renderer); !possible) return possible.error();
    apply(a.subdivision, a.renderer);
    return show_window(a, arguments);
  }
  const Result<std::vector<Output>> outputs = choose_outputs(a);
  if (!outputs) return outputs.error();
  if (Status possible = settle_device(a.renderer); !possible) return possible.error();
  if (Status possible = check_templates(a.files, templates_of(a, *outputs), a.moves(),
                                        a.view.named || !a.sheet.views.empty());
      !possible)
    return possible.error();
  suit_style(a.shading.style, a.loading);
  if (Status possible = settle_ghosts(a); !possible) return possible.error();
  a.view.tight = frames_tightly(a.shading.style);
  apply(a.subdivision, a.renderer);
  a.shading.background = !a.no_background;
  if (a.files.size() > 1) return run_many(a, *outputs);
  a.file = a.files[0];
  return run_one(a, *outputs);
}

}  // namespace

int render_command(Arguments arguments) {
  CommandLine line(kHelp);
  RenderArguments a;
  add_options(line, a);
  if (const std::optional<int> code = line.parse(arguments)) return *code;
  const Result<int> code = run(a, arguments);
  return code ? *code : report(code.error());
}

}  // namespace whittle
