// The bounds of all primitives, packed so that several are tested against a cell at once. In a
// large model nearly all primitives lie outside a cell; here that is found out at little cost.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "base/uninitialized.h"
#include "base/workers.h"
#include "lower/scene.h"
#include "subdivide/classify.h"

namespace whittle {

class UnitBoxes {
 public:
  /// Tokens that are looked at in one go.
  static constexpr uint32_t kBatch = 16;
  static_assert(kBatch <= 32, "a bit each in a Batch");

  /// Made on all workers, if there are any.
  explicit UnitBoxes(const Scene& scene, const Workers* workers = nullptr);

  /// What is known of the primitives of a batch's tokens, one bit a token; none for groups.
  struct Batch {
    uint32_t beside = 0;   ///< nothing of the primitive is in the cell
    uint32_t within = 0;   ///< all of the cell is in it
    uint32_t balls = 0;    ///< it is a ball, so that this is all there is to find out
    uint32_t negated = 0;  ///< Token::negated(), of groups as well
  };
  /// At most kBatch tokens. The instruction set is chosen at run time; all give the same bits.
  Batch look_at(std::span<const Token> tokens, const CellBox& cell) const;

  /// Whether look_at() saves more time than it costs, for a formula of so many tokens. In a short
  /// formula nearly all primitives cross the cell, and there is little to save. Balls are the
  /// exception: look_at() decides them completely.
  bool are_worth_it(size_t tokens) const {
    constexpr size_t kLong = 32;
    return tokens > kLong || 2 * balls_ > entries_.size();
  }

 private:
  static constexpr float kEverywhere = std::numeric_limits<float>::infinity();
  /// In single precision. What holds the primitive is rounded up, and what the primitive holds is
  /// rounded down, by more than all arithmetic with it can lose.
  struct Entry {
    float center[3] = {};  ///< a box that holds it
    float half[3] = {kEverywhere, kEverywhere, kEverywhere};
    float outer_square = kEverywhere;  ///< squared radius of a ball about the centre that holds it
    float inner_square = 0;            ///< and of one that it holds; 0: none
  };
  Entry entry(const Unit& unit) const;

  const Scene& scene_;
  double region_edge_;
  size_t balls_ = 0;
  UninitializedVector<Entry> entries_;  ///< by unit; then one that is everywhere
};

}  // namespace whittle
