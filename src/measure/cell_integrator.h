// Integrals over the solid in one leaf of the cells, with bounds that are proved.
//
// A cell is cut until each part is one of these: all in the solid or all outside; a graph of one
// surface (graph_patch.h); or small enough that planes in place of the surfaces
// (quadric_cell.h) change its volume by no more than what is allowed for a part.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "boundary/leaf_function.h"
#include "measure/graph_patch.h"
#include "subdivide/cells.h"

namespace whittle {

class CellIntegrator {
 public:
  /// What is given must outlive this object.
  CellIntegrator(const Scene& scene, std::span<const PlacedHalfSpace> half_spaces,
                 const GaussTable& gauss)
      : scene_(scene),
        half_spaces_(half_spaces),
        gauss_(gauss),
        area_weight_(kAreaWeight * max_component(scene.region.size())),
        local_(half_spaces.size()) {}

  /// Half-spaces as LeafFunction wants them: each by its own number.
  static std::vector<PlacedHalfSpace> place(const Scene& scene);

  /// Adds what is in a part of a cell. No part of that may be wrong by more than `each`: its
  /// volume, or its area times kAreaWeight times the region's longest edge. Parts that were looked
  /// at are counted; when there are more than `most` it stops.
  void add(CellLink link, const Box& box, double each, uint64_t most, Integral& out);
  uint64_t parts() const { return parts_; }

 private:
  static constexpr double kAreaWeight = 1e-4;
  struct Part {
    Box box;
    uint64_t table = 0;  ///< all 64 rows, over used_
  };
  void add_program(CellLink link, const Box& box, Integral& out);
  void add_table(const Part& whole, Integral& out);
  void look_at(Part part, Integral& out);
  void add_surface(const Part& part, const Quadric& f, bool complement, Integral& out);
  bool add_cut(const Part& part, int axis, const GraphPatch& surface, bool complement,
               Integral& out);
  bool shrink(const Part& part, int axis, const GraphPatch& patch);
  void add_planes(const Part& part, std::span<const Quadric> surfaces, uint64_t table,
                  Integral& out);
  void split(const Part& part, int axis);

  const Scene& scene_;
  std::span<const PlacedHalfSpace> half_spaces_;
  const GaussTable& gauss_;
  const double area_weight_;
  double each_ = 0;
  uint64_t most_ = 0, parts_ = 0;
  LocalPlanes local_;
  LeafFunction function_;
  std::vector<uint32_t> used_;  ///< the half-spaces of the tables, at most kTableLiterals
  std::vector<Part> stack_;
};

}  // namespace whittle
