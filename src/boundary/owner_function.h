// Whose a part of a plane is where several bodies have faces in it.
#pragma once

#include <cstdint>
#include <span>

#include "boundary/leaf_function.h"

namespace whittle {

/// Of one plane in one leaf. By the tie rules of docs/conventions.md: down the leaf's formula, at
/// each operator into the first operand whose own value changes across the plane.
class OwnerFunction {
 public:
  /// Of a leaf, an empty cell or a full one. The planes of the leaf's formula are added to `local`,
  /// which, with all else, must live on.
  void set(CellLink link, const Scene& scene, std::span<const PlacedHalfSpace> half_spaces,
           LocalPlanes& local, uint32_t own);

  struct Answer {
    uint32_t id = kSharedOwner;  ///< of a body; kSharedOwner: the leaf knows of none
    bool is_asking = false;      ///< no id yet: the side of this plane matters
    uint32_t asks = 0;
  };
  /// `sides`: by local number of plane, 0 if it is not known; that of the plane itself does not
  /// count.
  Answer at(std::span<const PlaneSide> sides) const;

 private:
  struct Value;
  Value value_of(Token token, std::span<const PlaneSide> sides) const;

  const Scene* scene_ = nullptr;
  std::span<const PlacedHalfSpace> half_spaces_;
  const LocalPlanes* local_ = nullptr;
  std::span<const Token> formula_;  ///< empty: `only_` has it
  uint32_t own_ = 0;                ///< local number
  uint32_t only_ = kSharedOwner;
};

}  // namespace whittle
