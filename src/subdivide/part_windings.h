// The winding numbers of the parts of a cell.
#pragma once

#include <cstdint>
#include <vector>

#include "subdivide/bsp_tree.h"

namespace whittle {

/// Its memory serves all cells.
///
/// A node tells by how much the winding numbers differ of the two parts on either side of its
/// sample, so the n - 1 nodes relate all n parts, and one of them is looked up in the whole
/// boundary. That goes for samples with room around them. What is only held together by others is
/// looked up by itself; only where nothing in it has room does it follow from its neighbours.
class PartWindings {
 public:
  void find(const Boundary& boundary, const CellBox& cell, const CellPolygons& in,
            const BspTree& tree);

  int of(uint32_t part) const { return winding_[part]; }

 private:
  /// A part, in a set of parts whose differences are known (union-find).
  struct Member {
    uint32_t parent;  ///< itself if it is the root
    int more;         ///< its winding number less the parent's
    Vec3 probe;       ///< a point of it,
    double distance;  ///< and how far that is from all planes nearby; negative: none
    bool is_known;    ///< roots: the whole set is
    int winding;      ///< if it is
  };
  struct Place {
    uint32_t root;
    int more;
  };

  Place find_root(uint32_t part);
  void relate(const BspTree::Node& node, const CellPolygons& in, const BspTree& tree);
  bool look_up(const Boundary& boundary, const CellBox& cell, double least_distance);

  std::vector<Member> members_;
  std::vector<uint32_t> best_;  ///< by root: the part whose probe is the farthest from planes
  std::vector<int> winding_;
};

}  // namespace whittle
