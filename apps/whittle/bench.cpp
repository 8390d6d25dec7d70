// whittle bench FILE...: what every stage costs, once its picture is known to be right.
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/printable.h"
#include "base/timing.h"
#include "base/workers.h"
#include "command_line.h"
#include "commands.h"
#include "console.h"
#include "option_group.h"
#include "oracle_check.h"
#include "orbit.h"
#include "statistics.h"
#include "trace/oracle/oracle.h"
#include "trace/vulkan/raster.h"
#include "whittle/output.h"

namespace whittle {
namespace {

using Json = nlohmann::ordered_json;
constexpr CommandHelp kHelp = {
    "whittle bench",
    "Measures every stage: the median milliseconds of parse, lower, subdivide (all\n"
    "cells), trace (with its cells there), shade, and cold: from the lowered model to\n"
    "the finished picture (cells made where rays come, trace, and shading without\n"
    "antialiasing); and of file: from the file to a finished PNG in memory, as\n"
    "'whittle FILE' makes it. The picture is compared with the oracle's; if it is\n"
    "wrong, no measurement is told. (Of more than 50000 primitives the oracle is not\n"
    "asked.)",
    "FILE... [options]",
    "Examples:\n"
    "  whittle bench examples/cheese1000.csg\n"
    "  whittle bench a.csg b.csg --imgsize 1024,1024 --repeat 15 --json\n\n"
    "Exit codes: 0 done, 1 bad input or a wrong picture, 2 bad usage, 3 refused by\n"
    "the machine."};

struct BenchArguments {
  std::vector<std::string> files;
  int repeat = 5;
  int orbit = 0;  ///< steps
  bool wants_json = false;
  Loading loading;
  ViewOptions view;
  RendererSettings renderer;
  SubdivisionArguments subdivision;
};

/// What is measured of the backend that draws cells, and of no other: the paper's quantities
/// (section 4.1) and what they are compared with.
struct RasterTimes {
  std::vector<double> set_up, render, stream, in_turn, send, first;
  RasterStats streamed, rendered;

  bool are_there() const { return !render.empty(); }

  /// All cells have just been made.
  Status measure_in_turn(Renderer& renderer, const Camera& camera) {
    RasterTracer* const raster = renderer.raster_tracer();
    if (raster == nullptr) return Done{};
    const StageTimes& times = renderer.times();
    if (const Result<Frame> frame = renderer.trace(camera); !frame) return frame.error();
    send.push_back(times.send);
    in_turn.push_back(times.subdivide + times.send + times.trace);
    if (const Result<Frame> frame = renderer.trace(camera); !frame) return frame.error();
    render.push_back(times.trace);
    rendered = raster->stats();
    const Stopwatch watch;
    raster->set_up(camera);
    set_up.push_back(watch.milliseconds());
    return raster->status();
  }

  /// A picture has just been made of cells that were not there: it took so long.
  void note_stream(Renderer& renderer, double milliseconds) {
    RasterTracer* const raster = renderer.raster_tracer();
    if (raster == nullptr) return;
    stream.push_back(milliseconds);
    streamed = raster->stats();
    first.push_back(streamed.first_ms);
  }

  void tell(const std::vector<double>& subdivide, Json& json) const {
    json["paper_ms"] = {{"S", median(subdivide)},
                        {"T_S", median(set_up)},
                        {"T_R", median(render)},
                        {"S_R", median(stream)}};
    json["send_ms"] = median(send);
    json["in_turn_ms"] = median(in_turn);
    json["stream_first_ms"] = median(first);
    json["stream_batches"] = streamed.batches;
    json["stream_cells"] = streamed.cells;
    json["order_ms"] = rendered.order_ms;
    json["draw_ms"] = rendered.draw_ms;
    json["resolve_ms"] = rendered.resolve_ms;
  }
};

/// Looks at a coarse grid of places with the tracer to be measured and with the oracle. What is to
/// be ignored is no mistake but is counted; what is left must be right.
Status check(const std::string& file, const Model& model, const Camera& camera, Renderer& renderer,
             RendererSettings settings, Json& json) {
  // What lies on what, the oracle finds out by holding every two surfaces together.
  constexpr size_t kMostForOracle = 50'000;
  OracleCheck check;
  if (model.primitives.size() <= kMostForOracle) {
    const auto oracle = make_oracle_tracer(model);
    check = check_against_oracle(renderer.tracer(), *oracle, camera);
    if (settings.subdivide.ignore_small) {
      json["lost_to_ignored_cells"] = check.wrong;
      settings.subdivide.ignore_small = false;
      Result<Renderer> whole = Renderer::make(model, settings);
      if (!whole) return whole.error();
      if (Status done = whole->prepare(camera); !done) return done;
      check = check_against_oracle(whole->tracer(), *oracle, camera);
    }
  }
  json["checked"] = check.certain;
  json["ambiguous"] = check.ambiguous;
  json["wrong"] = check.wrong;
  if (check.wrong == 0) return Done{};
  return Error{ErrorKind::kInput,
               fmt::format("{}: error: the picture is wrong at {} of {} places, so no "
                           "measurement is told: {}",
                           file, check.wrong, check.certain, check.first)};
}

/// Milliseconds from the file to the bytes of its picture, with the look that it has if nobody asks
/// for another. All is given back afterwards, which does not count.
Result<double> measure_file(const std::string& file, const BenchArguments& a) {
  const Stopwatch watch;
  const Result<Read> read = read_file(file, read_options(a.loading));
  if (!read) return read.error();
  Result<Renderer> renderer = Renderer::make(read->model, a.renderer);
  if (!renderer) return renderer.error();
  const ShadeSettings look;
  ViewOptions view = a.view;
  view.tight = frames_tightly(look.style);
  const Camera camera = renderer->camera(view);
  if (Status prepared = renderer->prepare(camera); !prepared) return prepared.error();
  const Result<Frame> frame = renderer->trace(camera);
  if (!frame) return frame.error();
  const Result<Picture> picture =
      renderer->shade(*frame, camera, look, default_antialias(look.style, look.quality));
  if (!picture) return picture.error();
  const Result<std::string> bytes =
      encode(FileFormat::kPng, *frame, *picture, false, file, a.renderer.threads);
  if (!bytes) return bytes.error();
  return watch.milliseconds();
}

Result<Json> measure(const std::string& file, const BenchArguments& a) {
  Json json;
  json["file"] = file;
  std::vector<double> parse, lower, subdivide, trace, shade, cold;
  std::optional<Read> read;
  for (int i = 0; i < a.repeat; ++i) {
    read.reset();
    const Stopwatch watch;
    Result<Read> again = with_limit_option(read_file(file, read_options(a.loading)));
    parse.push_back(watch.milliseconds());
    if (!again) return again.error();
    read = *std::move(again);
  }
  if (Status fit = say_warnings(*read, a.loading); !fit) return fit.error();

  std::vector<double> whole;
  for (int i = 0; i < a.repeat; ++i) {
    const Result<double> milliseconds = measure_file(file, a);
    if (!milliseconds) return milliseconds.error();
    whole.push_back(*milliseconds);
  }

  std::optional<Renderer> renderer;
  for (int i = 0; i < a.repeat; ++i) {
    renderer.reset();
    Result<Renderer> again = Renderer::make(read->model, a.renderer);
    if (!again) return again.error();
    renderer = *std::move(again);
    lower.push_back(renderer->times().lower);
  }
  const Camera camera = renderer->camera(a.view);
  if (Status prepared = renderer->prepare(camera); !prepared) return prepared.error();
  if (renderer->raster_tracer() != nullptr) {
    // Shaders are compiled when they are first used.
    if (const Result<Frame> first = renderer->trace(camera); !first) return first.error();
  }
  TraceStats stats;
  SubdivideStats cells, looked_at;
  const auto statistics = [&] {
    return renderer->cells() != nullptr ? statistics_of(*renderer->cells()) : SubdivideStats{};
  };
  RasterTimes raster_times;
  for (int i = 0; i < a.repeat; ++i) {
    renderer->discard();
    if (Status done = renderer->prepare(camera, Refine::kAll); !done) return done.error();
    subdivide.push_back(renderer->times().subdivide);
    cells = statistics();
    if (Status done = raster_times.measure_in_turn(*renderer, camera); !done) return done.error();

    // To free the old cells is no part of any stage.
    renderer->discard();
    const Stopwatch watch;
    if (Status prepared = renderer->prepare(camera); !prepared) return prepared.error();
    const Result<Frame> frame = renderer->trace(camera);
    if (!frame) return frame.error();
    raster_times.note_stream(*renderer, watch.milliseconds());
    ShadeSettings plain;
    plain.style = Style::kPlain;
    const Result<Picture> picture = renderer->shade(*frame, camera, plain, 1);
    if (!picture) return picture.error();
    cold.push_back(watch.milliseconds());
    shade.push_back(renderer->times().shade);
    if (const CpuTracer* const cpu = renderer->cpu_tracer()) stats = cpu->stats();
    looked_at = statistics();
    // Again, now that all the cells that it needs are there.
    if (const Result<Frame> again = renderer->trace(camera); !again) return again.error();
    trace.push_back(renderer->times().trace);
  }
  if (raster_times.are_there()) trace = raster_times.render;

  json["backend"] = name_of(backend_choices(), renderer->backend());
  json["width"] = camera.width;
  json["height"] = camera.height;
  json["threads"] = Workers(a.renderer.threads).count();
  json["repeat"] = a.repeat;
  json["parse_ms"] = median(parse);
  json["lower_ms"] = median(lower);
  json["subdivide_ms"] = median(subdivide);
  json["trace_ms"] = median(trace);
  json["shade_ms"] = median(shade);
  json["cold_ms"] = median(cold);
  json["file_ms"] = median(whole);
  json["peak_memory_bytes"] = peak_memory_bytes();
  // The oracle has neither cells nor half-spaces, and what it does for a ray is always all.
  const Scene* scene = renderer->scene();
  const auto rays = uint64_t(camera.width) * uint64_t(camera.height);
  json["half_spaces"] = scene != nullptr ? scene->half_spaces.size() : 0;
  json["cells"] = cells.cell_count();
  json["leaves"] = cells.leaf_count();
  uint64_t leaf_literals = 0;
  for (size_t i = 0; i < cells.leaves_by_size.size(); ++i)
    leaf_literals += i * cells.leaves_by_size[i];
  json["leaf_literals"] = leaf_literals;
  json["cells_bytes"] = cells.memory_bytes;
  json["cells_looked_at"] = looked_at.cell_count();
  json["largest_leaf"] = looked_at.leaves_by_size.empty() ? 0 : looked_at.leaves_by_size.size() - 1;
  json["rays"] = rays;
  json["cell_visits_per_ray"] = double(stats.cells) / double(rays);
  json["leaf_visits_per_ray"] = double(stats.leaves) / double(rays);
  json["literals_per_ray"] = double(stats.literals) / double(rays);
  json["million_rays_per_second"] = double(rays) / median(trace) / 1000;
  if (raster_times.are_there()) {
    raster_times.tell(subdivide, json);
  } else if (scene != nullptr) {
    json["paper_ms"] = {{"S", median(subdivide)}, {"T", median(trace)}, {"cold", median(cold)}};
  }
  if (CpuTracer* const cpu = renderer->cpu_tracer()) {
    // What is left of a frame when no ray has to look for its leaf.
    cpu->record(camera);
    std::vector<double> replay;
    for (int i = 0; i < a.repeat; ++i) {
      const Stopwatch watch;
      cpu->replay(camera);
      replay.push_back(watch.milliseconds());
    }
    json["replay_ms"] = median(replay);
    json["trace_over_limit"] = median(trace) / median(replay);
  }
  // Last of all: the peak of memory and the counts above are not the oracle's, nor this look's.
  if (Status right = check(file, read->model, camera, *renderer, a.renderer, json); !right)
    return right.error();
  if (a.orbit > 0) {
    Result<Json> orbit = measure_orbit(read->model, a.renderer, camera, a.orbit);
    if (!orbit) return Error{orbit.error().kind, file + ": error: " + orbit.error().message};
    json["orbit"] = *std::move(orbit);
  }
  return json;
}

/// Measures in a process of its own, so that the peak of memory is that of this file alone. Passes
/// on what is said there; the exit code, and what was measured if it is 0.
int measure_apart(const std::string& file, const BenchArguments& a, Json& json) {
  int ends[2];
  if (::pipe(ends) != 0) {
    return report({ErrorKind::kMachine, fmt::format("no pipe: {}", std::strerror(errno))});
  }
  const pid_t child = ::fork();
  if (child == 0) {
    // An interrupted benchmark does not go on measuring.
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    ::close(ends[0]);
    ::dup2(ends[1], STDOUT_FILENO);
    int code = kExitDone;
    try {
      const Result<Json> measured = measure(file, a);
      code = measured ? print(measured->dump(-1, ' ', false, Json::error_handler_t::replace))
                      : report(measured.error());
    } catch (const std::bad_alloc&) {
      code = report({ErrorKind::kMachine, fmt::format("{}: {}", file, out_of_memory())});
    }
    ::_exit(code);
  }
  ::close(ends[1]);
  std::string text;
  char buffer[4096];
  for (ssize_t got = 0; (got = ::read(ends[0], buffer, sizeof buffer)) != 0;) {
    if (got > 0) text.append(buffer, size_t(got));
    if (got < 0 && errno != EINTR) break;
  }
  ::close(ends[0]);
  int status = 0;
  if (child < 0 || ::waitpid(child, &status, 0) != child || !WIFEXITED(status)) {
    return report({ErrorKind::kMachine, fmt::format("{}: the measurement was ended", file)});
  }
  if (WEXITSTATUS(status) == kExitDone) json = Json::parse(text);
  return WEXITSTATUS(status);
}

std::string table_of(const Json& m) {
  std::string text;
  const auto number = [&](const char* name) { return m[name].get<double>(); };
  const auto count = [&](const char* name) { return m[name].get<uint64_t>(); };
  auto out = std::back_inserter(text);
  fmt::format_to(out, "{}: {} x {}, backend {}, {} threads, median of {}\n",
                 printable(m["file"].get<std::string>()), count("width"), count("height"),
                 m["backend"].get<std::string>(), count("threads"), count("repeat"));
  for (const char* stage : {"parse", "lower", "subdivide", "trace", "shade", "cold", "file"}) {
    fmt::format_to(out, "  {:<12}{:>10.2f} ms\n", stage,
                   number(fmt::format("{}_ms", stage).c_str()));
  }
  if (m.contains("in_turn_ms")) {
    const Json& paper = m["paper_ms"];
    fmt::format_to(out,
                   "  {:<12}{:>10.2f} ms cells refined while drawn, the first after {:.2f} ms; all "
                   "before {:.2f} ms\n"
                   "  {:<12}{:>10.2f} ms without drawing\n",
                   "stream", paper["S_R"].get<double>(), number("stream_first_ms"),
                   number("in_turn_ms"), "set up", paper["T_S"].get<double>());
  }
  fmt::format_to(out, "  {:<12}{:>10}\n", "half-spaces", count("half_spaces"));
  fmt::format_to(out, "  {:<12}{:>10}    {} leaves, {}; rays met {}\n", "cells", count("cells"),
                 count("leaves"), describe_bytes(count("cells_bytes")), count("cells_looked_at"));
  fmt::format_to(out, "  {:<12}{:>10}    {:.2f} cells, {:.2f} leaves, {:.2f} half-spaces a ray\n",
                 "rays", count("rays"), number("cell_visits_per_ray"),
                 number("leaf_visits_per_ray"), number("literals_per_ray"));
  fmt::format_to(out, "  {:<12}{:>10.1f}    million a second", "trace",
                 number("million_rays_per_second"));
  if (m.contains("replay_ms")) {
    fmt::format_to(out, "; limit {:.2f} ms, {:.2f} times", number("replay_ms"),
                   number("trace_over_limit"));
  }
  text += '\n';
  fmt::format_to(out, "  {:<12}{:>10}    at most\n", "memory",
                 describe_bytes(count("peak_memory_bytes")));
  if (m.contains("orbit")) {
    const Json& orbit = m["orbit"];
    const auto value = [&](const char* name) { return orbit[name].get<double>(); };
    fmt::format_to(out,
                   "  {:<12}{:>10.2f} ms a degree, afresh {:.2f} ms; of its cells {:.2f} % are "
                   "refined, at most {:.2f} %\n",
                   "orbit", value("median_step_ms"), value("median_afresh_ms"),
                   100 * value("median_refined_share"), 100 * value("most_refined_share"));
  }
  fmt::format_to(out, "  {:<12}{:>10}    places as the oracle sees them, {} ambiguous, {} wrong\n",
                 "checked", count("checked") - count("wrong"), count("ambiguous"), count("wrong"));
  return text;
}

}  // namespace

int bench_command(Arguments arguments) {
  constexpr int kMostRepeats = 100000, kMostSteps = 100000;
  CommandLine line(kHelp);
  CLI::App& app = line.app();
  BenchArguments a;
  line.add_required("FILE", a.files);
  OptionGroup group(app, "Measurement");
  group.add_count("--repeat", "N", a.repeat, 1, kMostRepeats, "times that all is done (5)");
  group.add_count("--orbit", "N", a.orbit, 0, kMostSteps,
                  "then goes N degrees around the model, and says what each\n"
                  "takes if cells are kept, and afresh (0)");
  group.add_flag("--json", a.wants_json, "an array with one object a file");
  add_view_options(app, a.view, a.loading);
  add_loading_options(line, a.loading);
  add_machine_options(app, a.renderer, a.loading);
  add_subdivision_options(app, a.subdivision);
  if (const std::optional<int> code = line.parse(arguments)) return *code;
  if (std::ranges::find(a.files, "-") != a.files.end()) {
    return report({ErrorKind::kUsage, "standard input cannot be read again; bench wants files"});
  }
  if (Status possible = settle_device(a.renderer); !possible) return report(possible.error());
  if (Status possible = check_view(a.view); !possible) return report(possible.error());
  for (const std::string& file : a.files) {
    if (Status fits = check_loading(file, a.loading); !fits) return report(fits.error());
  }
  apply(a.subdivision, a.renderer);

  Json all = Json::array();
  for (const std::string& file : a.files) {
    Json measured;
    if (const int code = measure_apart(file, a, measured); code != kExitDone) return code;
    if (a.wants_json) {
      all.push_back(std::move(measured));
    } else if (const int code = print(table_of(measured)); code != kExitDone) {
      return code;
    }
  }
  return a.wants_json ? print(all.dump(2) + "\n") : kExitDone;
}

}  // namespace whittle
