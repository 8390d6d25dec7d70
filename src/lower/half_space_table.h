// Numbers half-spaces, giving equal and complementary ones the same number: this is how coincident
// faces are solved, by naming instead of by epsilon at ray time.
//
// Equal means: within the tolerance of the half-space that was numbered first, everywhere the
// primitive at hand reaches (docs/conventions.md, Coincidence). Later ones are compared with those
// that have a number only, which never move, so a row of nearly equal planes cannot chain into one.
#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "lower/scene.h"

namespace whittle {

/// What of a primitive decides which surfaces its own are one with. Local coordinates.
struct Reach {
  Vec3 center;  ///< the primitive lies in this ball
  double radius = 0;
  double width = 0;               ///< see Extent
  double tolerance = 0;           ///< see own_tolerance()
  std::span<const Vec3> outline;  ///< of its curved surface, if it has one
  bool is_ball = false;           ///< that surface is a sphere's, not a cylinder's or cone's
};

class HalfSpaceTable {
 public:
  /// `radius`: half the size of the region.
  explicit HalfSpaceTable(double radius) : radius_(radius) {}

  /// The literal of `h`, a surface of the primitive with this reach.
  Literal add(const HalfSpace& h, const Reach& reach);

  std::vector<HalfSpace> take() { return std::move(half_spaces_); }

 private:
  /// Where the surface stands in a space in which equal ones are neighbours.
  struct Fingerprint {
    double value[3];
    double slack;  ///< how far an equal surface's can be
  };
  Fingerprint fingerprint(const HalfSpace& h, const Reach& reach) const;
  bool same_plane(uint32_t known, const HalfSpace& h, const Reach& reach, bool complement) const;
  bool same_curve(uint32_t known, const Reach& reach) const;
  bool same(uint32_t known, const HalfSpace& h, const Reach& reach, bool complement) const;
  /// The first number of an equal half-space (or of one whose complement is), or kNone.
  uint32_t find(const HalfSpace& h, const Reach& reach, const Fingerprint& at,
                bool complement) const;

  struct Known {
    double tolerance;
    bool is_ball;
  };

  double radius_;
  std::vector<HalfSpace> half_spaces_;
  std::vector<Known> known_;                     ///< what is compared besides, one a half-space
  std::vector<uint32_t> next_;                   ///< chains of half-spaces in one bucket
  std::unordered_map<uint64_t, uint32_t> head_;  ///< bucket -> first of its chain
};

}  // namespace whittle
