// The boundary's part of faces of convex bodies that no other face lies on: each is asked as a
// whole what reaches it, and cut by that alone (docs/decisions/0054-whole-faces.md).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/arena.h"
#include "boundary/cutting_planes.h"
#include "boundary/face_boxes.h"
#include "boundary/piece_maker.h"
#include "subdivide/leaf.h"
#include "subdivide/simplify.h"

namespace whittle {

/// Whose faces are looked at, and what is known of them.
struct FacePlan {
  /// By plane: 0, or it is made here alone, so that cells leave it out.
  std::vector<uint8_t> is_whole;
  /// Of one face, which may be taken off the plan; of several, made at different times.
  static constexpr uint8_t kSingle = 1, kShared = 2;
  std::vector<uint32_t> units;  ///< that have a face in such a plane
};

/// The planes in which only faces of convex bodies lie, none of which touch.
FacePlan plan_faces(const Scene& scene, std::span<const PlacedHalfSpace> half_spaces,
                    size_t planes);

/// Units near one another, and what the scene's formula is there.
struct UnitGroup {
  uint32_t first = 0, last = 0;  ///< into FacePlan::units
  Box box;
  Formula formula;
};

/// All units of a plan, sorted so that those of one group stand in a row; groups in which nothing
/// is boundary are left out. What is not told from the rest soon enough, as where all bodies reach
/// all places, is taken off the plan.
std::vector<UnitGroup> group_units(const Scene& scene, const UnitBoxes& boxes,
                                   std::span<const PlacedHalfSpace> half_spaces, FacePlan& plan,
                                   const Workers& workers);

/// Used by one thread at a time.
class FaceMaker {
 public:
  FaceMaker(const Scene& scene, const UnitBoxes& boxes, const ExactGeometry& geometry,
            std::span<const PlacedHalfSpace> half_spaces, const Paints& paints,
            const CuttingPlanes& cuts, double per_unit, FacePlan* plan);

  /// Adds the pieces of all faces of a group in the plan's planes. A plane in which that cannot be
  /// told without a boundary is taken off the plan.
  void make(const UnitGroup& group, Pieces& out);
  /// Pairs of half-spaces that met so far.
  uint64_t pairs() const { return pairs_; }

 private:
  /// A part of a face, and what is asked of it.
  struct Part {
    PieceMaker::Polygon polygon;
    Formula context;
  };
  void body(uint32_t unit, std::span<const Token> formula, Pieces& out);
  void face(const Unit& unit, uint32_t face, const Formula& context, bool is_boundary, Pieces& out);
  bool cut(uint32_t plane, uint32_t owner, bool may_leave);
  bool halve(PieceMaker::Polygon polygon, uint32_t plane, const Box& box);
  void add(PieceMaker::Polygon polygon, uint32_t plane, CellLink context, uint32_t owner);
  void list_around(const Unit& unit, uint32_t face);
  Truth simplify(const Formula& context, const Box& box, Formula& out);

  const Scene& scene_;
  const std::span<const PlacedHalfSpace> half_spaces_;
  const CuttingPlanes& cuts_;
  const double per_unit_;
  FacePlan* const plan_;
  PieceMaker pieces_;
  Simplifier simplifier_;
  LeafAnalysis analysis_;
  Arena leaves_;
  uint64_t pairs_ = 0;
  uint32_t crowded_ = 0;  ///< faces of a group that so many others reach that cells are better
  // Of a body.
  Formula context_, simpler_;
  bool is_negated_ = false;
  FaceBoxes boxes_;
  struct Patch {
    FaceBoxes::Node node;
    Formula context;
    bool is_boundary = false;  ///< all of it, whatever the context
  };
  std::vector<Patch> patches_;  ///< a stack; what is beyond its end is left from before
  // Of a face.
  PlaneSide solid_side_ = 0;
  std::vector<uint32_t> near_;
  std::vector<PieceMaker::HalfPlane> around_;
  std::vector<Part> parts_;
};

}  // namespace whittle
