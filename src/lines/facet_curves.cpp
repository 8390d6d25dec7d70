#include "lines/facet_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <variant>

#include "lines/bodies.h"
#include "model/instances.h"

namespace whittle {
namespace {

constexpr int kFewest = 8, kMost = 720;

/// Facets of a circle of that radius, in units of the drawing. With a multiple of four the curve's
/// own extremes are corners. With one of 24 a pin that is turned in its hole by 15 degrees still
/// has the same as the hole; balls are turned less often, and have their number squared.
int facets_for(double radius, double fineness, bool is_ball) {
  const double share = fineness / radius;
  if (!(share < 0.5)) return kFewest;
  const double n = std::ceil(std::numbers::pi / std::acos(1 - share));
  if (!(n < kMost)) return kMost;
  if (n <= 12) return n <= kFewest ? kFewest : 12;
  const int step = is_ball ? 4 : 24;
  return (int(n) + step - 1) / step * step;
}

/// How often a map makes lengths longer, at most.
double growth(const Affine& map) {
  return std::sqrt(dot(map.row[0], map.row[0]) + dot(map.row[1], map.row[1]) +
                   dot(map.row[2], map.row[2]));
}

/// Units of the drawing in one of the model where it is nearest to the eye. Right before the eye
/// what is a little farther away counts.
double nearest_units(const Model& model, const ViewProjection& projection) {
  const Box box = bounds(model).box;
  if (box.is_empty()) return 1;
  const double reach = length(box.size()) / 2;
  return projection.units_at(std::max(projection.depth(box.center()) - reach, reach / 16));
}

void set_facets(Shape& shape, int facets) {
  if (auto* sphere = std::get_if<Sphere>(&shape)) sphere->facets = facets;
  if (auto* cylinder = std::get_if<Cylinder>(&shape)) cylinder->facets = facets;
}

}  // namespace

double curve_radius(const Shape& shape, const Affine& world_from_object) {
  if (is_empty(shape) || !wall(shape)) return 0;
  const double radius = std::holds_alternative<Sphere>(shape)
                            ? std::get<Sphere>(shape).widest_radius()
                            : std::get<Cylinder>(shape).widest_radius();
  // A turned circle's image is no longer than the map's longest column, which the root of the sum
  // of all squares is at most sqrt(3) times as long as.
  return radius * growth(world_from_object) / std::sqrt(3.0);
}

Result<Model> facet_curves(const Model& model, const ViewProjection& projection,
                           size_t most_facets) {
  const std::vector<Instance> all = instances(model);
  const std::vector<uint32_t> bodies = bodies_of_parts(model, all);
  std::vector<double> radii(all.size());
  std::map<uint32_t, double> widest;  // by body
  const double units = nearest_units(model, projection);
  for (size_t i = 0; i < all.size(); ++i) {
    const Shape& shape = model.primitives[all[i].primitive].shape;
    if (!all[i].empty) radii[i] = curve_radius(shape, all[i].world_from_object) * units;
    if (bodies[i] != 0) widest[bodies[i]] = std::max(widest[bodies[i]], radii[i]);
  }
  Model facetted = model;
  // Where there are many, coarser ones must do.
  const double finest = projection.fineness();
  for (double fineness = finest; fineness <= 64 * finest; fineness *= 4) {
    size_t count = 0;
    for (size_t i = 0; i < all.size(); ++i) {
      Shape& shape = facetted.primitives[all[i].primitive].shape;
      const double radius = bodies[i] != 0 ? widest[bodies[i]] : radii[i];
      const bool is_ball = std::holds_alternative<Sphere>(shape);
      if (radii[i] > 0) set_facets(shape, facets_for(radius, fineness, is_ball));
      count += facet_count(shape);
    }
    if (count <= most_facets) return facetted;
  }
  return Error{ErrorKind::kMachine,
               fmt::format("{}: error: a line drawing of more than {} facets is too large",
                           model.file, most_facets)};
}

}  // namespace whittle
