// Moves faces onto earlier ones that they lie on, in two steps (docs/conventions.md, Coincidence).
//
// First, faces that were written to be the same become one surface. Then, in file order, each of
// these surfaces either lies on an earlier one or is new. So equal faces move as one: no gap opens
// or closes between two of them because one lies on a third.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "base/box.h"
#include "lower/half_space_table.h"
#include "lower/scene.h"
#include "shape/extent.h"

namespace whittle {

class FaceMerger {
 public:
  /// `region`: local coordinates. Lengths: the model's tolerance, and what rounding cannot tell
  /// apart (ray_tolerance()).
  FaceMerger(const Box& region, double tolerance, double together);

  /// A face of a primitive. Returns a literal of its surface as it was written.
  Literal add(const HalfSpace& face, const Reach& primitive, const Outline& outline);

  /// For every surface as it was written:
  struct Merged {
    std::vector<Literal> literals;  ///< what it lies on now, itself or an earlier one,
    std::vector<float> moved;       ///< and by how much that may differ, where its primitives are
  };
  /// The outline of all faces that were written on one curved surface, see Outline.
  using Outlines = std::function<Outline(uint32_t surface)>;
  Merged merge(const Outlines& outlines) const;

 private:
  /// Faces on one surface as it was written.
  struct Written {
    uint32_t reach;   ///< of the primitive with the largest tolerance
    uint32_t extent;  ///< of all their primitives; kOne: there is but that one
  };
  static constexpr uint32_t kOne = UINT32_MAX;
  static Extent extent_of(const Reach& reach) { return {reach.center, reach.radius, reach.width}; }

  Box region_;
  double tolerance_, together_;
  HalfSpaceTable table_;
  // A primitive may have millions of faces.
  std::vector<Reach> reaches_;
  std::vector<Extent> extents_;
  std::vector<Written> written_;
};

}  // namespace whittle
