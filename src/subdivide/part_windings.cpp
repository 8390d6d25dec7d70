#include "subdivide/part_windings.h"

#include <algorithm>
#include <cmath>

#include "subdivide/cell_probes.h"

namespace whittle {

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

/// Looks up every set by that of its probes which is the farthest from planes, if it is far enough.
/// Whether all are known then.
bool PartWindings::look_up(const Boundary& boundary, const CellBox& cell, double least_distance) {
  best_.assign(members_.size(), UINT32_MAX);
  for (uint32_t i = 0; i < members_.size(); ++i) {
    uint32_t& best = best_[find_root(i).root];
    if (best == UINT32_MAX || members_[i].distance > members_[best].distance) best = i;
  }
  bool all = true;
  for (uint32_t root = 0; root < members_.size(); ++root) {
    Member& member = members_[root];
    const uint32_t best = best_[root];
    if (best == UINT32_MAX || member.is_known) continue;
    if (!(members_[best].distance > least_distance)) {
      all = false;
      continue;
    }
    member.is_known = true;
    member.winding = boundary.winding(cell.center + members_[best].probe) - find_root(best).more;
  }
  return all;
}

void PartWindings::find(const Boundary& boundary, const CellBox& cell, const CellPolygons& in,
                        const BspTree& tree) {
  members_.resize(tree.parts());
  for (uint32_t i = 0; i < members_.size(); ++i) members_[i] = {i, 0, {}, -1, false, 0};
  const auto probe = [&](Vec3 q) {
    double distance = kInfinity;
    for (const CellPolygons::Plane& plane : in.planes)
      distance = std::min(distance, std::fabs(plane.at(q)));
    Member& member = members_[tree.part_at(0, q, in)];
    if (distance > member.distance) member.probe = q, member.distance = distance;
  };
  for (const BspTree::Node& node : tree.nodes())
    for (const double side : {0.5, -0.5})
      probe(node.sample + in.planes[node.plane].n * (side * node.room));
  const double enough = 4 * in.slack;
  for (const BspTree::Node& node : tree.nodes())
    if (node.room > enough) relate(node, in, tree);
  if (!look_up(boundary, cell, enough)) {
    for (size_t i = 0; i < kCellProbes.size(); ++i) probe(cell_probe(i, cell.half));
    look_up(boundary, cell, enough);
  }
  for (const BspTree::Node& node : tree.nodes())
    if (!(node.room > enough)) relate(node, in, tree);
  // Nothing in the cell has room.
  look_up(boundary, cell, -kInfinity);
  winding_.resize(members_.size());
  for (uint32_t i = 0; i < members_.size(); ++i) {
    const Place at = find_root(i);
    winding_[i] = members_[at.root].winding + at.more;
  }
}

}  // namespace whittle
