// A binary space partition of a cell by the planes of its polygons (Fuchs, Kedem, Naylor, On
// visible surface generation by a priori tree structures, 1980).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "subdivide/cell_polygons.h"

namespace whittle {

/// Its memory serves all cells.
class BspTree {
 public:
  struct Node {
    uint32_t plane = 0;
    /// In front of the plane, and where plane.at(q) <= 0. Nodes, which stand behind their parents,
    /// or parts: kPart + number.
    uint32_t child[2] = {0, 0};
    Vec3 sample = {};  ///< a point of one of its polygons,
    double room = 0;   ///< how far it is from planes below and polygons' edges; may be 0,
    /// and how far from the planes that bound its part. Along a fold of hardly any angle a polygon
    /// may go on beyond the other one's plane by far more than either is off its own.
    double from_bounds = 0;
    int jump = 0;  ///< by how much the winding number grows there, from front to back
  };
  static constexpr uint32_t kPart = 1u << 31;

  /// Polygons are cut on the way. Precondition: there are some.
  void build(CellPolygons& in);

  const std::vector<Node>& nodes() const { return nodes_; }
  uint32_t parts() const { return parts_; }
  /// The part that a point is in, from a child or, with 0, from the root.
  uint32_t part_at(uint32_t from, Vec3 q, const CellPolygons& in) const {
    while ((from & kPart) == 0)
      from = nodes_[from].child[in.planes[nodes_[from].plane].at(q) <= 0 ? 1 : 0];
    return from & ~kPart;
  }

 private:
  uint32_t choose(std::span<const uint32_t> polygons, const CellPolygons& in) const;
  void divide(std::span<const uint32_t> polygons, uint32_t plane, CellPolygons& in);
  void take_sample(std::span<const uint32_t> polygons, uint32_t parent, const CellPolygons& in,
                   Node& node);

  /// A part of the cell that may be divided.
  struct Open {
    uint32_t first, last;  ///< into lists_
    uint32_t parent, side;
  };

  std::vector<Node> nodes_;
  uint32_t parts_ = 0;
  std::vector<uint32_t> parents_;  ///< of nodes; UINT32_MAX: the root has none
  std::vector<Open> open_;
  // Scratch: numbers of polygons.
  std::vector<uint32_t> list_, lists_, front_, back_, on_, other_planes_;
};

}  // namespace whittle
