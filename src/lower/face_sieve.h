// Tells faces that stand alone from those that others may lie on, which are few in most models: of
// a million spheres, or of the facets of a mesh, hardly one comes near another.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "base/uninitialized.h"
#include "base/workers.h"
#include "lower/cell_hash.h"
#include "lower/fingerprint.h"
#include "lower/scene.h"

namespace whittle {

/// Faces are points of a space in which those that may be one are near one another, and that space
/// is cut into cells. A face stands alone if no other is in its cell, nor in those next to it that
/// come within what it may be off; nor is it so near to any other. Cells are known by hashes, so a
/// face may seem to have others that has none. All that is written is written by anybody in any
/// order: what is found does not depend on the number of threads.
class FaceSieve {
 public:
  /// `radius`: half the size of the region; `tolerance`: no Reach's is above it.
  FaceSieve(double radius, double tolerance, size_t faces);

  /// Says what face it is. For each face once, from any thread.
  void set(uint32_t face, const HalfSpace& h, const Reach& reach);

  /// The faces that may have others near them, rising. The half-spaces are those that were set.
  std::vector<uint32_t> with_others(std::span<const HalfSpace> half_spaces,
                                    const Workers* workers);

 private:
  // What is known of a face is one byte.
  enum Kind : uint8_t { kPlane = 0, kBall = 1, kWall = 2 };
  static constexpr uint8_t kLevelBits = 0x0f, kKindShift = 4,
      kReachesOut = 0x40,  ///< others may be in cells next to its own
      kHasOthers = 0x80;   ///< some are
  /// Cells of a level are eight times as large as those of the one before. In the last there is but
  /// one.
  static constexpr uint8_t kLastLevel = 12;
  /// A cell's width in slacks: most of what is looked for is in one cell.
  static constexpr double kWidth = 16;
  // What is known of a slot of the table.
  static constexpr uint8_t kResident = 1,  ///< a face of this level is here,
      kMore = 2,                           ///< several are,
      kGuest = 4,                          ///< one of a finer level is,
      kDisturbed = 8;                      ///< one next to here comes so near

  using Cell = CellPlace<4>;
  /// A face's coordinates in cells of a level.
  using Place = std::array<double, 4>;

  static uint8_t level_of(uint8_t known) { return known & kLevelBits; }
  static Kind kind_of(uint8_t known) { return Kind(known >> kKindShift & 3); }
  static uint8_t level_for(double slack_in_units);
  Place place_of(const HalfSpace& h, Kind kind, uint8_t level) const;
  static Cell cell_of(const Place& place);
  size_t slot_of(const Cell& cell, Kind kind, uint8_t level) const;
  /// Calls visit(slot) for the cells that come within the slack of a place.
  template <class Visit>
  void visit_near(const Place& place, Kind kind, uint8_t level, const Visit& visit) const;
  /// Whether a plane may be turned like one near it and like another one the other way.
  bool is_between_turns(const HalfSpace& h, uint8_t level) const;
  /// Whether those cells are more than one.
  bool reaches_out(const HalfSpace& h, const Place& place, Kind kind, uint8_t level) const;
  /// Calls visit(slot) where the face is in levels coarser than its own that have faces of its
  /// kind.
  template <class Visit>
  void visit_coarser(const HalfSpace& h, uint8_t known, const Visit& visit) const;

  /// One pass over some faces, all if there is no list: those of them that may have others among
  /// them.
  std::vector<uint32_t> sift(std::span<const HalfSpace> half_spaces,
                             const std::vector<uint32_t>* some, const Workers* workers);
  void clear_table(size_t faces, const Workers* workers);
  /// Returns what was known before.
  uint8_t mark(size_t slot, uint8_t bit) {
    return std::atomic_ref<uint8_t>(slots_[slot]).fetch_or(bit, std::memory_order_relaxed);
  }
  uint8_t look(size_t slot) {
    return std::atomic_ref<uint8_t>(slots_[slot]).load(std::memory_order_relaxed);
  }

  double radius_;
  double plane_unit_, curve_unit_;  ///< slacks of level 0: of planes' offsets; of fingerprints
  UninitializedVector<uint8_t> known_;
  std::array<uint16_t, 3> levels_{};  ///< by kind, a bit for each level that has faces
  UninitializedVector<uint8_t> slots_;
  uint64_t salt_ = 0;  ///< of this pass
};

}  // namespace whittle
