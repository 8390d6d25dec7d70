// Whose material is seen on a cap: where a section cuts through a solid.
#pragma once

#include <cstdint>

#include "image/near_formula.h"
#include "lower/scene.h"

namespace whittle {

class CapOwners {
 public:
  /// `scene` must outlive this.
  explicit CapOwners(const Scene& scene) : scene_(scene), formula_(scene) {}

  /// The statement that the material behind a point of a cap belongs to: of a union the first in
  /// file order that holds it, of a difference what is cut, of an intersection the first operand
  /// (as src/measure/material.h has it). 0 if there is none, as in a film thinner than the model's
  /// tolerance. `outward` is the cap's unit normal. World space. Reads what of the formula is near.
  uint32_t owner(Vec3 point, Vec3 outward) const;

 private:
  const Scene& scene_;
  NearFormula formula_;
};

}  // namespace whittle
