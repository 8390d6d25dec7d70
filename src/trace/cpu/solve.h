// Solves one leaf along one ray.
#pragma once

#include <span>
#include <vector>

#include "subdivide/cells.h"

namespace whittle {

/// A ray in local coordinates; t counts from its origin.
struct LocalRay {
  Vec3 origin, direction;
};

/// Whether a ray is in the solid, as far as it has come.
enum class Inside : int8_t { kNo, kYes, kUnknown };

/// Where the solid changes along a ray.
struct Change {
  double t;
  uint32_t id;  ///< owner primitive
  Vec3 normal;  ///< unit, outward from the solid
};

class LeafSolver {
 public:
  LeafSolver(const Scene& scene, const CellTree& tree) : scene_(scene), tree_(tree) {}

  /// Finds the first t in (t0, t1] at which the solid in this leaf changes from what `inside` says,
  /// or t0 if it differs there already. Otherwise false, and `inside` tells the value at t1.
  /// Unknown becomes known at t0 and is no change. Crossings at equal t happen together.
  bool first_change(CellKind kind, const Leaf& leaf, const LocalRay& ray, double t0, double t1,
                    Inside& inside, Change& change);

  /// Times that a leaf differed at t0 from what its neighbour had said.
  uint64_t disagreements = 0;

 private:
  struct Crossing {
    double t;
    uint32_t literal;
  };
  /// Lists the crossings in (t0, t1] and the literals' values at t0. Returns the solid's value if
  /// one literal settles it along the whole way.
  Inside cross(CellKind kind, std::span<const LeafLiteral> literals, const LocalRay& ray, double t0,
               double t1);
  void add_crossing(double t, uint32_t literal);
  void start(CellKind kind, const Leaf& leaf, std::span<const LeafLiteral> literals);
  void flip(CellKind kind, std::span<const LeafLiteral> literals, uint32_t literal);
  bool value(CellKind kind, const Leaf& leaf, std::span<const LeafLiteral> literals) const;
  Change describe(const Leaf& leaf, std::span<const LeafLiteral> literals, const LocalRay& ray,
                  double t, std::span<const Crossing> group, bool solid_after) const;
  /// The face that owns a change which several primitives share (docs/conventions.md, tie rules).
  const Face& owner(const Leaf& leaf, std::span<const LeafLiteral> literals, Vec3 point,
                    std::span<const Crossing> group) const;

  const Scene& scene_;
  const CellTree& tree_;
  std::vector<uint8_t> is_inside_;   ///< by literal: inside the half-space itself, at this point
  std::vector<Crossing> crossings_;  ///< in (t0, t1], sorted
  Crossing nearest_{};               ///< the literal whose surface is nearest to the point at t0
  uint64_t state_ = 0;               ///< kTable: the bits of is_inside_
  uint32_t count_ = 0;               ///< conjunction, disjunction: literals that are true
};

}  // namespace whittle
