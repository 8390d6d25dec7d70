#include "subdivide/local_bsp.h"

#include <algorithm>

#include "subdivide/cell_probes.h"

namespace whittle {

uint32_t LocalBsp::count(const Unit& unit, const CellBox& cell) {
  constexpr uint32_t kMostTriangles = 64;
  const Boundary& boundary = scene_.boundaries[unit.boundary];
  const double slack = boundary.slack();
  counted_.clear();
  uint32_t triangles = 0;
  bool too_many = false;
  boundary.visit_in(cell.center, cell.half + Vec3{slack, slack, slack}, [&](uint32_t i) {
    const uint32_t number = scene_.faces[boundary.triangles()[i].face].literal >> 1;
    if (std::find(counted_.begin(), counted_.end(), number) == counted_.end())
      counted_.push_back(number);
    too_many = ++triangles > kMostTriangles || counted_.size() > kMostCounted;
    return !too_many;
  });
  return too_many ? kTooMany : uint32_t(counted_.size());
}

bool LocalBsp::is_inside(const Unit& unit, const CellBox& cell) const {
  return scene_.boundaries[unit.boundary].winding(cell.center + cell_probe(0, cell.half)) != 0;
}

std::span<const Token> LocalBsp::formula(const Unit& unit, const CellBox& cell, bool negated) {
  const Boundary& boundary = scene_.boundaries[unit.boundary];
  polygons_.collect(scene_, boundary, cell,
                    [&](const auto& take) { boundary.visit_in(cell.center, cell.half, take); });
  if (polygons_.polygons.empty()) {
    const bool value = is_inside(unit, cell) != negated;
    constant_.assign(1, Token::make(value ? TokenKind::kAnd : TokenKind::kOr, 1));
    return constant_;
  }
  tree_.build(polygons_);
  windings_.find(boundary, cell, polygons_, tree_);
  formula_.write(scene_, polygons_, tree_, windings_, negated);
  return formula_.tokens();
}

}  // namespace whittle
