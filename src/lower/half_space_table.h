// Numbers half-spaces, giving equal and complementary ones the same number: this is how coincident
// faces are solved, by naming instead of by epsilon at ray time.
//
// Equal means: within the model's tolerance of the half-space that was numbered first, everywhere
// the two primitives reach. Later ones are compared with that first one only, which never moves,
// so a row of nearly equal planes cannot chain into one.
#pragma once

#include <unordered_map>
#include <vector>

#include "lower/scene.h"

namespace whittle {

class HalfSpaceTable {
 public:
  /// `radius`: half the size of the region; `tolerance`: see Scene.
  HalfSpaceTable(double radius, double tolerance) : radius_(radius), tolerance_(tolerance) {}

  /// The literal of `h`, whose surface matters up to `extent` from its centre.
  Literal add(const HalfSpace& h, double extent);

  std::vector<HalfSpace> take() { return std::move(half_spaces_); }

 private:
  struct Fingerprint {
    double value[3];
  };
  Fingerprint fingerprint(const HalfSpace& h) const;
  bool same(const HalfSpace& known, const HalfSpace& h, double extent, bool complement) const;
  /// The number of a known half-space equal to h (or to its complement), or -1.
  int64_t find(const HalfSpace& h, const Fingerprint& at, double extent, bool complement) const;

  double radius_, tolerance_;
  std::vector<HalfSpace> half_spaces_;
  std::vector<uint32_t> next_;                   ///< chains of half-spaces in one bucket
  std::unordered_map<uint64_t, uint32_t> head_;  ///< bucket -> first of its chain + 1
};

}  // namespace whittle
