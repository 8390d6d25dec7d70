#include "lower/primitive_faces.h"

#include <algorithm>
#include <cmath>

#include "shape/points.h"

namespace whittle {
namespace {

using K = Kernels<double>;

/// weight * (r.q)^2 added to the quadric.
void add_square(K::Quadric& f, Vec3 r, double weight) {
  f.diag += Vec3{r.x * r.x, r.y * r.y, r.z * r.z} * weight;
  f.off += Vec3{r.y * r.z, r.x * r.z, r.x * r.y} * weight;
}

/// Scales f so that its steepest gradient on the surface is about 1: for q.A q = s^2 that is
/// 2 sqrt(lambda) s, lambda the largest eigenvalue of A, here bounded by its trace's parts.
HalfSpace quadric_half_space(K::Quadric f, Vec3 center, double largest_eigenvalue) {
  const double scale = 1 / (2 * std::sqrt(largest_eigenvalue * std::fabs(f.c)));
  f.diag *= scale, f.off *= scale, f.b *= scale, f.c *= scale;
  const bool sphere =
      f.diag.x == f.diag.y && f.diag.y == f.diag.z && f.off == Vec3{} && f.b == Vec3{};
  return {center, f, sphere ? SurfaceKind::kSphere : SurfaceKind::kQuadric};
}

HalfSpace plane_half_space(Vec3 normal, Vec3 point) {
  return {point, {{}, {}, normalize(normal) * 0.5, 0}, SurfaceKind::kPlane};
}

bool is_finite(const HalfSpace& h) {
  return is_finite(h.center) && is_finite(h.f.diag) && is_finite(h.f.off) && is_finite(h.f.b) &&
         std::isfinite(h.f.c);
}

HalfSpace wall_half_space(const Wall& wall, const Affine& local_from_object,
                          const Affine& object_from_local) {
  const auto& row = object_from_local.row;
  K::Quadric f{{}, {}, {}, wall.constant};
  for (int i = 0; i < 3; ++i)
    if (wall.squares[i] > 0) add_square(f, row[i], wall.squares[i]);
  const double steepest = max_component(f.diag);
  if (wall.squares.z < 0) add_square(f, row[2], wall.squares.z);
  if (!wall.is_ball()) f.b = row[2] * wall.along;
  return quadric_half_space(f, local_from_object.point(wall.center), steepest);
}

}  // namespace

HalfSpace facet_half_space(const Plane& facet, Vec3 middle, const Affine& local_from_object,
                           const Affine& object_from_local) {
  // A point of the plane next to the primitive's middle keeps later numbers small.
  const Vec3 foot = middle + facet.n * (facet.d - dot(facet.n, middle));
  return plane_half_space(object_from_local.transposed_vector(facet.n),
                          local_from_object.point(foot));
}

void lower_primitive(const Shape& shape, const Affine& local_from_object, LoweredPrimitive& out) {
  out.half_spaces.clear();
  out.is_ball = false;
  out.tip.reset();
  if (const TriangleMesh* const mesh = boundary(shape)) {
    out.extent = extent(shape, mesh->points, mesh->facets, local_from_object);
    return;
  }
  const Affine object_from_local = inverse(local_from_object);
  const std::vector<Plane> planes = facet_planes(shape);
  const std::optional<Wall> curved = wall(shape);
  std::vector<Vec3> points;
  if (!curved || !curved->is_ball()) points = outline(shape);
  out.extent = extent(shape, points, planes, local_from_object);
  Vec3 middle;
  if (curved) {
    middle = curved->center;
    out.half_spaces.push_back(wall_half_space(*curved, local_from_object, object_from_local));
    out.is_ball = curved->is_ball();
    if (curved->tip) out.tip = local_from_object.point(*curved->tip);
    if (out.tip && !is_finite(*out.tip)) out.tip.reset();
  } else {
    middle = middle_of(points);
  }
  out.half_spaces.reserve(out.half_spaces.size() + planes.size());
  for (const Plane& plane : planes)
    out.half_spaces.push_back(
        facet_half_space(plane, middle, local_from_object, object_from_local));
  const auto finite = [](const HalfSpace& h) { return is_finite(h); };
  if (!std::ranges::all_of(out.half_spaces, finite)) out.half_spaces.clear();
}

size_t face_count(const Shape& shape) {
  return size_t(!is_flat(shape)) + plane_count(shape);
}

std::vector<Vec3> wall_outline(const Shape& shape, const Affine& local_from_object) {
  std::vector<Vec3> points = outline(shape);
  for (Vec3& p : points) p = local_from_object.point(p);
  return points;
}

}  // namespace whittle
