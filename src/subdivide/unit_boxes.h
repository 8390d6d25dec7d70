// Where all primitives are, packed so that many are held against a cell at once: what is beside a
// cell, which in a large model is nearly all there is, costs next to nothing.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lower/scene.h"
#include "subdivide/classify.h"

namespace whittle {

class UnitBoxes {
 public:
  /// Tokens that are looked at together.
  static constexpr uint32_t kBatch = 16;

  explicit UnitBoxes(const Scene& scene);

  /// What is known of the primitives of some tokens, one bit a token; none for groups.
  struct Batch {
    uint32_t beside = 0;   ///< nothing of the primitive is in the cell
    uint32_t within = 0;   ///< all of the cell is in it
    uint32_t balls = 0;    ///< it is a ball, so that this is all there is to find out
    uint32_t negated = 0;  ///< Token::negated(), of groups as well
  };
  /// At most kBatch tokens. The instruction set is chosen at run time; all give the same bits.
  Batch look_at(std::span<const Token> tokens, const CellBox& cell) const;

  /// Whether look_at() finds out more than it takes, for a formula of so many tokens. Short ones
  /// are of primitives that nearly all cross the cell; but of balls it tells that, too.
  bool are_worth_it(size_t tokens) const {
    constexpr size_t kLong = 32;
    return tokens > kLong || 2 * balls_ > entries_.size();
  }

 private:
  /// Single precision, what holds the primitive rounded up and what it holds rounded down by more
  /// than all arithmetic with it can lose.
  struct Entry {
    float center[3], half[3];  ///< a box that holds it
    float outer_square;        ///< squared radius of a ball about the centre that holds it
    float inner_square;        ///< and of one that it holds; 0: none
  };
  const Scene& scene_;
  double region_edge_;
  size_t balls_ = 0;
  std::vector<Entry> entries_;  ///< by unit; then one that is everywhere
};

}  // namespace whittle
