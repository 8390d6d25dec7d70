#include "render_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <utility>

#include "base/timing.h"
#include "frame_files.h"
#include "frame_reader.h"
#include "line_files.h"
#include "progress.h"
#include "shape_files.h"
#include "statistics.h"
#include "whittle/reading.h"
#include "whittle/solid_output.h"

namespace whittle {
namespace {

Status compare_if_asked(const RenderArguments& a, const Drawn& drawn) {
  if (!a.reference.file) return Done{};
  return compare_with_reference(
      a.reference, a.file, drawn.frame,
      a.reference.wants_picture() ? shown(a, drawn.frame, drawn.picture) : Picture(),
      a.no_background);
}

/// Takes what is drawn to where it is shown.
using Show = std::function<Status(Drawn)>;

/// One picture of what was read. What a summary says of it goes to `facts`, what --reference finds
/// to made.
Status render(RenderArguments& a, const std::vector<Output>& outputs, const Model& model,
              const Stopwatch& watch, const Show& show, Made& made, SummaryFacts& facts) {
  RunTimes times{.read = watch.milliseconds()};
  Result<Renderer> renderer = Renderer::make(model, a.renderer);
  if (!renderer) return renderer.error();
  GimbalView view;
  const Camera camera = renderer->camera(a.view, &view);
  const auto draw = [&]() -> Result<Drawn> {
    ProgressLine progress(!a.loading.quiet, "subdividing");
    if (Status prepared = renderer->prepare(camera); !prepared) return prepared.error();
    return draw_picture(a, outputs, camera, *renderer, progress);
  };
  Result<Drawn> drawn = draw();
  if (!drawn) return drawn.error();
  say_of_picture(a, model, *drawn, made);
  made.compared = compare_if_asked(a, *drawn);

  const Stopwatch writing;
  if (Status shown = show(*std::move(drawn)); !shown) return shown;
  times.write = writing.milliseconds();
  times.total = watch.milliseconds();
  if (a.wants_statistics) {
    say_lines(statistics(model, *renderer, a.renderer.backend == Backend::kAuto, times));
  }
  if (a.summary.is_wanted())
    facts = {view,
             {.dimensions = model.drawing ? 2 : 3, .box = tight_box(model, a.renderer.threads)},
             times.total};
  return Done{};
}

/// The view that a picture would have, where nothing but the box is known.
GimbalView view_of_box(const RenderArguments& a, const Model& model, const Box& box) {
  const auto reach = [&](const Directions& directions) { return box_reach(box, directions); };
  return frame_view(a.view, model.view, box, reach).view;
}

/// Line drawings of a solid, as its pictures show it; its warnings were said. Adds to what a
/// summary says, which has its geometry and view already if there are files of another kind.
Status write_lines(RenderArguments& a, const std::vector<Output>& outputs, bool is_alone,
                   Made& made, SummaryFacts& facts) {
  const Stopwatch watch;
  Loading loading = a.loading;
  loading.quiet = true;
  loading.background = false;
  const Result<Read> read = load(a.file, loading);
  if (!read) return read.error();
  std::vector<std::string> paths;
  for (const Output& output : outputs) paths.push_back(output.path);
  const Status drawn = write_line_files(
      read->model, paths,
      {a.view, line_settings(a), a.renderer.threads, a.loading.quiet, a.wants_statistics});
  if (!drawn) return drawn;
  made.add(outputs, *read);
  if (made.code == kExitDone) made.code = code_for(*read, loading, "drawing");
  facts.milliseconds += watch.milliseconds();
  if (is_alone) {
    facts.geometry = {.box = tight_box(read->model, a.renderer.threads)};
    facts.view = view_of_box(a, read->model, facts.geometry.box);
  }
  return Done{};
}

/// Files of the shape; what is read has facets. Adds to what a summary says of pictures.
Status write_shapes(RenderArguments& a, const std::vector<Output>& outputs, bool has_pictures,
                    Made& made, SummaryFacts& facts) {
  const Stopwatch watch;
  Loading loading = a.loading;
  loading.curves = curves_of_shape(loading.curves);
  loading.outlines = true;
  loading.background = false;
  loading.quiet = loading.quiet || has_pictures;  // warnings were said
  const Result<Read> read = load(a.file, loading);
  if (!read) return read.error();
  // An .svg is of the view if there is one.
  std::vector<Output> shapes, lines;
  for (const Output& output : outputs) {
    const bool is_svg = output.format == ExportFormat(DrawingFormat::kSvg);
    (is_svg && !read->model.drawing ? lines : shapes).push_back(output);
  }
  if (!shapes.empty()) {
    std::vector<ShapeOutput> files;
    for (const Output& output : shapes) files.push_back({output.path, output.format});
    const Result<GeometryFacts> geometry = write_shape_files(
        read->model, files,
        {a.loading.curves, a.renderer.threads, a.loading.quiet, a.wants_statistics});
    if (!geometry) return geometry.error();
    made.add(shapes, *read);
    if (made.code == kExitDone)
      made.code = code_for(*read, loading, read->model.drawing ? "drawing" : "solid");
    facts.geometry = *geometry;
    if (!has_pictures) facts.view = view_of_box(a, read->model, geometry->box);
  }
  facts.milliseconds += watch.milliseconds();
  if (lines.empty()) return Done{};
  return write_lines(a, lines, !has_pictures && shapes.empty(), made, facts);
}

}  // namespace

void say_of_picture(const RenderArguments& a, const Model& model, const Drawn& drawn, Made& made) {
  // Whether anything is seen is said of the first picture alone.
  if (made.said.insert("seen").second) say_if_nothing_is_seen(model, drawn.frame, a.loading);
  if (!drawn.note.empty() && !a.loading.quiet && made.said.insert(drawn.note).second)
    say(fmt::format("{}: warning: {}", a.file, drawn.note));
}

void add_films(const RenderArguments& a, const std::vector<Output>& outputs, Made& made) {
  for (const Output& output : outputs)
    if (output.is_film()) made.targets.push_back(still_output(a, output.path));
}

Status tell_summary(const RenderArguments& a, const SummaryFacts& facts) {
  if (!a.summary.parts.empty() && !a.loading.quiet) {
    if (const std::string lines = summary_lines(facts, a.summary); !lines.empty()) say_lines(lines);
  }
  return a.summary.file ? write_output(*a.summary.file, summary_json(facts, a.summary)) : Done{};
}

Status render_still(RenderArguments& a, const std::vector<Output>& outputs, Made& made) {
  std::vector<Output> pictures, shapes;
  for (const Output& output : outputs) (output.is_picture() ? pictures : shapes).push_back(output);
  // What has facets is read on its own.
  if (!shapes.empty()) a.loading.standard_input = std::make_shared<std::optional<std::string>>();
  SummaryFacts facts;
  if (!pictures.empty() || a.reference.file) {
    const Stopwatch watch;
    const Result<Read> read = load(a.file, a.loading);
    if (!read) return read.error();
    const Show show = [&](const Drawn& drawn) { return write_pictures(a, pictures, drawn); };
    if (Status done = render(a, pictures, read->model, watch, show, made, facts); !done)
      return done;
    made.add(pictures, *read);
    made.code = code_for(*read, a.loading, "picture");
  }
  if (!shapes.empty()) {
    if (Status done = write_shapes(a, shapes, !pictures.empty(), made, facts); !done) return done;
  }
  return a.summary.is_wanted() ? tell_summary(a, facts) : Done{};
}

Status render_frames(RenderArguments& a, const std::vector<Output>& outputs, Made& made) {
  const Animation& animation = a.openscad.animation;
  std::vector<double> times;
  for (int i = animation.first(); i < animation.last(); ++i) {
    times.push_back(double(i) / animation.frames);
  }
  FrameFiles files(a, outputs, int(times.size()));
  if (Status opened = files.open(); !opened) return opened;
  FrameReader reader(a.file, read_options(a.loading), times);
  for (size_t i = 0; i < times.size(); ++i) {
    const Stopwatch watch;
    Result<Read> read = reader.next();
    if (!read) {
      return Error{read.error().kind, fmt::format("{} ($t = {})", read.error().message, times[i])};
    }
    // Each warning once.
    std::erase_if(read->warnings,
                  [&](const std::string& warning) { return !made.said.insert(warning).second; });
    if (Status fit = say_warnings(*read, a.loading); !fit) return fit;
    if (Status opened = open_if_asked(a.loading.section, read->model); !opened) return opened;
    const int number = animation.first() + int(i);
    const Show show = [&](Drawn drawn) { return files.add(number, std::move(drawn)); };
    SummaryFacts facts;
    if (Status done = render(a, outputs, read->model, watch, show, made, facts); !done) return done;
    if (a.summary.is_wanted()) {
      if (Status done = tell_summary(a, facts); !done) return done;
    }
    made.add(outputs_of_frame(a, outputs, number), *read);
    if (made.code == kExitDone) made.code = code_for(*read, a.loading, "picture");
  }
  if (Status done = files.finish(); !done) return done;
  add_films(a, outputs, made);
  return Done{};
}

}  // namespace whittle
