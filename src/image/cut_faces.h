// Which surfaces OpenSCAD paints as cut where faces of material and of cutters coincide.
//
// OpenSCAD's evaluated solids are closed sets of points: a primitive contains its surface, and
// subtracting it removes its surface, too. A face is painted as material if the solid contains it,
// and as cut if not. Away from coincident faces the sign of the primitive in the formula decides.
// Where a face of material lies on a face of a cutter that sign does not decide, whoever owns the
// point.
#pragma once

#include <cstdint>
#include <vector>

#include "image/near_formula.h"
#include "lower/scene.h"

namespace whittle {

class CutFaces {
 public:
  /// `scene` must outlive this.
  explicit CutFaces(const Scene& scene);

  /// Whether any face of the primitive lies on one of the other sign. False: the solid holds all
  /// its faces or none of them, and is_cut need not be asked.
  bool is_contested(uint32_t id) const {
    return id < units_of_.size() && units_of_[id].first != kNoUnit;
  }
  /// Whether the surface of that primitive at a world point is cut. The point may be off the
  /// surface by rounding. Reads what of the formula is near. Precondition: is_contested(id).
  bool is_cut(uint32_t id, Vec3 point) const;

 private:
  static constexpr uint32_t kNoUnit = UINT32_MAX;
  /// The units of one body stand in a row.
  struct Units {
    uint32_t first = kNoUnit, last = 0;
  };
  bool has(const Unit& unit, uint32_t surface, Vec3 p) const;
  uint32_t surface_at(Units units, Vec3 p) const;

  const Scene& scene_;
  NearFormula formula_;
  double margin_;                ///< the most that surfaces and boxes may be wrong by
  std::vector<Units> units_of_;  ///< by id, if it is contested
};

}  // namespace whittle
