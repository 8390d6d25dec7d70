#include "statistics.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <array>
#include <iterator>

#include "model/section.h"

namespace whittle {
namespace {

constexpr std::array kKindNames = {"nodes",        "empty",  "full",     "ignored", "conjunctions",
                                   "disjunctions", "tables", "programs", "open"};
static_assert(kKindNames.size() == kCellKinds);

using Lines = std::back_insert_iterator<std::string>;

void add_cells(Lines out, const CellTree& cells) {
  const SubdivideStats s = statistics_of(cells);
  const uint64_t count = s.cell_count();
  fmt::format_to(out, "cells         {:>12}   depth {}, {} operands classified, {}\n", count,
                 s.depth, s.classified, describe_bytes(s.memory_bytes));
  for (size_t kind = 0; kind < kKindNames.size(); ++kind) {
    if (s.cells[kind] == 0) continue;
    fmt::format_to(out, "  {:<12}{:>12}   {:5.1f} %\n", kKindNames[kind], s.cells[kind],
                   100 * double(s.cells[kind]) / double(count));
  }
  fmt::format_to(out, "leaves        {:>12}   by half-spaces:", s.leaf_count());
  // The tail is long and thin.
  constexpr size_t kShown = 12;
  uint64_t more = 0;
  for (size_t size = 0; size < s.leaves_by_size.size(); ++size) {
    if (size > kShown)
      more += s.leaves_by_size[size];
    else if (s.leaves_by_size[size] != 0)
      fmt::format_to(out, " {}: {}", size, s.leaves_by_size[size]);
  }
  if (more != 0) fmt::format_to(out, " >{}: {}", kShown, more);
  fmt::format_to(out, "\n");
}

void add_rays(Lines out, const TraceStats& s) {
  const double rays = s.rays == 0 ? 1 : double(s.rays);
  fmt::format_to(out,
                 "rays          {:>12}   {:.2f} cells, {:.2f} leaves, {:.2f} half-spaces a ray\n"
                 "disagreements {:>12}\n",
                 s.rays, double(s.cells) / rays, double(s.leaves) / rays, double(s.literals) / rays,
                 s.disagreements);
}

void add_drawing(Lines out, const RasterStats& s) {
  const uint64_t drawn = s.drawn_first + s.drawn_second;
  fmt::format_to(out,
                 "drawn         {:>12}   of {} cells in view, {} of them because others did not "
                 "hide them; {} calls\n"
                 "device (ms)   {:>12.1f}   draw {:.1f}, resolve {:.1f}; sorted in {:.1f}\n",
                 drawn, s.in_view, s.drawn_second, s.draws, s.draw_ms + s.resolve_ms, s.draw_ms,
                 s.resolve_ms, s.order_ms);
  if (s.in_doubt > 0)
    fmt::format_to(out, "in doubt      {:>12}   pixels with floats; looked at again in {:.1f} ms\n",
                   s.in_doubt, s.second_ms);
}

}  // namespace

size_t peak_memory_bytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  constexpr size_t kUnit = 1024;  // Linux counts in kibibytes.
  return size_t(usage.ru_maxrss) * kUnit;
}

std::string describe_bytes(size_t bytes) {
  double value = double(bytes);
  const char* unit = "bytes";
  for (const char* larger : {"KiB", "MiB", "GiB"}) {
    if (value < 1024) break;
    value /= 1024;
    unit = larger;
  }
  return fmt::format("{:.{}f} {}", value, unit[0] == 'b' ? 0 : 1, unit);
}

std::string statistics(const Model& model, const Renderer& renderer, bool is_auto,
                       const RunTimes& times) {
  std::string text;
  Lines out = std::back_inserter(text);
  fmt::format_to(out, "backend       {:>12}{}\n", name_of(backend_choices(), renderer.backend()),
                 is_auto ? "   (auto)" : "");
  if (!renderer.backend_note().empty())
    fmt::format_to(out, "device                       {}\n", renderer.backend_note());
  fmt::format_to(out, "nodes         {:>12}\n", model.nodes.size());
  fmt::format_to(out, "primitives    {:>12}   of {} statements\n", model.primitives.size(),
                 written_statements(model));
  if (const Scene* scene = renderer.scene()) {
    fmt::format_to(out, "half-spaces   {:>12}   of {} faces, {} merged\n",
                   scene->half_spaces.size(), scene->faces.size(),
                   scene->faces.size() - scene->half_spaces.size());
  }
  if (const CellTree* cells = renderer.cells()) {
    add_cells(out, *cells);
    if (const RasterTracer* raster = renderer.raster_tracer())
      add_drawing(out, raster->stats());
    else if (const CpuTracer* cpu = renderer.cpu_tracer())
      add_rays(out, cpu->stats());
  }
  const StageTimes& s = renderer.times();
  fmt::format_to(
      out,
      "time (ms)     {:>12.1f}   read {:.1f}, lower {:.1f}, frame {:.1f}, subdivide {:.1f}, "
      "trace {:.1f}, shade {:.1f}, write {:.1f}\n",
      times.total, times.read, s.lower, s.frame, s.subdivide, s.trace, s.shade, times.write);
  fmt::format_to(out, "memory        {:>12}   at most", describe_bytes(peak_memory_bytes()));
  return text;
}

}  // namespace whittle
