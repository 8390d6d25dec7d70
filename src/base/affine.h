// Affine maps of space. Names read destination_from_source, so products read right to left:
// world_from_object = world_from_parent * parent_from_object.
#pragma once

#include "base/vec.h"

namespace whittle {

/// p -> linear * p + translation. `row[i]` is row i of the 3x3 linear part.
struct Affine {
  Vec3 row[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Vec3 translation;

  bool operator==(const Affine&) const = default;

  /// The image of a direction: the linear part alone.
  Vec3 vector(Vec3 v) const { return {dot(row[0], v), dot(row[1], v), dot(row[2], v)}; }
  /// The image of a point.
  Vec3 point(Vec3 p) const { return vector(p) + translation; }
  /// The transposed linear part applied to `v`. With this = object_from_world it carries object
  /// normals to world normals (not normalised).
  Vec3 transposed_vector(Vec3 v) const { return row[0] * v.x + row[1] * v.y + row[2] * v.z; }

  double determinant() const { return dot(row[0], cross(row[1], row[2])); }
  bool is_finite() const {
    return whittle::is_finite(row[0]) && whittle::is_finite(row[1]) && whittle::is_finite(row[2]) &&
           whittle::is_finite(translation);
  }
};

inline Affine operator*(const Affine& a, const Affine& b) {
  Affine r;
  for (int i = 0; i < 3; ++i) r.row[i] = b.transposed_vector(a.row[i]);
  r.translation = a.point(b.translation);
  return r;
}

inline Affine translation(Vec3 t) {
  return {.translation = t};
}

inline Affine scaling(Vec3 s) {
  return {.row = {{s.x, 0, 0}, {0, s.y, 0}, {0, 0, s.z}}, .translation = {}};
}

/// The inverse map. Precondition: the determinant is not zero (see is_singular).
inline Affine inverse(const Affine& a) {
  const double s = 1 / a.determinant();
  const Vec3 c0 = cross(a.row[1], a.row[2]) * s, c1 = cross(a.row[2], a.row[0]) * s,
             c2 = cross(a.row[0], a.row[1]) * s;
  Affine r;
  r.row[0] = {c0.x, c1.x, c2.x};
  r.row[1] = {c0.y, c1.y, c2.y};
  r.row[2] = {c0.z, c1.z, c2.z};
  r.translation = -r.vector(a.translation);
  return r;
}

/// True if the map flattens space: its volume factor is below 1e-12 of the product of its row
/// lengths. What it maps has no volume, so a solid under it is empty.
inline bool is_singular(const Affine& a) {
  // Compare with the product of the row lengths, so that uniform smallness is no fault and
  // squashing by 1:1e6 is still a solid.
  const double scale = length(a.row[0]) * length(a.row[1]) * length(a.row[2]);
  return !(std::fabs(a.determinant()) > 1e-12 * scale) || scale == 0;
}

}  // namespace whittle
