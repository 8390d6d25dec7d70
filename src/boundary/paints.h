// Whose faces are kept apart where they lie in one plane: those of different paints.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "boundary/leaf_function.h"

namespace whittle {

/// A plane in which faces of several paints lie is in the table once for each; the first of these
/// is the plane itself. So whatever is made of planes, sheets among them, keeps paints apart.
class Paints {
 public:
  /// `of_body`: by id; empty: all are one. The table has the planes of the half-spaces.
  Paints(const Scene& scene, std::span<const PlacedHalfSpace> half_spaces,
         std::span<const uint32_t> of_body, PlaneTable& planes);

  /// Whether faces of several paints lie in a plane.
  bool are_several(uint32_t plane) const;
  /// The plane as it is for faces of a body.
  uint32_t painted(uint32_t plane, uint32_t body) const;
  /// Gives what is known of a plane to all that it is as, too.
  void spread(std::vector<uint32_t>& by_plane) const;

 private:
  std::span<const uint32_t> of_body_;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> copies_;  ///< by plane and paint
};

}  // namespace whittle
