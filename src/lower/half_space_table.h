// Numbers half-spaces. Equal and complementary ones get the same number: coincident faces are
// recognised once, by name, and not by an epsilon at every ray.
//
// Equal means: within the tolerance of the half-space that was numbered first, everywhere the
// primitive at hand reaches (docs/conventions.md, Coincidence). A new half-space is compared only
// with those that have a number. These never move, so a row of nearly equal planes cannot chain
// into one.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "lower/fingerprint.h"
#include "lower/point_index.h"
#include "lower/scene.h"

namespace whittle {

/// Points that stand for a curved surface, some at a time: calls the test with them until it fails.
/// True if it never does.
using Outline = std::function<bool(const std::function<bool(std::span<const Vec3>)>&)>;

class HalfSpaceTable {
 public:
  /// `radius`: half the size of the region; `tolerance`: no Reach's is above it.
  HalfSpaceTable(double radius, double tolerance);

  /// The literal of `h`, a surface of the primitive with this reach. Its outline is asked for if
  /// it is curved and near an earlier one.
  Literal add(const HalfSpace& h, const Reach& reach, const Outline& outline) {
    return add(h, reach, reach, outline);
  }
  /// The same, but equal is only what is equal over a reach that tells more surfaces apart.
  Literal add(const HalfSpace& h, const Reach& reach, const Reach& equal, const Outline& outline);

  /// Whether another surface stands so near that it may be equal to this one over a reach that was
  /// added with it.
  bool is_crowded(uint32_t number) const { return crowded_[number]; }

  const HalfSpace& operator[](uint32_t number) const { return half_spaces_[number]; }
  size_t size() const { return half_spaces_.size(); }

 private:
  bool same_plane(uint32_t known, const HalfSpace& h, const Reach& reach, bool complement) const;
  bool same_curve(uint32_t known, const Reach& reach, const Outline& outline) const;

  /// In the units of the indices.
  Fingerprint place_of(const HalfSpace& h, const Reach& reach) const;

  /// Half-spaces in two indices. One is lonely if no other was near it when it was added; any place
  /// has few of these. All others are crowded.
  struct Shelves {
    PointIndex lonely, crowded;
    PointIndex& of(bool is_crowded) { return is_crowded ? crowded : lonely; }
  };

  /// Calls visit(literal) for the half-spaces on the shelf that may be equal over the reach, and
  /// for those whose complements may be. Stops when it returns false.
  template <class Visit>
  void visit_near(PointIndex Shelves::*shelf, const HalfSpace& h, const Reach& reach,
                  const Fingerprint& at, const Visit& visit) const;
  template <class Visit>
  void visit_planes(PointIndex Shelves::*shelf, const HalfSpace& h, const Reach& reach,
                    bool complement, const Visit& visit) const;
  void put(const HalfSpace& h, uint32_t number, bool is_ball, const Fingerprint& at);
  uint32_t group_of(Vec3 normal);
  /// Calls visit(group) for all whose normal is within `parting` of n in every coordinate, until it
  /// returns false.
  template <class Visit>
  void visit_groups(Vec3 n, double parting, const Visit& visit) const;

  double radius_;
  double step_;  ///< of planes' offsets in their index
  std::vector<HalfSpace> half_spaces_;
  // One a half-space.
  std::vector<double> tolerances_;
  std::vector<bool> crowded_;

  std::vector<Literal> near_;  ///< while one is added
  Shelves balls_, walls_;      ///< by fingerprint
  /// Planes are found by group and distance from the origin. A group has one normal, but for
  /// rounding; these are the groups' normals.
  std::vector<Vec3> normals_;
  /// The groups by normal, in hash cells of several sizes, so that a search in a small
  /// neighbourhood does not meet all of a large one. As long as there are few groups, only the
  /// coarsest is filled.
  static constexpr std::array<double, 3> kNormalCellsPerUnit = {1 << 6, 1 << 10, 1 << 16};
  std::array<PointIndex, kNormalCellsPerUnit.size()> groups_;
  Shelves planes_;
};

}  // namespace whittle
