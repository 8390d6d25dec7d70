#include "subdivide/formula_size.h"

#include <algorithm>
#include <array>

#include "subdivide/cells.h"

namespace whittle {

uint32_t expanded_size(const Scene& scene, std::span<const Token> formula) {
  uint32_t count = 0;
  for (const Token token : formula) {
    if (token.kind() == TokenKind::kFace) ++count;
    if (token.kind() != TokenKind::kUnit) continue;
    const Unit& unit = scene.units[token.payload()];
    count += unit.is_conjunction() ? unit.face_count : kManyLiterals;
  }
  return count;
}

bool has_units(std::span<const Token> formula) {
  return std::ranges::any_of(formula, [](Token token) { return token.kind() == TokenKind::kUnit; });
}

size_t count_boundaries(const Scene& scene, std::span<const Token> formula) {
  return size_t(
      std::ranges::count_if(formula, [&](Token token) { return is_boundary(scene, token); }));
}

bool has_few_half_spaces(const Scene& scene, std::span<const Token> formula) {
  std::array<uint32_t, kTableLiterals> known;
  size_t count = 0;
  const auto is_one_more_known = [&](uint32_t face) {
    const uint32_t number = scene.faces[face].literal >> 1;
    if (std::find(known.begin(), known.begin() + count, number) != known.begin() + count)
      return true;
    if (count == known.size()) return false;
    known[count++] = number;
    return true;
  };
  return std::all_of(formula.begin(), formula.end(), [&](Token token) {
    if (token.is_group()) return true;
    if (token.kind() == TokenKind::kFace) return is_one_more_known(token.payload());
    const Unit& unit = scene.units[token.payload()];
    if (!unit.is_conjunction()) return false;
    for (uint32_t k = 0; k < unit.face_count; ++k)
      if (!is_one_more_known(unit.first_face + k)) return false;
    return true;
  });
}

}  // namespace whittle
