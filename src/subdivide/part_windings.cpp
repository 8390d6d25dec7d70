#include "subdivide/part_windings.h"

#include <algorithm>
#include <cmath>

#include "subdivide/cell_probes.h"

namespace whittle {
namespace {

/// How far it is from a point in the box from -half to half to its sides; what is beyond them,
/// planes in the box do not tell. 0 from outside.
double way_out(Vec3 p, Vec3 direction, Vec3 half) {
  double far = kInfinity;
  for (int axis = 0; axis < 3; ++axis) {
    const double speed = std::fabs(direction[axis]);
    const double left = half[axis] - (direction[axis] > 0 ? p[axis] : -p[axis]);
    if (speed > 0) far = std::min(far, std::max(left, 0.0) / speed);
  }
  return far;
}

}  // namespace

PartWindings::Place PartWindings::find_root(uint32_t part) {
  int more = 0;
  uint32_t root = part;
  while (members_[root].parent != root) more += members_[root].more, root = members_[root].parent;
  // All on the way now lead straight to the root.
  int rest = more;
  while (members_[part].parent != root && part != root) {
    const Member before = members_[part];
    members_[part].parent = root;
    members_[part].more = rest;
    rest -= before.more;
    part = before.parent;
  }
  return {root, more};
}

/// Joins the sets of the parts on either side of a node's sample, unless both are known.
void PartWindings::relate(const BspTree::Node& node, const CellPolygons& in, const BspTree& tree) {
  const Place front = find_root(tree.part_at(node.child[0], node.sample, in)),
              back = find_root(tree.part_at(node.child[1], node.sample, in));
  if (front.root == back.root) return;
  Member &a = members_[front.root], &b = members_[back.root];
  if (a.is_known && b.is_known) return;
  --sets_;
  // w(back) = w(front) + jump.
  const int b_less_a = front.more + node.jump - back.more;
  if (b.is_known) {
    a.parent = back.root;
    a.more = -b_less_a;
  } else {
    b.parent = front.root;
    b.more = b_less_a;
  }
}

/// Whether a point is so far from all triangles that the winding number there is certain.
bool PartWindings::is_clear(Vec3 q, const CellPolygons& in) {
  const double reach = 2 * in.slack;
  const auto is_near = [&](const CellPolygons::Polygon& polygon) {
    const CellPolygons::Plane& plane = in.planes[polygon.plane];
    if (std::fabs(plane.at(q)) > reach) return false;
    Box box;
    for (const Vec3& corner : in.corners_of(polygon)) box.include(corner);
    const Vec3 all{reach, reach, reach};
    if (!Box{box.lo - all, box.hi + all}.contains(q)) return false;
    return depth_in(in.corners_of(polygon), plane.n * double(polygon.outward), in.slack, q) >=
           -reach;
  };
  return std::ranges::none_of(in.polygons, is_near);
}

/// Looks up the set of the part that a point is in, unless it is known, or the point is too near a
/// triangle.
void PartWindings::probe(Vec3 q, const Around& around) {
  const uint32_t part = around.tree.part_at(0, q, around.polygons);
  const Place at = find_root(part);
  Member& root = members_[at.root];
  if (root.is_known) return;
  if (!is_clear(q, around.polygons)) {
    root.is_probed = true;
    root.probe = q;
    return;
  }
  root.is_known = true;
  root.winding = around.boundary.winding(around.cell.center + q) - at.more;
  ++known_;
}

/// A point of a part that is farther than `least` from what bounds it, if there is one: with about
/// half as much room as there can be.
std::optional<Vec3> PartWindings::inner_point(uint32_t part, double least, const Around& around) {
  // The way from the part to the root.
  const std::vector<BspTree::Node>& nodes = around.tree.nodes();
  limits_.clear();
  uint32_t child = BspTree::kPart | part;
  for (uint32_t n = uint32_t(nodes.size()); n-- > 0;) {
    // Parents stand before their children.
    for (const int side : {0, 1}) {
      if (nodes[n].child[side] != child) continue;
      const CellPolygons::Plane& plane = around.polygons.planes[nodes[n].plane];
      const double sign = side == 0 ? -1 : 1;
      limits_.push_back({plane.n * sign, -plane.value * sign});
      child = n;
      break;
    }
  }
  // Triangles were taken from a little beyond the cell, and a part may have room only there: a film
  // between a plane and the cell's side.
  const Vec3 half = around.cell.half + Vec3{1, 1, 1} * (2 * around.polygons.slack);
  const double most = 0.5 * std::min({half.x, half.y, half.z});
  const auto point_with = [&](double room) {
    moved_ = limits_;
    for (Constraint& limit : moved_) limit.d -= room;
    return farthest_point({0, 0, 1}, moved_, half - Vec3{room, room, room});
  };
  // What has room has room for less.
  std::optional<Vec3> found;
  int few = 0, many = std::max(int(std::log2(most / least)), 0) + 1;  // halvings
  while (few < many) {
    const int halvings = (few + many) / 2;
    const double room = std::ldexp(most, -halvings);
    const std::optional<Vec3> q = room > least ? point_with(room) : std::nullopt;
    if (q) found = q;
    (q ? many : few) = q ? halvings : halvings + 1;
  }
  return found;
}

void PartWindings::find(const Boundary& boundary, const CellBox& cell, const CellPolygons& in,
                        const BspTree& tree) {
  const Around around{boundary, cell, in, tree};
  members_.resize(tree.parts());
  for (uint32_t i = 0; i < members_.size(); ++i) members_[i] = {.parent = i};
  sets_ = members_.size();
  known_ = 0;
  const double enough = 4 * in.slack;
  for (const BspTree::Node& node : tree.nodes())
    if (node.room > enough && node.from_bounds > enough) relate(node, in, tree);
  for (const BspTree::Node& node : tree.nodes()) {
    if (known_ == sets_) break;
    const Vec3 n = in.planes[node.plane].n;
    for (const Vec3 way : {n, -n}) {
      const double far = std::min(node.room, way_out(node.sample, way, cell.half));
      probe(node.sample + way * (0.5 * far), around);
    }
  }
  for (size_t i = 0; i < kCellProbes.size() && known_ < sets_; ++i)
    probe(cell_probe(i, cell.half), around);
  for (uint32_t part = 0; part < members_.size() && known_ < sets_; ++part) {
    if (members_[find_root(part).root].is_known) continue;
    if (const std::optional<Vec3> q = inner_point(part, in.slack / 16, around)) probe(*q, around);
  }
  if (known_ < sets_) {
    // Films between planes that lie on one another, but for the slack: nothing in them is clear.
    for (const BspTree::Node& node : tree.nodes())
      if (node.room > enough && !(node.from_bounds > enough)) relate(node, in, tree);
    for (const BspTree::Node& node : tree.nodes())
      if (!(node.room > enough)) relate(node, in, tree);
    // Where nothing in the cell is clear.
    for (const Member& member : members_) {
      if (!member.is_probed) continue;
      const Place at = find_root(tree.part_at(0, member.probe, in));
      Member& root = members_[at.root];
      if (root.is_known) continue;
      root.is_known = true;
      root.winding = boundary.winding(cell.center + member.probe) - at.more;
    }
  }
  winding_.resize(members_.size());
  for (uint32_t i = 0; i < members_.size(); ++i) {
    const Place at = find_root(i);
    winding_[i] = members_[at.root].winding + at.more;
  }
}

}  // namespace whittle
