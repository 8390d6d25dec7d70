#include "image/cut_faces.h"

#include <cmath>

#include "lower/evaluate.h"

namespace whittle {
namespace {

/// Signs with which a half-space's bodies stand in the formula.
constexpr uint8_t kAdded = 1, kSubtracted = 2;

/// Calls visit(face) for the faces of a unit that may be at a point.
template <class Visit>
void for_faces_near(const Scene& scene, const Unit& unit, Vec3 p, double margin,
                    const Visit& visit) {
  if (unit.is_conjunction()) {
    for (uint32_t f = unit.first_face; f < unit.first_face + unit.face_count; ++f) visit(f);
    return;
  }
  const Boundary& boundary = scene.boundaries[unit.boundary];
  const double reach = margin + boundary.slack();
  boundary.visit_in(p, {reach, reach, reach}, [&](uint32_t i) {
    visit(boundary.triangles()[i].face);
    return true;
  });
}

}  // namespace

CutFaces::CutFaces(const Scene& scene)
    : scene_(scene), formula_(scene), margin_(10 * scene.tolerance) {
  std::vector<uint8_t> signs(scene.half_spaces.size(), 0);
  for (const Token token : scene.formula) {
    if (token.is_group()) continue;
    const uint32_t number =
        token.kind() == TokenKind::kFace ? scene.faces[token.payload()].unit : token.payload();
    const Unit& unit = scene.units[number];
    for (uint32_t f = unit.first_face; f < unit.first_face + unit.face_count; ++f)
      signs[scene.faces[f].literal >> 1] |= token.negated() != unit.inward ? kSubtracted : kAdded;
  }
  std::vector<uint8_t> contested;
  for (const Face& face : scene.faces) {
    if (signs[face.literal >> 1] != (kAdded | kSubtracted)) continue;
    const uint32_t id = scene.units[face.unit].id;
    if (id >= contested.size()) contested.resize(id + 1, 0);
    contested[id] = 1;
  }
  units_of_.resize(contested.size());
  for (uint32_t u = 0; u < scene.units.size(); ++u) {
    const uint32_t id = scene.units[u].id;
    if (id >= contested.size() || !contested[id]) continue;
    if (units_of_[id].first == kNoUnit) units_of_[id].first = u;
    units_of_[id].last = u;
  }
}

/// The half-space of the face of these units that the point lies on.
uint32_t CutFaces::surface_at(Units units, Vec3 p) const {
  using K = Kernels<double>;
  uint32_t nearest = 0;
  double least = kInfinity;
  for (uint32_t u = units.first; u <= units.last; ++u) {
    const Unit& unit = scene_.units[u];
    if (units.first != units.last && !is_near(unit.outer, p, margin_)) continue;
    for_faces_near(scene_, unit, p, margin_, [&](uint32_t face) {
      const uint32_t number = scene_.faces[face].literal >> 1;
      const HalfSpace& h = scene_.half_spaces[number];
      const double value = std::fabs(K::quadric_value(h.f, p - h.center));
      if (value < least) least = value, nearest = number;
    });
  }
  return nearest;
}

/// Whether a point of a surface that is near a unit's box is in the unit. A body holds its surface;
/// so its parts do, and those that are taken away from it do not.
bool CutFaces::has(const Unit& unit, uint32_t surface, Vec3 p) const {
  if (unit.is_conjunction()) {
    bool inside = true;
    for (uint32_t f = unit.first_face; inside && f < unit.first_face + unit.face_count; ++f) {
      const Literal literal = scene_.faces[f].literal;
      inside = literal >> 1 == surface ? !unit.inward : contains(scene_, literal, p);
    }
    return inside;
  }
  bool touches = false;
  for_faces_near(scene_, unit, p, margin_,
                 [&](uint32_t face) { touches |= scene_.faces[face].literal >> 1 == surface; });
  return touches ? !unit.inward : scene_.boundaries[unit.boundary].winding(p) != 0;
}

bool CutFaces::is_cut(uint32_t id, Vec3 point) const {
  using K = Kernels<double>;
  Vec3 p = point - scene_.origin;
  const Units own = units_of_[id];
  const uint32_t surface = surface_at(own, p);
  const HalfSpace& h = scene_.half_spaces[surface];
  const auto half_gradient = K::quadric_half_gradient(h.f, p - h.center);
  const Vec3 n{half_gradient.x, half_gradient.y, half_gradient.z};
  if (dot(n, n) > 0) p -= n * (K::quadric_value(h.f, p - h.center) / (2 * dot(n, n)));

  return !formula_.value_at(p, margin_, [&](uint32_t number) {
    const Unit& unit = scene_.units[number];
    // A convex body holds the points of its own surface, where rounding may deny it at an edge.
    const bool is_all_of_it = number == own.first && number == own.last;
    if (is_all_of_it && unit.is_conjunction()) return !unit.inward;
    return has(unit, surface, p);
  });
}

}  // namespace whittle
