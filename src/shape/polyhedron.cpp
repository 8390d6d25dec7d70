#include "shape/polyhedron.h"

#include "shape/corner_tree.h"
#include "shape/points.h"

namespace whittle {
namespace {

bool is_face(const std::vector<uint32_t>& loop) {
  return loop.size() >= 3;
}

/// The points that faces use.
std::vector<uint32_t> corners_of(const Polyhedron& p) {
  std::vector<bool> used(p.points.size());
  std::vector<uint32_t> corners;
  for (const auto& face : p.faces) {
    if (!is_face(face)) continue;
    for (const uint32_t i : face)
      if (!used[i]) used[i] = true, corners.push_back(i);
  }
  return corners;
}

/// Of each point, those that an edge leads to.
std::vector<std::vector<uint32_t>> neighbours_of(const Polyhedron& p) {
  std::vector<std::vector<uint32_t>> neighbours(p.points.size());
  for (const auto& face : p.faces) {
    if (!is_face(face)) continue;
    for (size_t k = 0; k < face.size(); ++k) {
      const uint32_t a = face[k], b = face[(k + 1) % face.size()];
      neighbours[a].push_back(b);
      neighbours[b].push_back(a);
    }
  }
  return neighbours;
}

}  // namespace

std::vector<Vec3> Polyhedron::outline() const {
  std::vector<Vec3> corners;
  for (const uint32_t i : corners_of(*this)) corners.push_back(points[i]);
  return corners;
}

std::vector<Box> Polyhedron::facet_boxes() const {
  Box whole;
  std::vector<CornerTree::Corner> corners;
  for (const uint32_t i : corners_of(*this)) {
    whole.include(points[i]);
    corners.push_back({points[i], {}, i});
  }
  for (CornerTree::Corner& corner : corners) corner.normal = corner.place - whole.center();
  const CornerTree tree(std::move(corners));

  // A facet's corners are the points on its plane, to the precision of text; if its planes stand
  // off the corners by more, a point of a facet is no farther than `slack` from some face, if no
  // edge is much sharper than a right angle, and so from what of that face is less than `slack`
  // below the plane. All that goes into the box.
  const double precision = 2e-5 * whole.diagonal();
  const bool is_loose = 4 * rise > precision;
  const double slack = is_loose ? 4 * rise : precision;
  std::vector<std::vector<uint32_t>> neighbours;
  if (is_loose) neighbours = neighbours_of(*this);
  std::vector<Box> boxes;
  boxes.reserve(planes.size());
  for (const Plane& plane : planes) {
    Box& box = boxes.emplace_back();
    const auto below = [&](Vec3 p) { return plane.d - dot(plane.n, p); };
    const auto add = [&](const CornerTree::Corner& corner) {
      const double depth = below(corner.place);
      if (!(depth <= slack)) return;
      box.include(corner.place);
      if (!is_loose) return;
      for (const uint32_t next : neighbours[corner.number]) {
        const double next_depth = below(points[next]);
        if (next_depth <= slack) continue;
        const double t = (slack - depth) / (next_depth - depth);
        box.include(corner.place + (points[next] - corner.place) * t);
      }
    };
    tree.search(
        plane.n, whole.center(),
        [&](double most_height, double) { return plane.d - most_height <= slack; }, add);
    if (!is_loose) continue;
    box.lo -= Vec3{slack, slack, slack};
    box.hi += Vec3{slack, slack, slack};
  }
  return boxes;
}

Box Polyhedron::box(const Affine& map) const {
  return box_of(outline(), map);
}

}  // namespace whittle
