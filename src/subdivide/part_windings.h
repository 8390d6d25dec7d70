// The winding numbers of the parts of a cell.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "subdivide/bsp_tree.h"
#include "subdivide/linear_program.h"

namespace whittle {

/// Its memory serves all cells.
///
/// A node says by how much the winding number changes across its sample, from the part on one side
/// to that on the other. So the n - 1 nodes relate all n parts, and one part is looked up in the
/// whole boundary.
///
/// This relies on samples with room around them. Parts that are related only by samples without
/// room are looked up by themselves, at a point that no triangle is near. Only where there is no
/// such point does a part follow from its neighbours after all.
class PartWindings {
 public:
  void find(const Boundary& boundary, const CellBox& cell, const CellPolygons& in,
            const BspTree& tree);

  int of(uint32_t part) const { return winding_[part]; }

 private:
  /// A part, in a set of parts whose differences are known (union-find).
  struct Member {
    uint32_t parent = 0;     ///< itself if it is the root
    int more = 0;            ///< its winding number less the parent's
    bool is_known = false;   ///< roots: the whole set is,
    int winding = 0;         ///< and what it is here
    bool is_probed = false;  ///< there was a point in it, but too near a triangle:
    Vec3 probe = {};
  };
  struct Place {
    uint32_t root;
    int more;
  };
  struct Around {
    const Boundary& boundary;
    const CellBox& cell;
    const CellPolygons& polygons;
    const BspTree& tree;
  };

  Place find_root(uint32_t part);
  void relate(const BspTree::Node& node, const CellPolygons& in, const BspTree& tree);
  std::optional<Vec3> inner_point(uint32_t part, double least, const Around& around);
  static bool is_clear(Vec3 q, const CellPolygons& in);
  void probe(Vec3 q, const Around& around);

  std::vector<Member> members_;
  size_t sets_ = 0, known_ = 0;  ///< sets in all, and those that are known
  std::vector<Constraint> limits_, moved_;
  std::vector<int> winding_;
};

}  // namespace whittle
