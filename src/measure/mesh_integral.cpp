#include "measure/mesh_integral.h"

#include "base/box.h"

namespace whittle {

Integral mesh_integral(const SolidMesh& mesh, Vec3 origin, double corner_error) {
  Integral integral;
  Box box;
  for (const SolidMesh::Triangle& triangle : mesh.triangles) {
    std::array<Vec3, 4> p{};
    for (size_t i = 0; i < 3; ++i) {
      p[i + 1] = mesh.corners[triangle.corners[i]] - origin;
      box.include(p[i + 1]);
    }
    // Seen from the origin, a triangle's far side has the solid in front of it.
    Moments moments = tetrahedron_moments(p);
    if (dot(p[1], cross(p[2], p[3])) < 0)
      for (double& moment : moments) moment = -moment;
    const Vec3 side = p[2] - p[1], other = p[3] - p[1];
    moments[kArea] = length(cross(side, other)) / 2;
    integral.add(moments);
    // An edge's length times what its ends may be off is about what the area may be.
    Moments off{};
    off[kArea] = 2 * corner_error * (length(side) + length(other) + corner_error);
    integral.add_bounds(off);
  }
  if (box.is_empty()) return integral;
  constexpr double kRounding = 4e-15;
  const Vec3 half = box.size() * 0.5;
  const double cube = 8 * half.x * half.y * half.z;
  integral.add_bounds(
      weighted(integral[kArea] * corner_error + kRounding * cube, box.center(), half));
  return integral;
}

}  // namespace whittle
