#include "inquiry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <utility>

#include "host/input_kinds.h"
#include "host/quoted_places.h"
#include "whittle/reading.h"

namespace whittle {
namespace {

using Json = nlohmann::ordered_json;

/// A point lies on a wall if it is no farther from it than this share of the wall's radius.
constexpr double kOnWall = 1e-6;

/// The statement that stands at a place of a file; empty if the file cannot be read again.
std::string statement_at(const std::string& path, SourceLocation where) {
  constexpr size_t kEnough = 4096;
  std::ifstream file(path, std::ios::binary);
  std::string text;
  for (uint32_t line = 0; line < where.line; ++line)
    if (!std::getline(file, text)) return {};
  if (where.column < 1 || where.column > text.size()) return {};
  text.erase(0, where.column - 1);
  text += '\n';
  std::string more(kEnough, '\0');
  file.read(more.data(), std::streamsize(more.size()));
  text.append(more, 0, size_t(file.gcount()));
  return quote_statement(text, 0);
}

Json parameters_of(const Shape& shape) {
  Json json = Json::object();
  if (const auto* cube = std::get_if<Cube>(&shape)) {
    json = {{"size", json_of(cube->size)}, {"center", cube->center}};
  } else if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    json = {{"r", sphere->r}, {"facets", sphere->facets}};
  } else if (const auto* c = std::get_if<Cylinder>(&shape)) {
    json = {
        {"h", c->h}, {"r1", c->r1}, {"r2", c->r2}, {"center", c->center}, {"facets", c->facets}};
  } else if (const auto* polyhedron = std::get_if<Polyhedron>(&shape)) {
    json = {{"points", polyhedron->points.size()}, {"faces", polyhedron->faces.size()}};
  } else if (const auto* halfspace = std::get_if<Halfspace>(&shape)) {
    json = {{"n", json_of(halfspace->n)}, {"d", halfspace->d}};
  } else if (const TriangleMesh* mesh = boundary(shape)) {
    json = {{"points", mesh->points.size()}, {"triangles", mesh->triangles.size()}};
  }
  return json;
}

/// By how much a map scales across the z axis, if a circle about it stays a circle and the axis
/// stays square to it.
std::optional<double> scale_across(const Affine& map) {
  const Vec3 x = map.vector({1, 0, 0}), y = map.vector({0, 1, 0}), z = map.vector({0, 0, 1});
  const double a = length(x), b = length(y), c = length(z);
  const double slack = kOnWall * a * a;
  if (std::fabs(a - b) > kOnWall * a || std::fabs(dot(x, y)) > slack ||
      std::fabs(dot(x, z)) > kOnWall * a * c || std::fabs(dot(y, z)) > kOnWall * b * c)
    return std::nullopt;
  return a;
}

/// Whether a point at distance `across` from the axis lies on a wall of radius r, or on its facets.
bool is_on_wall(double across, double r, int facets) {
  const double least = facets > 0 ? r * std::cos(std::numbers::pi / facets) : r;
  return across >= least - kOnWall * r && across <= r + kOnWall * r;
}

/// The radius of the wall in the shape's own units; none if the point is not on it.
std::optional<double> wall_radius(const Shape& shape, Vec3 p, Vec3 normal) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    // Facets of a sphere lie deeper by how coarse it is both ways.
    const double least = std::cos(sphere->facets > 0 ? std::numbers::pi / sphere->facets : 0);
    const double reach = length(p) / sphere->r;
    if (reach < least * least - kOnWall || reach > 1 + kOnWall) return std::nullopt;
    return sphere->r;
  }
  const auto* c = std::get_if<Cylinder>(&shape);
  if (c == nullptr) return std::nullopt;
  const double share = p.z / c->h + (c->center ? 0.5 : 0);
  const double r = c->r1 + (c->r2 - c->r1) * share;
  const bool is_end = std::hypot(normal.x, normal.y) <= kOnWall * length(normal);
  if (is_end || share < -kOnWall || share > 1 + kOnWall || !(r > 0)) return std::nullopt;
  if (!is_on_wall(std::hypot(p.x, p.y), r, c->facets)) return std::nullopt;
  return r;
}

}  // namespace

void add_inquiry_options(CommandLine& line, InquiryArguments& a) {
  OptionGroup(line.app(), "Output").add_flag("--json", a.wants_json, "as JSON, one object a line");
  add_loading_options(line, a.loading);
  add_lenient_option(line.app(), a.loading);
  add_machine_options(line.app(), a.renderer, a.loading);
}

void add_picture_options(CommandLine& line, InquiryArguments& a) {
  add_view_options(line.app(), a.view, a.loading);
  add_style_option(line.app(), a.style);
}

void settle_picture(InquiryArguments& a) {
  suit_style(a.style, a.loading);
  a.view.tight = frames_tightly(a.style);
}

Position parse_position(const std::string& text) {
  const std::vector<double> at = parse_numbers("--at", text, 2);
  return {at[0], at[1]};
}

Status check_positions(std::span<const Position> positions, const ViewOptions& view) {
  for (const auto& [x, y] : positions) {
    if (x >= 0 && x < view.width && y >= 0 && y < view.height) continue;
    return Error{ErrorKind::kUsage,
                 fmt::format("--at {},{} is outside of the picture, which has {} x {} pixels",
                             text_of(x), text_of(y), view.width, view.height)};
  }
  return Done{};
}

std::string text_of(double number) {
  return fmt::format("{:.9g}", number == 0 ? 0 : number);
}

std::string text_of(Vec3 v) {
  return fmt::format("{},{},{}", text_of(v.x), text_of(v.y), text_of(v.z));
}

Result<std::unique_ptr<Inquiry>> Inquiry::open(const InquiryArguments& a) {
  RendererSettings settings = a.renderer;
  if (Status possible = settle_device(settings); !possible) return possible.error();
  if (Status possible = check_view(a.view); !possible) return possible.error();
  Result<Read> read = load(a.file, a.loading);
  if (!read) return read.error();
  std::unique_ptr<Inquiry> inquiry(new Inquiry(a.loading, *std::move(read)));
  // Rays that are asked are answered on the processor by every backend but the oracle.
  if (settings.backend != Backend::kOracle) settings.backend = Backend::kCpu;
  Result<Renderer> renderer = Renderer::make(inquiry->model(), settings);
  if (!renderer) return renderer.error();
  inquiry->renderer_ = *std::move(renderer);
  inquiry->camera_ = inquiry->renderer_->camera(a.view);
  if (Status prepared = inquiry->renderer_->prepare(inquiry->camera_); !prepared)
    return prepared.error();
  inquiry->instances_ = instances(inquiry->model());
  inquiry->places_ = statement_places(inquiry->model());
  inquiry->looks_ = appearances(inquiry->model());
  return inquiry;
}

Status Inquiry::cast(std::span<const Ray> rays, std::span<Hit> hits) {
  return renderer_->cast(rays, hits);
}

Status Inquiry::cast_through(std::span<const Ray> rays, RayCrossings& found) {
  return renderer_->cast_through(rays, found);
}

Result<std::optional<Picked>> Inquiry::pick(const Position& at) {
  const Ray ray = camera_.ray(at.x, at.y);
  RayCrossings found;
  if (Status cast = cast_through({&ray, 1}, found); !cast) return cast.error();
  if (found.all.empty()) return std::optional<Picked>();
  const SurfaceCrossing& first = found.all[0];
  return std::optional<Picked>({first, ray.origin + ray.direction * first.distance});
}

Subject Inquiry::subject(uint32_t id) const {
  const Model& m = model();
  Subject subject;
  std::vector<const Instance*> parts;
  for (const Instance& instance : instances_)
    if (m.primitives[instance.primitive].id == id) parts.push_back(&instance);
  const SourceLocation where = places_[id];
  if (kind_of_input(m.file) == InputKind::kCsg && where != SourceLocation{}) {
    subject.place = fmt::format("{}:{}:{}", m.file, where.line, where.column);
    subject.statement = statement_at(m.file, where);
  }
  if (parts.size() == 1) {
    const Shape& shape = m.primitives[parts[0]->primitive].shape;
    subject.kind = kShapeNames[shape.index()];
    subject.parameters = parameters_of(shape);
  } else {
    subject.kind = "body";
    subject.parameters = {{"parts", parts.size()}};
  }
  if (const Rgba& color = looks_[id].color; color.is_valid()) subject.color = color;
  return subject;
}

std::optional<double> Inquiry::diameter_at(const Picked& picked) const {
  for (const Instance& instance : instances_) {
    const Primitive& primitive = model().primitives[instance.primitive];
    if (primitive.id != picked.hit.id || instance.empty) continue;
    const Affine& map = instance.world_from_object;
    const std::optional<double> across = scale_across(map);
    if (!across) continue;
    const bool is_ball = std::holds_alternative<Sphere>(primitive.shape);
    if (is_ball && std::fabs(length(map.vector({0, 0, 1})) - *across) > kOnWall * *across) continue;
    const Vec3 p = inverse(map).point(picked.point);
    const std::optional<double> radius =
        wall_radius(primitive.shape, p, map.transposed_vector(picked.hit.normal));
    if (radius) return 2 * *radius * *across;
  }
  return std::nullopt;
}

Result<std::optional<double>> Inquiry::thickness_at(const Picked& picked) {
  const Ray inward{picked.point, -picked.hit.normal, 0};
  RayCrossings found;
  if (Status cast = cast_through({&inward, 1}, found); !cast) return cast.error();
  // Rounding may have put the point a little before the surface, or behind it.
  const double rounding = 10 * ray_tolerance(view_region(bounds(model())));
  for (const SurfaceCrossing& crossing : found.all) {
    if (crossing.distance <= rounding) continue;
    return crossing.enters ? std::optional<double>() : crossing.distance;
  }
  return std::optional<double>();
}

}  // namespace whittle
