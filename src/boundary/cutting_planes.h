// Planes square to the axes that large faces may be cut at: the region halved again and again.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "boundary/exact_plane.h"
#include "boundary/piece_maker.h"

namespace whittle {

class CuttingPlanes {
 public:
  /// Adds them to `planes`: enough for faces that so many others reach.
  CuttingPlanes(const Box& region, size_t faces, const ExactGrid& grid, PlaneTable& planes);

  const CellSides& region() const { return region_; }

  struct Cut {
    uint32_t plane;
    double at;
  };
  /// The one of the fewest halvings that is between two coordinates; none if there is none.
  std::optional<Cut> between(int axis, double lo, double hi) const;

 private:
  CellSides region_;
  std::array<std::vector<Cut>, 3> cuts_;  ///< by axis, in order
};

}  // namespace whittle
