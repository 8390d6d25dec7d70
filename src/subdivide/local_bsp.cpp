#include "subdivide/local_bsp.h"

#include <algorithm>

#include "subdivide/cell_probes.h"

namespace whittle {
namespace {

/// The triangles that reach a cell that is larger by a margin.
template <class Visit>
void visit_in(const Boundary& boundary, const ListedTriangles& known, const CellBox& cell,
              double margin, const Visit& visit) {
  const Vec3 half = cell.half + Vec3{margin, margin, margin};
  if (known)
    boundary.visit_in(*known, cell.center, half, visit);
  else
    boundary.visit_in(cell.center, half, visit);
}

}  // namespace

uint32_t LocalBsp::count(const Unit& unit, const CellBox& cell, const ListedTriangles& known) {
  constexpr uint32_t kMostTriangles = 64;
  const Boundary& boundary = scene_.boundaries[unit.boundary];
  counted_.clear();
  triangles_.clear();
  bool is_over = false;
  const auto take = [&](uint32_t i) {
    triangles_.push_back(i);
    if (counted_.size() <= kMostCounted) {
      const uint32_t number = scene_.faces[boundary.triangles()[i].face].literal >> 1;
      if (std::find(counted_.begin(), counted_.end(), number) == counted_.end())
        counted_.push_back(number);
    }
    is_over = triangles_.size() > kMostTriangles ||
              (counted_.size() > kMostCounted && triangles_.size() > NearTriangles::kMostListed);
    return !is_over;
  };
  visit_in(boundary, known, cell, boundary.slack(), take);
  listed_ = std::nullopt;
  if (triangles_.size() <= NearTriangles::kMostListed) listed_ = triangles_;
  return is_over || counted_.size() > kMostCounted ? kTooMany : uint32_t(counted_.size());
}

bool LocalBsp::is_inside(const Unit& unit, const CellBox& cell) const {
  return scene_.boundaries[unit.boundary].winding(cell.center + cell_probe(0, cell.half)) != 0;
}

std::span<const Token> LocalBsp::formula(const Unit& unit, const CellBox& cell, bool negated,
                                         const ListedTriangles& known) {
  const Boundary& boundary = scene_.boundaries[unit.boundary];
  polygons_.collect(scene_, boundary, cell, [&](const auto& take) {
    if (known)
      std::ranges::for_each(*known, take);
    else
      visit_in(boundary, known, cell, boundary.slack(), take);
  });
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
