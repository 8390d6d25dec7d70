#include "image/cut_faces.h"

#include <cmath>

#include "lower/evaluate.h"

namespace whittle {
namespace {

/// Signs with which a half-space's faces stand in the formula.
constexpr uint8_t kAdded = 1, kSubtracted = 2;

template <class Visit>
void for_faces(const Scene& scene, Token token, const Visit& visit) {
  if (token.kind() == TokenKind::kFace) {
    visit(token.payload());
    return;
  }
  const Unit& unit = scene.units[token.payload()];
  for (uint32_t f = unit.first_face; f < unit.first_face + unit.face_count; ++f) visit(f);
}

}  // namespace

CutFaces::CutFaces(const Scene& scene) : scene_(scene) {
  std::vector<uint8_t> signs(scene.half_spaces.size(), 0);
  for (const Token token : scene.formula) {
    if (token.is_group()) continue;
    for_faces(scene, token, [&](uint32_t face) {
      signs[scene.faces[face].literal >> 1] |= token.negated() ? kSubtracted : kAdded;
    });
  }
  for (const Face& face : scene.faces) {
    if (signs[face.literal >> 1] != (kAdded | kSubtracted)) continue;
    const uint32_t id = scene.units[face.unit].id;
    if (id >= unit_of_.size()) unit_of_.resize(id + 1, kNoUnit);
    unit_of_[id] = face.unit;
  }
}

/// The half-space of the unit's face that the point lies on.
uint32_t CutFaces::half_space_at(uint32_t unit_number, Vec3 p) const {
  using K = Kernels<double>;
  const Unit& unit = scene_.units[unit_number];
  uint32_t nearest = 0;
  double least = kInfinity;
  for (uint32_t f = unit.first_face; f < unit.first_face + unit.face_count; ++f) {
    const uint32_t number = scene_.faces[f].literal >> 1;
    const HalfSpace& h = scene_.half_spaces[number];
    const double value = std::fabs(K::quadric_value(h.f, p - h.center));
    if (value < least) least = value, nearest = number;
  }
  return nearest;
}

/// Whether a point is inside of a boundary, or on a triangle of it that lies in this surface.
bool CutFaces::has_or_touches(const Unit& unit, uint32_t surface, Vec3 p, double margin) const {
  const Boundary& boundary = scene_.boundaries[unit.boundary];
  const double reach = margin + boundary.slack();
  bool touches = false;
  boundary.visit_in(p, {reach, reach, reach}, [&](uint32_t i) {
    touches = scene_.faces[boundary.triangles()[i].face].literal >> 1 == surface;
    return !touches;
  });
  return touches || boundary.winding(p) != 0;
}

bool CutFaces::is_cut(uint32_t id, Vec3 point) const {
  using K = Kernels<double>;
  Vec3 p = point - scene_.origin;
  const uint32_t surface = half_space_at(unit_of_[id], p);
  const HalfSpace& h = scene_.half_spaces[surface];
  const auto half_gradient = K::quadric_half_gradient(h.f, p - h.center);
  const Vec3 n{half_gradient.x, half_gradient.y, half_gradient.z};
  if (dot(n, n) > 0) p -= n * (K::quadric_value(h.f, p - h.center) / (2 * dot(n, n)));

  const double margin = 10 * scene_.tolerance;
  return !evaluate<uint8_t>(scene_.formula, 1, [&](Token token) -> uint8_t {
    bool inside = true;
    if (token.kind() == TokenKind::kUnit) {
      const Unit& unit = scene_.units[token.payload()];
      const Box& outer = unit.outer;
      for (int axis = 0; axis < 3; ++axis)
        inside = inside && outer.lo[axis] - margin <= p[axis] && p[axis] <= outer.hi[axis] + margin;
    }
    if (inside && token.kind() == TokenKind::kUnit &&
        !scene_.units[token.payload()].is_conjunction())
      return has_or_touches(scene_.units[token.payload()], surface, p, margin) != token.negated();
    if (inside) {
      for_faces(scene_, token, [&](uint32_t face) {
        const Literal literal = scene_.faces[face].literal;
        inside = inside && (literal >> 1 == surface || contains(scene_, literal, p));
      });
    }
    return inside != token.negated();
  });
}

}  // namespace whittle
