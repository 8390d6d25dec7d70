// From leaves to pieces of the boundary: the planes of a leaf are cut by one another within the
// cell, as far as the leaf asks for it, and what is solid on one side alone is boundary.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "boundary/leaf_function.h"
#include "boundary/owner_function.h"
#include "boundary/paints.h"
#include "boundary/pieces.h"

namespace whittle {

/// A cell's sides as numbers of planes.
struct CellSides {
  std::array<uint32_t, 3> lo{}, hi{};
};

/// The exact points of one cell, by their planes.
class PointCache {
 public:
  void clear() { ++now_, count_ = 0; }
  /// The place of a point's number, which is kNone if it is new. Until the next call.
  uint32_t& number(std::array<uint32_t, 3> planes);
  static constexpr uint32_t kNone = UINT32_MAX;

 private:
  struct Entry {
    uint64_t when = 0;
    std::array<uint32_t, 3> planes{};
    uint32_t number = kNone;
  };
  Entry& find(const std::array<uint32_t, 3>& planes);
  std::vector<Entry> entries_ = std::vector<Entry>(256);
  uint64_t now_ = 1;
  size_t count_ = 0;
};

/// Used by one thread at a time.
class PieceMaker {
 public:
  PieceMaker(const Scene& scene, const ExactGeometry& geometry,
             std::span<const PlacedHalfSpace> half_spaces, const Paints& paints)
      : scene_(scene),
        geometry_(geometry),
        half_spaces_(half_spaces),
        paints_(paints),
        local_(geometry.plane_count()) {}

  /// The pieces within a leaf's cell. What lies in its sides is left to between().
  void within(CellLink leaf, const CellSides& cell, Pieces& out);

  /// The pieces in the plane between two cells, where their sides have the rectangle in common
  /// (`rectangle`: its sides on the two other axes).
  void between(CellLink below, CellLink above, int axis, const CellSides& rectangle, Pieces& out);

 private:
  struct Corner {
    uint32_t point;  ///< into points_
    uint32_t edge_plane;
  };
  using Polygon = std::vector<Corner>;
  struct Open {
    Polygon polygon;
    std::vector<PlaneSide> sides;             ///< by local plane
    uint32_t below_from = 0, above_from = 0;  ///< how far the two functions have come
  };

  Polygon rectangle(uint32_t plane, int axis, const CellSides& sides);
  void clip(Polygon& polygon, uint32_t by, PlaneSide keep, uint32_t plane);
  /// The part of a polygon on one side of a plane; `signs`: of its corners.
  void cut(const Polygon& polygon, uint32_t plane, uint32_t by, PlaneSide keep, Polygon& part);
  /// Which sides of a plane the corners are on; fills signs_.
  void look(const Polygon& polygon, uint32_t by, bool& has_below, bool& has_above);
  void fill(Polygon polygon, uint32_t plane, CellLink below, CellLink above, Pieces& out);
  /// The body that owns a part of the plane at hand, as far as that is known.
  OwnerFunction::Answer owner(std::span<const PlaneSide> sides) const;
  void emit(const Polygon& polygon, Sheet sheet, Pieces& out);
  static void cancel(size_t first, Pieces& out);

  const Scene& scene_;
  const ExactGeometry& geometry_;
  std::span<const PlacedHalfSpace> half_spaces_;
  const Paints& paints_;
  LocalPlanes local_;
  LeafFunction below_, above_;
  OwnerFunction below_owner_, above_owner_;
  std::vector<ApproximatePoint> points_;
  PointCache emitted_;
  std::vector<PlaneSide> signs_;
  std::vector<uint32_t> numbers_;
  std::vector<Open> open_;
};

}  // namespace whittle
