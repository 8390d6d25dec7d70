// Evaluates a formula for given values of its literals.
#pragma once

#include <span>

#include "lower/scene.h"

namespace whittle {

/// The value of a formula. `Word` holds several evaluations side by side, one a bit, combined with
/// & and |; `ones` is the word of all true. `value` gives the word of a kFace or kUnit token, its
/// negation applied. Iterative; linear in the formula.
template <class Word, class Value>
Word evaluate(std::span<const Token> formula, Word ones, Value&& value) {
  struct Group {
    bool conjunction;
    Word so_far;

    void add(Word w) { so_far = conjunction ? Word(so_far & w) : Word(so_far | w); }
    Word result() const { return so_far; }
  };
  const auto begin = [&](TokenKind kind) {
    const bool conjunction = kind == TokenKind::kAnd;
    return Group{conjunction, conjunction ? ones : Word(0)};
  };
  return fold(formula, begin, [&](Token token) -> Word { return value(token); });
}

/// Whether a local point lies in the half-space (its surface counts as inside).
inline bool contains(const HalfSpace& h, Vec3 p) {
  return Kernels<double>::quadric_value(h.f, p - h.center) <= 0;
}

/// Whether a local point lies in the half-space or complement that a literal names.
inline bool contains(const Scene& scene, Literal literal, Vec3 p) {
  return contains(scene.half_spaces[literal >> 1], p) != bool(literal & 1);
}

/// Whether a local point lies in the solid that a formula over the scene's faces describes.
inline bool contains(const Scene& scene, std::span<const Token> formula, Vec3 p) {
  return evaluate<uint8_t>(formula, 1, [&](Token token) -> uint8_t {
    bool inside = true;
    if (token.kind() == TokenKind::kFace) {
      inside = contains(scene, scene.faces[token.payload()].literal, p);
    } else {
      const Unit& unit = scene.units[token.payload()];
      if (!unit.is_conjunction())
        return (scene.boundaries[unit.boundary].winding(p) != 0) != token.negated();
      for (uint32_t f = unit.first_face; inside && f < unit.first_face + unit.face_count; ++f)
        inside = contains(scene, scene.faces[f].literal, p);
    }
    return inside != token.negated();
  });
}

}  // namespace whittle
