// What a boundary says in a cell: a formula over the planes of the triangles that reach it.
//
// The planes cut the cell into parts, and within a part nothing of the boundary is met, so that it
// is inside or outside as a whole. A binary space partition by those planes (Fuchs, Kedem, Naylor
// 1980; Thibault and Naylor 1987) is such a formula: with h the half-space of a node, B what is
// said behind its plane and F what is said in front of it, (h and B) or (not h and F).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lower/boundary.h"
#include "lower/scene.h"
#include "subdivide/classify.h"

namespace whittle {

/// Used by one thread at a time; its memory serves all cells.
class LocalBsp {
 public:
  explicit LocalBsp(const Scene& scene) : scene_(scene) {}

  /// More half-spaces than this are not counted.
  static constexpr uint32_t kMostCounted = 8;
  static constexpr uint32_t kTooMany = UINT32_MAX;

  /// How many half-spaces the triangles in a cell lie on; kTooMany for more than kMostCounted. With
  /// 0 the cell is inside or outside as a whole: is_inside().
  uint32_t count(const Unit& unit, const CellBox& cell);

  /// Of a cell in which there is no triangle.
  bool is_inside(const Unit& unit, const CellBox& cell) const;

  /// The formula in the cell: an operand, whose groups have no passes among them. An empty group if
  /// it is constant there. What it refers to is overwritten by the next call.
  std::span<const Token> formula(const Unit& unit, const CellBox& cell, bool negated);
  /// Of that formula: how many operands its outermost group has.
  uint32_t operands() const { return operands_; }

 private:
  /// q is relative to the cell's middle; inside the half-space where n.q + value <= 0.
  struct CellPlane {
    Vec3 n;
    double value;
    uint32_t half_space, face;
    double at(Vec3 q) const { return dot(n, q) + value; }
  };
  /// A triangle, as far as it is in one part of the cell. Convex.
  struct Polygon {
    uint32_t first, count;  ///< into corners_
    uint32_t plane;
    int outward;  ///< 1: its plane's inside is behind it; -1: in front of it
  };
  /// Of the tree: child[1] is where n.q + value <= 0. A child that is no node is a part: kPart +
  /// its number.
  struct Node {
    uint32_t plane;
    uint32_t child[2];
    Vec3 sample;  ///< a point of one of its polygons,
    double room;  ///< and how far that is from the polygon's edges and from all other planes
    int jump;     ///< by how much the winding number grows through it, from front to back
  };
  static constexpr uint32_t kPart = 1u << 31;
  /// A node's value once constants have gone.
  enum class Form : uint8_t { kFalse, kTrue, kBehind, kInFront, kAnd, kAndNot, kOr, kOrNot, kBoth };

  uint32_t plane_of(uint32_t face, std::span<const Vec3> polygon, const CellBox& cell);
  double width_of(std::span<const Vec3> polygon) const;
  void measure_slack(const Boundary& boundary, const CellBox& cell);
  void collect(const Boundary& boundary, const CellBox& cell, Vec3 reach);
  void clip(uint32_t axis, int sign, double limit);
  void build();
  uint32_t choose(std::span<const uint32_t> polygons);
  void divide(std::span<const uint32_t> polygons, uint32_t plane, Node& node);
  void split(const Polygon& polygon, uint32_t plane, Polygon& front, Polygon& back);
  uint32_t part_at(uint32_t node, Vec3 q) const;
  void label(const Boundary& boundary, const CellBox& cell);
  Form form_of(const Node& node) const;
  Form form_of_child(uint32_t child) const;
  void write(bool negated);

  const Scene& scene_;
  /// Corners are no farther from their planes than this: what is thinner tells nothing about sides.
  double slack_ = 0;
  std::vector<CellPlane> planes_;
  std::vector<Vec3> corners_;
  std::vector<Polygon> polygons_;
  std::vector<Node> nodes_;
  std::vector<int> windings_;  ///< by part
  std::vector<Form> forms_;    ///< by node
  Formula tokens_;
  uint32_t operands_ = 0;
  // Scratch.
  std::vector<uint32_t> counted_, list_, lists_, front_, back_;
  std::vector<Vec3> cut_;
};

}  // namespace whittle
