#include "film_files.h"

#include <fmt/format.h>

#include <utility>

#include "base/timing.h"
#include "frame_files.h"
#include "statistics.h"
#include "whittle/reading.h"

namespace whittle {

Status render_turntable(RenderArguments& a, const std::vector<Output>& outputs, Made& made) {
  const Stopwatch watch;
  const Result<Read> read = load(a.file, a.loading);
  if (!read) return read.error();
  RunTimes times{.read = watch.milliseconds()};
  Result<Renderer> renderer = Renderer::make(read->model, a.renderer);
  if (!renderer) return renderer.error();
  GimbalView view;
  const Turntable table = renderer->turntable(a.view, &view);
  const int frames = a.film.turntable;
  FrameFiles files(a, outputs, frames);
  if (Status opened = files.open(); !opened) return opened;
  ProgressLine progress(!a.loading.quiet, "subdividing");
  if (Status prepared = renderer->prepare(table.first); !prepared) return prepared;
  const Stopwatch filming;
  for (int frame = 0; frame < frames; ++frame) {
    Result<Drawn> drawn = draw_picture(a, outputs, table.at(frame, frames), *renderer, progress);
    if (!drawn) return drawn.error();
    progress.without_line([&] { say_of_picture(a, read->model, *drawn, made); });
    made.add(outputs_of_frame(a, outputs, frame), *read);
    if (Status added = files.add(frame, *std::move(drawn)); !added) return added;
  }
  const Stopwatch writing;
  if (Status done = files.finish(); !done) return done;
  add_films(a, outputs, made);
  times.write = writing.milliseconds();
  times.total = watch.milliseconds();
  const double seconds = filming.milliseconds() / 1000;
  if (a.wants_statistics) {
    progress.without_line([&] {
      say_lines(
          statistics(read->model, *renderer, a.renderer.backend == Backend::kAuto, times) +
          fmt::format("\nframes        {:>12}   {:.1f} a second\n", frames, frames / seconds));
    });
  }
  made.code = code_for(*read, a.loading, "picture");
  if (!a.summary.is_wanted()) return Done{};
  return tell_summary(a, {view,
                          {.dimensions = read->model.drawing ? 2 : 3,
                           .box = tight_box(read->model, a.renderer.threads)},
                          times.total});
}

}  // namespace whittle
