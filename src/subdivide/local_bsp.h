// What a boundary says in a cell: a formula over the planes of the triangles that reach it.
//
// The planes cut the cell into parts, and within a part nothing of the boundary is met, so that it
// is inside or outside as a whole.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "subdivide/bsp_formula.h"
#include "subdivide/near_triangles.h"

namespace whittle {

/// Used by one thread at a time; its memory serves all cells.
class LocalBsp {
 public:
  explicit LocalBsp(const Scene& scene) : scene_(scene) {}

  /// More half-spaces than this are not counted.
  static constexpr uint32_t kMostCounted = 8;
  static constexpr uint32_t kTooMany = UINT32_MAX;

  /// How many half-spaces the triangles in a cell lie on; kTooMany for more than kMostCounted, or
  /// for too many triangles. If it is 0 the cell as a whole is inside or outside: is_inside() says
  /// which.
  ///
  /// `known`: triangles, among which are all that reach the cell. Those that do are in listed()
  /// then, if there are few.
  uint32_t count(const Unit& unit, const CellBox& cell,
                 const ListedTriangles& known = std::nullopt);
  ListedTriangles listed() const { return listed_; }

  /// Of a cell in which there is no triangle.
  bool is_inside(const Unit& unit, const CellBox& cell) const;

  /// The formula in the cell: an operand, whose groups have no passes among them. An empty group if
  /// it is constant there. What it refers to is overwritten by the next call.
  ///
  /// `known`: the triangles that reach the cell, as count() lists them.
  std::span<const Token> formula(const Unit& unit, const CellBox& cell, bool negated,
                                 const ListedTriangles& known = std::nullopt);
  /// Of that formula: how many operands its outermost group has.
  uint32_t operands() const { return formula_.operands(); }

 private:
  const Scene& scene_;
  CellPolygons polygons_;
  BspTree tree_;
  PartWindings windings_;
  BspFormula formula_;
  Formula constant_;
  std::vector<uint32_t> counted_, triangles_;
  ListedTriangles listed_;
};

}  // namespace whittle
