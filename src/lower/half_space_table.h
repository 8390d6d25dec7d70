// Numbers half-spaces, giving equal and complementary ones the same number: this is how coincident
// faces are solved, by naming instead of by epsilon at ray time.
//
// Equal means: within the tolerance of the half-space that was numbered first, everywhere the
// primitive at hand reaches (docs/conventions.md, Coincidence). Later ones are compared with those
// that have a number only, which never move, so a row of nearly equal planes cannot chain into one.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "lower/point_index.h"
#include "lower/scene.h"

namespace whittle {

/// What of a primitive decides which surfaces its own are one with. Local coordinates.
struct Reach {
  Vec3 center;  ///< the primitive lies in this ball
  double radius = 0;
  double width = 0;       ///< see Extent
  double tolerance = 0;   ///< see own_tolerance()
  double ball_reach = 0;  ///< of the outline of a sphere's image from its middle; 0 for the rest

  bool operator==(const Reach&) const = default;
};

/// Points that stand for a curved surface, some at a time: calls the test with them until it fails.
/// True if it never does.
using Outline = std::function<bool(const std::function<bool(std::span<const Vec3>)>&)>;

class HalfSpaceTable {
 public:
  /// `radius`: half the size of the region; `tolerance`: no Reach's is above it.
  HalfSpaceTable(double radius, double tolerance);

  /// The literal of `h`, a surface of the primitive with this reach. Its outline is asked for if
  /// it is curved and near an earlier one.
  Literal add(const HalfSpace& h, const Reach& reach, const Outline& outline);

  /// Makes room for so many half-spaces, and no more.
  void reserve(size_t count) {
    half_spaces_.reserve(count);
    tolerances_.reserve(count);
  }
  std::vector<HalfSpace> take() { return std::move(half_spaces_); }

 private:
  bool same_plane(uint32_t known, const HalfSpace& h, const Reach& reach, bool complement) const;
  bool same_curve(uint32_t known, const Reach& reach, const Outline& outline) const;

  /// The first number of an equal half-space (or of one whose complement is), or kNone.
  uint32_t find_plane(const HalfSpace& h, const Reach& reach, bool complement) const;
  uint32_t find_curve(const HalfSpace& h, const Reach& reach, const Outline& outline) const;
  void add_plane(const HalfSpace& h, uint32_t number);

  /// Where the surface stands in a space in which equal ones are neighbours.
  struct Fingerprint {
    PointIndex::Point point;
    double slack;  ///< how far an equal surface's can be
  };
  Fingerprint wall_fingerprint(const HalfSpace& h, const Reach& reach) const;
  Fingerprint ball_fingerprint(const HalfSpace& h, const Reach& reach) const;
  Fingerprint fingerprint(const HalfSpace& h, const Reach& reach) const;

  double radius_;
  double step_;  ///< of planes' offsets in their index
  std::vector<HalfSpace> half_spaces_;
  std::vector<double> tolerances_;  ///< one a half-space
  PointIndex balls_, walls_;        ///< by fingerprint
  /// Planes in groups that have one normal but for rounding, and by group and distance from the
  /// origin.
  std::vector<Vec3> normals_;
  PointIndex groups_, planes_;
};

}  // namespace whittle
