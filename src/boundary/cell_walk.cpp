#include "boundary/cell_walk.h"

namespace whittle {

std::vector<WalkedLeaf> walk_leaves(const CellTree& tree, const ExactGrid& grid,
                                    PlaneTable& planes) {
  struct Open {
    const Cell* cell;
    CellSides sides;
  };
  std::vector<WalkedLeaf> leaves;
  if (tree.root == nullptr) return leaves;
  CellSides region;
  for (int axis = 0; axis < 3; ++axis) {
    region.lo[size_t(axis)] = planes.add(grid.square_plane(axis, tree.region.lo[axis]));
    region.hi[size_t(axis)] = planes.add(grid.square_plane(axis, tree.region.hi[axis]));
  }
  std::vector<Open> stack{{tree.root, region}};
  while (!stack.empty()) {
    const Open open = stack.back();
    stack.pop_back();
    const CellLink link = open.cell->link();
    if (link.kind() == CellKind::kNode) {
      const auto axis = size_t(link.axis());
      const uint32_t plane = planes.add(grid.square_plane(link.axis(), open.cell->split));
      Open low{link.children(), open.sides}, high{link.children() + 1, open.sides};
      low.sides.hi[axis] = high.sides.lo[axis] = plane;
      stack.push_back(high);
      stack.push_back(low);
    } else if (link.kind() != CellKind::kEmpty && link.kind() != CellKind::kFull) {
      leaves.push_back({link, open.sides});
    }
  }
  return leaves;
}

cell_walk::Range cell_walk::region_range(const CellTree& tree, const ExactGrid& grid,
                                         const PlaneTable& planes) {
  Range range;
  for (int axis = 0; axis < 3; ++axis) {
    const double lo = tree.region.lo[axis], hi = tree.region.hi[axis];
    range.set_lo(axis, lo, planes.find(grid.square_plane(axis, lo)));
    range.set_hi(axis, hi, planes.find(grid.square_plane(axis, hi)));
  }
  return range;
}

}  // namespace whittle
