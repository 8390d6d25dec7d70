#include "lower/primitive_faces.h"

#include <algorithm>
#include <cmath>

#include "model/facets.h"

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

struct Builder {
  const Affine& local_from_object;
  Affine object_from_local;
  LoweredPrimitive& out;

  void plane(const Plane& p, Vec3 near_point) {
    out.half_spaces.push_back(
        facet_half_space(p, near_point, local_from_object, object_from_local));
  }

  void flat(const Shape& shape) {
    const std::vector<Plane> planes = facet_planes(shape);
    const std::vector<Vec3> vertices = facet_vertices(shape);
    out.extent = flat_extent(vertices, planes, local_from_object);
    Vec3 middle;
    for (const Vec3& v : vertices) middle += v / double(vertices.size());
    out.half_spaces.reserve(planes.size());
    for (const Plane& p : planes) plane(p, middle);
  }

  void curved(const Shape& shape) {
    out.outline = outline(shape);
    out.extent = curved_extent(shape, out.outline, local_from_object);
    for (Vec3& p : out.outline) p = local_from_object.point(p);
  }

  void sphere(const Sphere& s) {
    out.is_ball = true;
    K::Quadric f{{}, {}, {}, -s.r * s.r};
    for (const Vec3& row : object_from_local.row) add_square(f, row, 1);
    const double steepest = max_component(f.diag);
    out.half_spaces.push_back(quadric_half_space(f, local_from_object.translation, steepest));
  }

  void cylinder(const Cylinder& c) {
    const double z_low = c.center ? -c.h / 2 : 0, z_high = z_low + c.h, z_mid = z_low + c.h / 2;
    // About the axis' middle: x^2 + y^2 - (r + s z)^2, r the mean radius.
    const double r = (c.r1 + c.r2) / 2, s = (c.r2 - c.r1) / c.h;
    const auto& row = object_from_local.row;
    K::Quadric f{{}, {}, row[2] * (-r * s), -r * r};
    add_square(f, row[0], 1);
    add_square(f, row[1], 1);
    const double steepest = max_component(f.diag);
    add_square(f, row[2], -s * s);
    const Vec3 middle{0, 0, z_mid};
    out.half_spaces.push_back(quadric_half_space(f, local_from_object.point(middle), steepest));
    plane({{0, 0, -1}, -z_low}, middle);
    plane({{0, 0, 1}, z_high}, middle);
    // A tip at an end is exactly there.
    if (std::fabs(r) <= std::fabs(c.r2 - c.r1)) {
      const double z_tip = c.r1 == 0   ? z_low
                           : c.r2 == 0 ? z_high
                                       : z_low + c.h * (c.r1 / (c.r1 - c.r2));
      const Vec3 tip = local_from_object.point({0, 0, z_tip});
      if (is_finite(tip)) out.tip = tip;
    }
  }
};

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
  out.outline.clear();
  out.is_ball = false;
  out.tip.reset();
  Builder builder{local_from_object, inverse(local_from_object), out};
  if (const auto* mesh = std::get_if<Mesh>(&shape)) {
    out.extent = mesh_extent(*mesh->surface, local_from_object);
    return;
  }
  if (is_flat(shape)) {
    builder.flat(shape);
  } else {
    builder.curved(shape);
    if (const auto* sphere = std::get_if<Sphere>(&shape))
      builder.sphere(*sphere);
    else
      builder.cylinder(std::get<Cylinder>(shape));
  }
  const auto finite = [](const HalfSpace& h) { return is_finite(h); };
  if (!std::ranges::all_of(out.half_spaces, finite)) out.half_spaces.clear();
}

}  // namespace whittle
