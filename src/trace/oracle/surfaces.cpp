#include "trace/oracle/surfaces.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "model/extent.h"
#include "model/facets.h"

namespace whittle {

namespace {

/// What one primitive brings along.
struct Solid {
  Affine object_from_world;
  Extent extent;              ///< world space
  double tolerance = 0;       ///< of its surfaces
  std::vector<Vec3> outline;  ///< world space; of a curved one only
};

/// A plane through a point next to its primitive: no large numbers where the model is far off.
struct WorldPlane {
  Vec3 n, point;
};

WorldPlane world_plane(const Plane& plane, const Solid& solid, const Affine& world_from_object) {
  const Vec3 middle = solid.object_from_world.point(solid.extent.center);
  const Vec3 near = middle + plane.n * (plane.d - dot(plane.n, middle));
  return {normalize(solid.object_from_world.transposed_vector(plane.n)),
          world_from_object.point(near)};
}

class Namer {
 public:
  Namer(const Model& model, std::span<const Instance> instances) {
    const Bounds b = bounds(model);
    region_ = view_region(b);
    model_tolerance_ = tolerance(b);
    least_tolerance_ = together(region_);
    out_.faces_before.push_back(0);
    for (const Instance& instance : instances) {
      if (instance.empty) continue;
      add(model.primitives[instance.primitive].shape, instance.world_from_object);
      out_.faces_before.push_back(uint32_t(out_.faces.size()));
    }
  }

  Surfaces take() { return std::move(out_); }

 private:
  void add(const Shape& shape, const Affine& world_from_object) {
    Solid solid{.object_from_world = inverse(world_from_object),
                .extent = within(extent(shape, world_from_object), region_),
                .tolerance = 0,
                .outline = {}};
    solid.tolerance = own_tolerance(model_tolerance_, solid.extent, least_tolerance_);
    out_.frames.push_back(
        {solid.object_from_world, solid.object_from_world.point(solid.extent.center)});
    if (is_flat(shape)) {
      for (const Plane& plane : facet_planes(shape)) add_plane(plane, solid, world_from_object);
      return;
    }
    solid.outline = outline(shape);
    for (Vec3& p : solid.outline) p = world_from_object.point(p);
    if (const auto* s = std::get_if<Sphere>(&shape)) {
      Surface sphere;
      sphere.kind = Surface::Kind::kSphere;
      sphere.radius = s->r;
      add_curve(sphere, solid);
      return;
    }
    const auto& s = std::get<Cylinder>(shape);
    Surface side;
    side.kind = Surface::Kind::kCone;
    side.z0 = s.center ? -s.h / 2 : 0;
    side.z1 = side.z0 + s.h;
    side.radius = s.r1;
    side.slope = (s.r2 - s.r1) / s.h;
    add_curve(side, solid);
    add_plane({{0, 0, -1}, -side.z0}, solid, world_from_object);
    add_plane({{0, 0, 1}, side.z1}, solid, world_from_object);
  }

  void add_plane(const Plane& plane, const Solid& solid, const Affine& world_from_object) {
    const WorldPlane at = world_plane(plane, solid, world_from_object);
    for (uint32_t i = 0; i < out_.all.size(); ++i) {
      if (out_.all[i].kind != Surface::Kind::kPlane) continue;
      const bool opposite = dot(at.n, world_[i].n) < 0;
      const double parting = length(opposite ? at.n + world_[i].n : at.n - world_[i].n);
      const Vec3 center = solid.extent.center;
      const Vec3 foot = center - at.n * dot(at.n, center - at.point);
      if (std::fabs(dot(world_[i].n, foot - world_[i].point)) + parting * solid.extent.radius <=
          std::min(solid.tolerance, tolerance_[i])) {
        out_.faces.push_back({i, opposite});
        return;
      }
    }
    Surface surface;
    surface.plane = plane;
    add_new(surface, solid, at);
  }

  void add_curve(const Surface& surface, const Solid& solid) {
    for (uint32_t i = 0; i < out_.all.size(); ++i) {
      if (out_.all[i].kind != surface.kind) continue;
      if (const std::optional<bool> other_side = lies_on(i, solid)) {
        out_.faces.push_back({i, *other_side});
        return;
      }
    }
    add_new(surface, solid, {});
  }

  /// Whether the whole outline lies on one nappe of curved surface `i`, and if so, on the other
  /// one?
  std::optional<bool> lies_on(uint32_t i, const Solid& solid) const {
    const Surface& s = out_.all[i];
    const Affine& object_from_world = out_.frames[s.frame].object_from_world;
    const double allowed = std::min(solid.tolerance, tolerance_[i]);
    std::optional<bool> other_nappe;
    for (const Vec3& p : solid.outline) {
      const Vec3 q = object_from_world.point(p);
      const bool sphere = s.kind == Surface::Kind::kSphere;
      const double r = sphere ? s.radius : s.radius + s.slope * (q.z - s.z0);
      const double f = q.x * q.x + q.y * q.y + (sphere ? q.z * q.z : 0) - r * r;
      const Vec3 g = {2 * q.x, 2 * q.y, sphere ? 2 * q.z : -2 * r * s.slope};
      const double steepness = length(object_from_world.transposed_vector(g));
      if (!(std::fabs(f) <= allowed * steepness && steepness > 0)) return std::nullopt;
      // One circle on either nappe is no wall.
      if (other_nappe && *other_nappe != (r < 0)) return std::nullopt;
      other_nappe = r < 0;
    }
    return other_nappe;
  }

  void add_new(const Surface& surface, const Solid& solid, const WorldPlane& at) {
    out_.faces.push_back({uint32_t(out_.all.size()), false});
    out_.all.push_back(surface);
    out_.all.back().frame = uint32_t(out_.frames.size() - 1);
    world_.push_back(at);
    tolerance_.push_back(solid.tolerance);
  }

  Box region_;
  double model_tolerance_ = 0, least_tolerance_ = 0;
  Surfaces out_;
  // One a surface: what later faces are compared with.
  std::vector<WorldPlane> world_;
  std::vector<double> tolerance_;
};

}  // namespace

Surfaces name_surfaces(const Model& model, std::span<const Instance> instances) {
  return Namer(model, instances).take();
}

}  // namespace whittle
