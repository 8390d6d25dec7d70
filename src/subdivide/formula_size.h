// How much there is in a formula.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "lower/scene.h"
#include "subdivide/local_bsp.h"

namespace whittle {

/// The size of a boundary whose half-spaces in a cell were not counted: one more than a leaf may
/// have, so that the cell is split until they are few enough to count.
inline constexpr uint32_t kManyLiterals = LocalBsp::kMostCounted + 1;

/// Literals that a formula would have with all its primitives expanded.
uint32_t expanded_size(const Scene& scene, std::span<const Token> formula);

/// Whether primitives stand whole in it.
bool has_units(std::span<const Token> formula);

/// Whether a token is a boundary that stands whole.
inline bool is_boundary(const Scene& scene, Token token) {
  return token.kind() == TokenKind::kUnit && !scene.units[token.payload()].is_conjunction();
}

size_t count_boundaries(const Scene& scene, std::span<const Token> formula);

/// Whether it has no more half-spaces, however long it is, than a truth table can hold: many copies
/// of one body.
bool has_few_half_spaces(const Scene& scene, std::span<const Token> formula);

}  // namespace whittle
