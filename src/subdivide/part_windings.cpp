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

/// Looks up the set of the part that a point is in, unless it is known, or the point is too near a
/// plane.
void PartWindings::probe(Vec3 q, double least_distance, const Around& around) {
  const uint32_t part = around.tree.part_at(0, q, around.polygons);
  const Place at = find_root(part);
  Member& root = members_[at.root];
  if (root.is_known) return;
  double distance = kInfinity;
  for (const CellPolygons::Plane& plane : around.polygons.planes)
    distance = std::min(distance, std::fabs(plane.at(q)));
  if (!(distance > least_distance)) {
    if (distance > root.distance) root.probe = q, root.distance = distance, root.probed = part;
    return;
  }
  root.is_known = true;
  root.winding = around.boundary.winding(around.cell.center + q) - at.more;
  ++known_;
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
    if (node.room > enough) relate(node, in, tree);
  for (const BspTree::Node& node : tree.nodes()) {
    if (known_ == sets_) break;
    const Vec3 n = in.planes[node.plane].n;
    for (const Vec3 way : {n, -n}) {
      const double far = std::min(node.room, way_out(node.sample, way, cell.half));
      probe(node.sample + way * (0.5 * far), enough, around);
    }
  }
  for (size_t i = 0; i < kCellProbes.size() && known_ < sets_; ++i)
    probe(cell_probe(i, cell.half), enough, around);
  if (known_ < sets_) {
    for (const BspTree::Node& node : tree.nodes())
      if (!(node.room > enough)) relate(node, in, tree);
    // Where nothing in the cell has room.
    for (Member& member : members_) {
      const Place at = find_root(member.probed);
      Member& root = members_[at.root];
      if (root.is_known || member.distance < 0) continue;
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
