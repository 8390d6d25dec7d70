// Solids and renderings of the public API, in terms of the stages.
#include "whittle/whittle.h"

#include <cstddef>
#include <utility>

#include "host/read_file.h"
#include "model/section.h"
#include "whittle/api.h"
#include "whittle/output.h"
#include "whittle/reading.h"
#include "whittle/renderer.h"

namespace whittle {
namespace {

ReadOptions reading_of(const LoadOptions& o) {
  return {.curves = curves_in_style(o.style, o.curves),
          .polish = o.polish_matrices,
          .threads = threads_of(o.threads),
          .limits = o.limits,
          .outlines = has_outlines(curves_in_style(o.style, o.curves)),
          .solid_box = box_maker(threads_of(o.threads)),
          .closed_mesh = mesh_maker(threads_of(o.threads))};
}

}  // namespace

int threads_of(int threads) {
  if (threads < 0 || threads > kMostThreads)
    refuse("threads must be 0 to " + std::to_string(kMostThreads));
  return threads;
}

Solid::Solid(std::shared_ptr<const State> state) : state_(std::move(state)) {}

Solid Solid::load(const std::string& path, const LoadOptions& options) {
  Read read = value_of(read_file(path, {.reading = reading_of(options)}));
  return Solid(std::make_shared<const State>(std::move(read.model), std::move(read.warnings),
                                             !read.unsupported, options.style));
}

Solid Solid::parse(std::string_view text, const std::string& name, const LoadOptions& options) {
  Read read = value_of(read_csg(text, name, reading_of(options)));
  return Solid(std::make_shared<const State>(std::move(read.model), std::move(read.warnings),
                                             !read.unsupported, options.style));
}

const std::vector<std::string>& Solid::warnings() const {
  return state_->warnings;
}

bool Solid::is_complete() const {
  return state_->is_complete;
}

std::uint32_t Solid::statement_count() const {
  return written_statements(state_->model);
}

std::optional<Place> Solid::place(std::uint32_t id) const {
  const State& s = *state_;
  std::call_once(s.places_once, [&] { s.places = statement_places(s.model); });
  if (id >= s.places.size() || s.places[id] == SourceLocation{}) return std::nullopt;
  return Place{s.places[id].line, s.places[id].column};
}

std::optional<std::array<Point, 2>> Solid::bounds() const {
  const Bounds& b = state_->bounds;
  if (!b.bounded || b.box.is_empty()) return std::nullopt;
  const Box box = seen_box(state_->model, b.box);
  return std::array<Point, 2>{to_point(box.lo), to_point(box.hi)};
}

Solid Solid::cut_open(const std::vector<std::vector<CuttingPlane>>& sections,
                      const std::vector<std::array<float, 3>>& kept) const {
  std::vector<Section> cuts;
  for (const std::vector<CuttingPlane>& section : sections) {
    Section cut;
    for (const CuttingPlane& plane : section)
      cut.planes.push_back(value_of(cutting_plane(to_vec3(plane.normal), plane.offset)));
    cuts.push_back(std::move(cut));
  }
  std::vector<Rgba> colors;
  for (const std::array<float, 3>& color : kept)
    colors.push_back({color[0], color[1], color[2], 1});
  const State& s = *state_;
  return Solid(std::make_shared<const State>(value_of(whittle::cut_open(s.model, cuts, colors)),
                                             s.warnings, s.is_complete, s.style));
}

Rendering Solid::render(const RenderOptions& options, const SessionOptions& session) const {
  return Session(*this, session).render(options);
}

void Rendering::write(const std::string& path) const {
  const FileFormat format = value_of(format_of(path));
  value_of(check_picture_size(width, height));
  const size_t pixels = size_t(width) * size_t(height);
  if (rgba.size() != 4 * pixels || distance.size() != pixels || normal.size() != 3 * pixels ||
      id.size() != pixels) {
    refuse("a rendering must have an entry for each of its pixels");
  }
  Picture picture(width, height);
  picture.rgba.assign(rgba.begin(), rgba.end());
  Frame frame(width, height);
  for (size_t i = 0; i < pixels; ++i) {
    frame.hits[i] = {distance[i], id[i], {normal[3 * i], normal[3 * i + 1], normal[3 * i + 2]}};
  }
  value_of(write_output(path, value_of(encode(format, frame, picture, transparent, path))));
}

}  // namespace whittle
