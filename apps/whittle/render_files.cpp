#include "render_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <set>
#include <utility>

#include "base/timing.h"
#include "frame_reader.h"
#include "line_files.h"
#include "progress.h"
#include "shape_files.h"
#include "statistics.h"
#include "whittle/reading.h"
#include "whittle/solid_output.h"

namespace whittle {
namespace {

/// What a PNG shows.
Picture shown(const RenderArguments& a, const Frame& frame, const Picture& picture) {
  return a.pass == Pass::kColor ? picture : pass_picture(frame, a.pass, !a.no_background);
}

Status write_all(const RenderArguments& a, const std::vector<Output>& outputs, const Frame& frame,
                 const Picture& picture) {
  for (const Output& output : outputs) {
    const Result<std::string> bytes =
        encode(std::get<FileFormat>(output.format), frame,
               output.is(FileFormat::kPng) ? shown(a, frame, picture) : picture, a.no_background,
               output.path, a.renderer.threads);
    if (!bytes) return bytes.error();
    if (Status written = write_output(output.path, *bytes); !written) return written;
  }
  return Done{};
}

Status compare_if_asked(const RenderArguments& a, const Frame& frame, const Picture& picture) {
  if (!a.reference.file) return Done{};
  return compare_with_reference(a.reference, a.file, frame,
                                a.reference.wants_picture() ? shown(a, frame, picture) : Picture(),
                                a.no_background);
}

/// Traces and shades; pictures that no output shows are not made.
Status draw(const RenderArguments& a, const std::vector<Output>& outputs, const Camera& camera,
            Renderer& renderer, Frame& frame, Picture& picture) {
  ProgressLine progress(!a.loading.quiet, "subdividing");
  if (Status prepared = renderer.prepare(camera); !prepared) return prepared;
  progress.stage("tracing");
  Result<Frame> traced = renderer.trace(camera, {.progress = progress.share()});
  if (!traced) return traced.error();
  frame = *std::move(traced);
  const bool shows_color =
      a.pass == Pass::kColor || std::ranges::any_of(outputs, [](const Output& output) {
        return output.is(FileFormat::kExr);
      });
  if (!shows_color) return Done{};
  progress.stage("shading");
  const int rays =
      a.antialias > 0 ? a.antialias : default_antialias(a.shading.style, a.shading.quality);
  Result<Picture> shaded = renderer.shade(frame, camera, a.shading, rays);
  if (!shaded) return shaded.error();
  picture = *std::move(shaded);
  return Done{};
}

Status tell_summary(const RenderArguments& a, const SummaryFacts& facts) {
  if (!a.summary.parts.empty() && !a.loading.quiet) {
    if (const std::string lines = summary_lines(facts, a.summary); !lines.empty()) say_lines(lines);
  }
  return a.summary.file ? write_output(*a.summary.file, summary_json(facts, a.summary)) : Done{};
}

/// One picture, from what was read to the files that show it. What a summary says of it goes to
/// `facts`, what --reference finds to made.
Status render(RenderArguments& a, const std::vector<Output>& outputs, const Model& model,
              const Stopwatch& watch, Made& made, SummaryFacts& facts) {
  RunTimes times{.read = watch.milliseconds()};
  Result<Renderer> renderer = Renderer::make(model, a.renderer);
  if (!renderer) return renderer.error();
  GimbalView view;
  const Camera camera = renderer->camera(a.view, &view);
  Frame frame;
  Picture picture;
  if (Status drawn = draw(a, outputs, camera, *renderer, frame, picture); !drawn) return drawn;
  say_if_nothing_is_seen(model, frame, a.loading);

  const Stopwatch writing;
  if (Status written = write_all(a, outputs, frame, picture); !written) return written;
  times.write = writing.milliseconds();
  times.total = watch.milliseconds();
  if (a.wants_statistics) {
    say_lines(statistics(model, *renderer, a.renderer.backend == Backend::kAuto, times));
  }
  if (a.summary.is_wanted())
    facts = {view,
             {.dimensions = model.drawing ? 2 : 3, .box = tight_box(model, a.renderer.threads)},
             times.total};
  made.compared = compare_if_asked(a, frame, picture);
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
  const Result<Read> read = load(a.file, loading);
  if (!read) return read.error();
  std::vector<std::string> paths;
  for (const Output& output : outputs) paths.push_back(output.path);
  LineSettings lines = a.lines;
  lines.scale = a.scale.value_or(1);
  const Status drawn = write_line_files(
      read->model, paths, {a.view, lines, a.renderer.threads, a.loading.quiet, a.wants_statistics});
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
    if (Status done = render(a, pictures, read->model, watch, made, facts); !done) return done;
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
  FrameReader reader(a.file, read_options(a.loading), times);
  std::set<std::string> said;
  for (size_t i = 0; i < times.size(); ++i) {
    const Stopwatch watch;
    Result<Read> read = reader.next();
    if (!read) {
      return Error{read.error().kind, fmt::format("{} ($t = {})", read.error().message, times[i])};
    }
    // Each warning once.
    std::erase_if(read->warnings,
                  [&](const std::string& warning) { return !said.insert(warning).second; });
    if (Status fit = say_warnings(*read, a.loading); !fit) return fit;
    std::vector<Output> frame = outputs;
    for (Output& output : frame) {
      output.path = frame_output(a, output.path, animation.first() + int(i));
    }
    SummaryFacts facts;
    if (Status done = render(a, frame, read->model, watch, made, facts); !done) return done;
    if (a.summary.is_wanted()) {
      if (Status done = tell_summary(a, facts); !done) return done;
    }
    made.add(frame, *read);
    if (made.code == kExitDone) made.code = code_for(*read, a.loading, "picture");
  }
  return Done{};
}

}  // namespace whittle
