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

/// Numbers for points of one cell, by their planes, from 0.
class PointNames {
 public:
  struct Name {
    std::array<uint32_t, 3> planes{};
    uint32_t number = kNone;  ///< into Pieces::points, once it is there
  };
  static constexpr uint32_t kNone = UINT32_MAX;

  void clear() { ++now_, names_.clear(); }
  uint32_t add(const std::array<uint32_t, 3>& planes);
  Name& operator[](uint32_t name) { return names_[name]; }

 private:
  struct Entry {
    uint64_t when = 0;
    uint32_t name = 0;
  };
  Entry& find(const std::array<uint32_t, 3>& planes);
  std::vector<Entry> entries_ = std::vector<Entry>(256);
  std::vector<Name> names_;
  uint64_t now_ = 1;
};

/// Used by one thread at a time.
class PieceMaker {
 public:
  /// `left_out`: by number, the planes of which within() makes nothing; none beyond its end.
  PieceMaker(const Scene& scene, const ExactGeometry& geometry,
             std::span<const PlacedHalfSpace> half_spaces, const Paints& paints,
             std::span<const uint8_t> left_out = {})
      : scene_(scene),
        geometry_(geometry),
        half_spaces_(half_spaces),
        paints_(paints),
        left_out_(left_out),
        local_(geometry.plane_count()) {}

  /// The pieces within a leaf's cell. What lies in its sides is left to between().
  void within(CellLink leaf, const CellSides& cell, Pieces& out);

  /// The pieces in the plane between two cells, where their sides have the rectangle in common
  /// (`rectangle`: its sides on the two other axes).
  void between(CellLink below, CellLink above, int axis, const CellSides& rectangle, Pieces& out);

  // One face of a body after the other, in parts (face_maker.h).

  /// A row of corners.
  struct Polygon {
    uint32_t first = 0, count = 0;
  };
  /// What lies on one side of a plane.
  struct HalfPlane {
    uint32_t plane;
    PlaneSide side;
  };

  /// Points of one body's faces have the same numbers.
  void begin_body() { names_.clear(); }
  /// The part of a plane that is in all of these half-spaces and in the region; empty if there is
  /// none.
  Polygon begin_face(uint32_t plane, std::span<const HalfPlane> around, const CellSides& region);
  /// Holds a polygon, in the grid's units.
  Box box_of(Polygon polygon) const;
  /// The parts of a polygon below and above a plane; one may be empty.
  std::array<Polygon, 2> halves(Polygon polygon, uint32_t plane, uint32_t by);
  /// A part of the face: what is solid below it, and above. It is `owner`'s.
  void add_part(Polygon polygon, uint32_t plane, CellLink below, CellLink above, uint32_t owner);
  /// All parts were added.
  void end_face(Pieces& out) { end_plane(out); }

 private:
  struct Corner {
    uint32_t point;  ///< into points_
    uint32_t edge_plane;
  };
  /// A part that is looked at later.
  struct Open {
    Polygon polygon;
    LeafFunction::State below, above;
    uint32_t known = 0;  ///< so many of known_ are known of it
    uint32_t asked = 0;  ///< and that it is above this plane
  };

  Polygon rectangle(uint32_t plane, int axis, const CellSides& sides);
  /// A plane's part in a box, which has no side in that plane.
  Polygon part_in(uint32_t plane, const CellSides& box);
  /// Which sides of a plane the corners are on; fills signs_.
  void look(Polygon polygon, uint32_t by, bool& has_below, bool& has_above);
  /// The part of a polygon on one side of a plane that was looked at.
  Polygon cut(Polygon polygon, uint32_t plane, uint32_t by, PlaneSide keep);
  Polygon clip(Polygon polygon, uint32_t plane, uint32_t by, PlaneSide keep);
  void fill(Polygon polygon, uint32_t plane, CellLink below, CellLink above, Pieces& out);
  void begin_plane();
  void end_plane(Pieces& out);
  /// The body that owns a part of the plane at hand, as far as that is known.
  OwnerFunction::Answer owner() const;
  void split(Polygon polygon, uint32_t plane, uint32_t own, const LeafFunction& below,
             const LeafFunction& above);
  void clip_group(Polygon polygon, uint32_t plane, uint32_t own, const LeafFunction& group);
  void learn(Open& part, uint32_t local_plane, PlaneSide side, const LeafFunction& below,
             const LeafFunction& above);
  void emit(Polygon polygon, Pieces::Owner owned);
  void cancel();
  void release(Pieces& out);

  const Scene& scene_;
  const ExactGeometry& geometry_;
  std::span<const PlacedHalfSpace> half_spaces_;
  const Paints& paints_;
  const std::span<const uint8_t> left_out_;
  LocalPlanes local_;
  LeafFunction below_, above_;
  // Of a cell.
  PointNames names_;
  // Of a plane in it.
  OwnerFunction below_owner_, above_owner_;
  uint32_t first_owner_ = kSharedOwner;
  bool has_paints_ = false;    ///< owners of parts of the plane differ in paint
  bool keeps_paints_ = false;  ///< the plane is there for several paints
  std::vector<Pieces::Owner> owned_;
  std::vector<ApproximatePoint> points_;
  std::vector<Corner> corners_;
  std::vector<Pieces::Edge> edges_;  ///< ends are in names_
  size_t pieces_ = 0;
  // Of a part of that.
  std::vector<PlaneSide> signs_;
  std::vector<PlaneSide> sides_;  ///< by local plane, 0 if it is not known
  std::vector<uint32_t> known_;   ///< local planes, in the order in which they were asked
  std::vector<uint32_t> numbers_;
  std::vector<Open> open_;
};

}  // namespace whittle
