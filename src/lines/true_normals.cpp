#include "lines/true_normals.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <variant>

#include "lines/bodies.h"
#include "lines/facet_curves.h"
#include "lower/primitive_faces.h"
#include "model/instances.h"

namespace whittle {
namespace {

/// What a shape is without facets, if it is meant to be round.
std::optional<Shape> round_shape(const Shape& shape) {
  const auto is_round = [](int facets) { return facets == 0 || facets > kMostCorneredSides; };
  if (const auto* sphere = std::get_if<Sphere>(&shape);
      sphere != nullptr && is_round(sphere->facets))
    return Sphere{.r = sphere->r};
  if (const auto* cylinder = std::get_if<Cylinder>(&shape);
      cylinder != nullptr && is_round(cylinder->facets)) {
    Cylinder round = *cylinder;
    round.facets = 0;
    return round;
  }
  return std::nullopt;
}

/// How many of the faces are flat for good; they come first.
uint32_t cap_count(const Shape& shape) {
  const auto* cylinder = std::get_if<Cylinder>(&shape);
  return cylinder == nullptr ? 0 : uint32_t(cylinder->r1 > 0) + uint32_t(cylinder->r2 > 0);
}

bool is_one_of_many(const Shape& shape) {
  return std::holds_alternative<Mesh>(shape) || std::holds_alternative<Polyhedron>(shape);
}

/// How many facets a round shape has.
int facets_of(const Shape& shape) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return sphere->facets;
  const auto* cylinder = std::get_if<Cylinder>(&shape);
  return cylinder == nullptr ? 0 : cylinder->facets;
}

}  // namespace

TrueNormals::TrueNormals(const Model& model, const Model& facetted, const Scene& scene)
    : origin_(scene.origin),
      bodies_(scene.half_spaces.size(), 0),
      has_made_(scene.half_spaces.size(), false),
      firsts_(scene.half_spaces.size() + 1, 0) {
  const std::vector<Instance> all = instances(facetted);
  const std::vector<uint32_t> parts = bodies_of_parts(facetted, all);
  std::vector<std::pair<uint32_t, uint32_t>> facets;  // half-space and wall
  LoweredPrimitive lowered;
  for (size_t i = 0; i < scene.units.size(); ++i) {
    const Unit& unit = scene.units[i];
    const Primitive& primitive = facetted.primitives[all[i].primitive];
    const Shape& written = model.primitives[all[i].primitive].shape;
    const uint32_t body = parts[i] != 0                     ? parts[i]
                          : is_one_of_many(primitive.shape) ? primitive.id
                                                            : 0;
    const std::optional<Shape> round = unit.face_count > 0 ? round_shape(written) : std::nullopt;
    if (round) lower_primitive(*round, translation(-origin_) * all[i].world_from_object, lowered);
    const bool is_round = round && !lowered.half_spaces.empty();
    if (is_round) {
      // Edges are chords of the curve, and cut one another between two of them.
      const double chord = 1 - std::cos(std::numbers::pi / facets_of(primitive.shape));
      walls_.push_back(
          {lowered.half_spaces[0], 4 * curve_radius(*round, all[i].world_from_object) * chord});
    }
    for (uint32_t k = 0; k < unit.face_count; ++k) {
      const uint32_t half_space = scene.faces[unit.first_face + k].literal >> 1;
      if (bodies_[half_space] == 0) bodies_[half_space] = body;
      if (!is_round || k < cap_count(primitive.shape)) continue;
      facets.push_back({half_space, uint32_t(walls_.size()) - 1});
      if (facets_of(written) == 0) has_made_[half_space] = true;
    }
  }
  for (const auto& [half_space, wall] : facets) ++firsts_[half_space + 1];
  for (size_t i = 1; i < firsts_.size(); ++i) firsts_[i] += firsts_[i - 1];
  members_.resize(facets.size());
  std::vector<uint32_t> next(firsts_.begin(), firsts_.end() - 1);
  for (const auto& [half_space, wall] : facets) members_[next[half_space]++] = wall;
}

Vec3 TrueNormals::at(const SolidMesh::Face& face, Vec3 point) const {
  using K = Kernels<double>;
  const Vec3 local = point - origin_;
  const HalfSpace* nearest = nullptr;
  double least = 0;
  for (uint32_t i = firsts_[face.half_space]; i < firsts_[face.half_space + 1]; ++i) {
    const Wall& wall = walls_[members_[i]];
    const double away = std::fabs(K::quadric_value(wall.surface.f, local - wall.surface.center));
    if (away > wall.slack || (nearest != nullptr && away >= least)) continue;
    nearest = &wall.surface, least = away;
  }
  if (nearest == nullptr) return face.outward;
  const Vec3 normal = normalize(K::quadric_half_gradient(nearest->f, local - nearest->center));
  const double along = dot(normal, face.outward);
  // At a cone's tip there is none.
  if (!is_finite(normal) || along == 0) return face.outward;
  return along < 0 ? -normal : normal;
}

}  // namespace whittle
