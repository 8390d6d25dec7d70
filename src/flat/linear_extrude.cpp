#include <algorithm>
#include <cmath>

#include "flat/extrude.h"
#include "flat/mesh_builder.h"
#include "flat/sides.h"
#include "flat/slices.h"
#include "flat/triangulation.h"

namespace whittle {

namespace {

/// With what its fields may say, and a scale that is not negative.
LinearExtrude normalized(LinearExtrude how) {
  how.scale = {std::max(how.scale.x, 0.0), std::max(how.scale.y, 0.0)};
  return how;
}

class LinearExtruder {
 public:
  LinearExtruder(const WeldedPolygons& base, const LinearExtrude& how, int slices)
      : base_(base), how_(how), slices_(slices), shift_(vector(how)) {}

  TriangleMesh run() && {
    rings_.reserve(size_t(slices_) + 1);
    for (int j = 0; j <= slices_; ++j) rings_.push_back(ring(j));
    for (const ContourSide& side : sides(base_)) add_side(side);
    for (const auto& [a, b, c] : triangulate(base_)) {
      add_cap(a, c, b, rings_.front(), -1);
      add_cap(a, b, c, rings_.back(), 1);
    }
    return std::move(builder_).finish();
  }

  static Vec3 vector(const LinearExtrude& how) {
    return how.direction ? *how.direction * how.height : Vec3{0, 0, how.height};
  }

 private:
  using Ring = std::vector<uint32_t>;

  Vec3 place(double t, Vec2 bottom) const {
    const Vec2 p = slice_point(how_, t, bottom);
    return Vec3{p.x, p.y, 0} + shift_ * (how_.center ? t - 0.5 : t);
  }

  Ring ring(int j) {
    Ring numbers;
    numbers.reserve(base_.points.size());
    for (const Vec2 p : base_.points) numbers.push_back(builder_.point(place(t(j), p)));
    return numbers;
  }

  double t(int j) const { return double(j) / slices_; }

  void add_cap(uint32_t a, uint32_t b, uint32_t c, const Ring& ring, double z) {
    // The top may have collapsed to a point, and then there is nothing, or to a line. Then its
    // triangles have no area, but they close the mesh.
    if (ring[a] == ring[b] || ring[b] == ring[c] || ring[c] == ring[a]) return;
    const double height = builder_[ring[a]].z;
    builder_.triangle(ring[a], ring[b], ring[c], builder_.facet({{0, 0, z}, z * height}));
  }

  void add_side(const ContourSide& side) {
    // An edge along an axis stays so under any scale; under one factor all edges keep their
    // direction.
    const Vec2 edge = side.line_to - side.line_from;
    const bool is_planar =
        how_.twist_degrees == 0 && (how_.scale.x == how_.scale.y || edge.x == 0 || edge.y == 0);
    const uint32_t facet = is_planar ? builder_.facet(plane(side.line_from, edge)) : 0;
    for (int j = 0; j < slices_; ++j) {
      const Ring &low = rings_[size_t(j)], &high = rings_[size_t(j) + 1];
      const std::array<uint32_t, 4> corners = {low[side.from], low[side.to], high[side.to],
                                               high[side.from]};
      if (is_planar)
        add_quad(corners, {facet, facet}, true);
      else
        add_curved(corners, prefers_02(corners, side.is_hole) != collapses(j + 1));
    }
  }

  /// The plane that an edge sweeps when it keeps its direction.
  Plane plane(Vec2 from, Vec2 edge) const {
    const double size = length(edge);
    const Vec2 along = edge * (1 / size);
    // How the extrusion leans across the edge, in the plane of the base.
    const Vec3 up = place(1, from) - place(0, from);
    const Vec2 out = {along.y, -along.x};
    const double lean = out.x * up.x + out.y * up.y;
    const double slant = std::hypot(up.z, lean);
    const Vec3 n = lean == 0 ? Vec3{out.x, out.y, 0}
                             : Vec3{out.x * (up.z / slant), out.y * (up.z / slant), -lean / slant};
    return {n, dot(n, place(0, from))};
  }

  void add_quad(const std::array<uint32_t, 4>& q, std::array<uint32_t, 2> facets, bool split_02) {
    if (split_02) {
      builder_.triangle(q[0], q[1], q[2], facets[0]);
      builder_.triangle(q[0], q[2], q[3], facets[1]);
    } else {
      builder_.triangle(q[0], q[1], q[3], facets[0]);
      builder_.triangle(q[1], q[2], q[3], facets[1]);
    }
  }

  void add_curved(const std::array<uint32_t, 4>& q, bool split_02) {
    const auto facet = [&](uint32_t a, uint32_t b, uint32_t c) {
      return a == b || b == c || c == a ? 0 : builder_.facet_of(a, b, c);
    };
    if (split_02)
      add_quad(q, {facet(q[0], q[1], q[2]), facet(q[0], q[2], q[3])}, true);
    else
      add_quad(q, {facet(q[0], q[1], q[3]), facet(q[1], q[2], q[3])}, false);
  }

  /// Whether the slice is a line or a point. OpenSCAD takes the longer diagonals below that.
  bool collapses(int j) const { return j == slices_ && (how_.scale.x == 0 || how_.scale.y == 0); }

  /// Whether the diagonal 02 is the shorter one. Equal ones follow the twist.
  bool prefers_02(const std::array<uint32_t, 4>& q, bool is_hole) const {
    constexpr double kEqual = 1e-5;
    const auto flat_distance = [&](uint32_t a, uint32_t b) {
      const Vec3 between = builder_[a] - builder_[b];
      return std::hypot(between.x, between.y);
    };
    const double d02 = flat_distance(q[0], q[2]), d13 = flat_distance(q[1], q[3]);
    if (2 * std::abs(d02 - d13) > kEqual * (d02 + d13)) return d02 < d13;
    return (how_.twist_degrees > 0) != is_hole;
  }

  const WeldedPolygons& base_;
  const LinearExtrude& how_;
  const int slices_;
  const Vec3 shift_;
  MeshBuilder builder_;
  std::vector<Ring> rings_;
};

}  // namespace

TriangleMesh linear_extrude(const Polygons& polygons, const LinearExtrude& as_written) {
  const LinearExtrude how = normalized(as_written);
  const Vec3 shift = LinearExtruder::vector(how);
  if (!(how.height > 0 && shift.z > 0) || !is_finite(shift) || !is_finite(how.scale) ||
      !std::isfinite(how.twist_degrees))
    return {};
  double edges = 0;
  for (const Contour& contour : polygons.contours) edges += double(contour.size());
  const double most = std::max(kMaxSides / std::max(edges, 1.0), 1.0);
  const int slices = is_curved(how) ? slice_count(polygons, how, int(most)) : 1;
  const WeldedPolygons base =
      weld(divided_outlines(polygons, how, slices, std::max(kMaxSides / slices, edges)));
  if (base.contours.empty()) return {};
  return LinearExtruder(base, how, slices).run();
}

}  // namespace whittle
