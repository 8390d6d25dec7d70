#include "trace/oracle/surfaces.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "shape/extent.h"
#include "shape/shape.h"

namespace whittle {

namespace {

/// What one primitive brings along.
struct Solid {
  Affine object_from_world;
  Extent extent;              ///< world space
  double tolerance = 0;       ///< its own
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

/// Surfaces with what later ones are compared with.
struct Known {
  Surface surface;
  WorldPlane at;         ///< of a plane
  double tolerance = 0;  ///< that others must keep to
};

/// Whether two planes are nowhere farther apart than `allowed` in the ball, and if so, do they face
/// each other's back?
std::optional<bool> same_plane(const WorldPlane& known, const WorldPlane& at, const Extent& ball,
                               double allowed) {
  const bool opposite = dot(at.n, known.n) < 0;
  const double parting = length(opposite ? at.n + known.n : at.n - known.n);
  const Vec3 foot = ball.center - at.n * dot(at.n, ball.center - at.point);
  if (std::fabs(dot(known.n, foot - known.point)) + parting * ball.radius <= allowed)
    return opposite;
  return std::nullopt;
}

class Namer {
 public:
  Namer(const Model& model, std::span<const Instance> instances) {
    const Bounds b = bounds(model);
    region_ = view_region(b);
    ray_tolerance_ = ray_tolerance(region_);
    const double model_tolerance = tolerance(b);
    out_.faces_before.push_back(0);
    for (const Instance& instance : instances) {
      if (instance.empty) continue;
      add(model.primitives[instance.primitive].shape, instance.world_from_object, model_tolerance);
      out_.faces_before.push_back(uint32_t(out_.faces.size()));
    }
    for (const Written& written : written_) merge(written);
  }

  Surfaces take() { return std::move(out_); }

 private:
  /// Faces that were written to be the same. What they are compared with is the first of them.
  struct Written : Known {
    Extent extent;                ///< of all their primitives
    double largest = 0;           ///< of their tolerances
    std::vector<uint32_t> faces;  ///< into Surfaces::faces
  };

  void add(const Shape& shape, const Affine& world_from_object, double model_tolerance) {
    Solid solid{.object_from_world = inverse(world_from_object),
                .extent = within(extent(shape, world_from_object), region_),
                .tolerance = 0,
                .outline = {}};
    solid.tolerance = own_tolerance(model_tolerance, solid.extent, ray_tolerance_);
    out_.frames.push_back(
        {solid.object_from_world, solid.object_from_world.point(solid.extent.center)});
    if (!is_flat(shape)) {
      solid.outline = outline(shape);
      for (Vec3& p : solid.outline) p = world_from_object.point(p);
    }
    solids_.push_back(std::move(solid));
    std::visit(AddFaces{*this, world_from_object}, shape);
  }

  /// Gives the last solid its faces, as its shape is defined.
  struct AddFaces {
    Namer& namer;
    const Affine& world_from_object;

    void operator()(const Sphere& s) const {
      if (s.facets > 0) return planes(s);
      Surface sphere;
      sphere.kind = Surface::Kind::kSphere;
      sphere.radius = s.r;
      namer.add_face(sphere, {});
    }
    void operator()(const Cylinder& c) const {
      if (c.facets > 0) return planes(c);
      Surface side;
      side.kind = Surface::Kind::kCone;
      side.z0 = c.center ? -c.h / 2 : 0;
      side.z1 = side.z0 + c.h;
      side.radius = c.r1;
      side.slope = (c.r2 - c.r1) / c.h;
      namer.add_face(side, {});
      namer.add_plane({{0, 0, -1}, -side.z0}, world_from_object);
      namer.add_plane({{0, 0, 1}, side.z1}, world_from_object);
    }
    void operator()(const Cube& s) const { planes(s); }
    void operator()(const Polyhedron& s) const { planes(s); }
    void operator()(const Halfspace& s) const { planes(s); }
    void operator()(const Mesh& s) const { planes(s); }

    void planes(const auto& flat) const {
      for (const Plane& plane : flat.facet_planes()) namer.add_plane(plane, world_from_object);
    }
  };

  void add_plane(const Plane& plane, const Affine& world_from_object) {
    Surface surface;
    surface.plane = plane;
    add_face(surface, world_plane(plane, solids_.back(), world_from_object));
  }

  /// A face of the last solid: on an earlier surface, if it was written to be, or on a new one.
  void add_face(Surface surface, const WorldPlane& at) {
    const Solid& solid = solids_.back();
    const double fine = equal_tolerance(solid.tolerance, ray_tolerance_);
    // Equal planes are equal everywhere, not only where one of the primitives is.
    const Extent everywhere = {region_.center(), 0.5 * region_.diagonal(), 0};
    const auto same_as = [&](const Written& known) -> std::optional<bool> {
      if (known.surface.kind != surface.kind) return std::nullopt;
      const double allowed = std::min(fine, known.tolerance);
      return surface.kind == Surface::Kind::kPlane ? same_plane(known.at, at, everywhere, allowed)
                                                   : lies_on(known.surface, solid, allowed);
    };
    uint32_t i = 0;
    std::optional<bool> other_side;
    while (i < written_.size() && !(other_side = same_as(written_[i]))) ++i;
    if (i == written_.size()) {
      surface.frame = uint32_t(solids_.size() - 1);
      written_.push_back({{surface, at, fine}, solid.extent, 0, {}});
    }
    Written& written = written_[i];
    written.extent = united(written.extent, solid.extent);
    written.largest = std::max(written.largest, solid.tolerance);
    written.faces.push_back(uint32_t(out_.faces.size()));
    solid_of_.push_back(uint32_t(solids_.size() - 1));
    out_.faces.push_back({i, other_side.value_or(false)});
  }

  /// Finds the surface that all these faces lie on.
  void merge(const Written& written) {
    const double tolerance = joint_tolerance(written.largest, written.extent.width, ray_tolerance_);
    for (uint32_t i = 0; i < known_.size(); ++i)
      if (move_onto(i, written, std::min(tolerance, known_[i].tolerance))) return;
    for (const uint32_t face : written.faces) out_.faces[face].surface = uint32_t(known_.size());
    known_.push_back({written.surface, written.at, tolerance});
    out_.all.push_back(written.surface);
  }

  bool move_onto(uint32_t i, const Written& written, double allowed) {
    const Known& known = known_[i];
    if (known.surface.kind != written.surface.kind) return false;
    std::vector<bool> other_side;
    for (const uint32_t face : written.faces) {
      std::optional<bool> other;
      if (written.surface.kind == Surface::Kind::kPlane) {
        other = same_plane(known.at, written.at, written.extent, allowed);
        if (other) other = *other != out_.faces[face].other_side;
      } else {
        other = lies_on(known.surface, solids_[solid_of_[face]], allowed);
      }
      if (!other) return false;
      other_side.push_back(*other);
    }
    for (size_t k = 0; k < other_side.size(); ++k)
      out_.faces[written.faces[k]] = {i, other_side[k]};
    return true;
  }

  /// Whether the whole outline lies on one nappe of the curved surface, and if so, on the other
  /// one?
  std::optional<bool> lies_on(const Surface& s, const Solid& solid, double allowed) const {
    const Affine& object_from_world = out_.frames[s.frame].object_from_world;
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

  Box region_;
  double ray_tolerance_ = 0;
  Surfaces out_;
  std::vector<Solid> solids_;
  std::vector<uint32_t> solid_of_;  ///< one a face
  std::vector<Written> written_;
  std::vector<Known> known_;
};

}  // namespace

Surfaces name_surfaces(const Model& model, std::span<const Instance> instances) {
  return Namer(model, instances).take();
}

}  // namespace whittle
