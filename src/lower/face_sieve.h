// Tells faces that stand alone from those that others may lie on, which are few in most models: of
// a million spheres, or of the facets of a mesh, hardly one comes near another.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/uninitialized.h"
#include "base/workers.h"
#include "lower/cell_hash.h"
#include "lower/fingerprint.h"
#include "lower/scene.h"

namespace whittle {

/// Faces are points of a space in which those that may be one are near one another, and that space
/// is cut into cells. First a face may stand alone if no other is in its cell, nor in those next to
/// it that come within what it may be off. Of the rest all that are in those cells are looked at.
/// What is looser has larger cells, and finer faces are guests in them.
class FaceSieve {
 public:
  /// `radius`: half the size of the region; `tolerance`: the model's.
  FaceSieve(double radius, double tolerance, size_t faces);

  /// Says what face it is. For each face once, from any thread.
  void set(uint32_t face, const HalfSpace& h, const Reach& reach);

  /// Of the primitive that a face is of.
  using ReachOf = std::function<const Reach&(uint32_t face)>;
  /// The faces that may have others near them over the reach of either, rising; perhaps more. The
  /// half-spaces are those that were set.
  std::vector<uint32_t> with_others(std::span<const HalfSpace> half_spaces, const ReachOf& reach_of,
                                    const Workers* workers);

 private:
  // What is known of a face is one byte.
  enum Kind : uint8_t { kPlane = 0, kBall = 1, kWall = 2 };
  static constexpr uint8_t kLevelBits = 0x0f, kKindShift = 4,
                           kReachesOut = 0x40,  ///< others may be in cells next to its own
      kHasOthers = 0x80;                        ///< some are
  /// Cells grow from level to level. In the last there is but one.
  static constexpr uint8_t kLastLevel = 12;
  /// A cell's width in slacks: most of what is looked for is in one cell.
  static constexpr double kWidth = 32;
  // What is known of the faces in a cell.
  static constexpr uint8_t kResident = 1,  ///< one of this level is there,
      kMore = 2,                           ///< several are,
      kGuest = 4,                          ///< one of a finer level is,
      kDisturbed = 8;                      ///< one next to it comes so near

  using Cell = CellPlace<4>;
  /// A face's coordinates in cells of a level.
  using Place = std::array<double, 4>;

  static uint8_t level_of(uint8_t known) { return known & kLevelBits; }
  static Kind kind_of(uint8_t known) { return Kind(known >> kKindShift & 3); }
  static uint8_t level_for(double slack_in_units);
  Place place_of(const HalfSpace& h, Kind kind, uint8_t level) const;
  static uint64_t hash_of_cell(const Cell& cell, Kind kind, uint8_t level);
  uint64_t hash_at(const HalfSpace& h, Kind kind, uint8_t level) const;
  /// Whether a plane may be turned like one near it and like another one the other way.
  bool is_between_turns(const HalfSpace& h, uint8_t level) const;
  /// Whether the cells that come within the slack of a place are more than one.
  bool reaches_out(const HalfSpace& h, const Place& place, const Cell& cell, Kind kind,
                   uint8_t level) const;
  /// Calls visit(hash) for those cells until it returns false.
  template <class Visit>
  void visit_near(const HalfSpace& h, Kind kind, uint8_t level, const Visit& visit) const;
  /// Calls visit(level) for the levels coarser than its own that have faces of its kind.
  template <class Visit>
  void visit_coarser(uint8_t known, const Visit& visit) const;
  size_t most_levels() const;

  std::vector<uint32_t> sift(std::span<const HalfSpace> half_spaces, const Workers* workers);
  std::vector<uint32_t> look_closely(std::span<const HalfSpace> half_spaces,
                                     const ReachOf& reach_of, std::span<const uint32_t> some,
                                     const Workers* workers) const;

  double radius_;
  double plane_unit_, curve_unit_;  ///< slacks of level 0: of planes' offsets; of fingerprints
  std::array<double, kLastLevel> cells_;  ///< by level: cells in the slack of level 0
  UninitializedVector<uint8_t> known_;
  std::array<uint16_t, 3> levels_{};  ///< by kind, a bit for each level that has faces
};

}  // namespace whittle
