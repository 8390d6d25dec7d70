// Evaluates a formula for given values of its literals.
#pragma once

#include <span>
#include <vector>

#include "lower/scene.h"

namespace whittle {

/// The value of a formula. `Word` holds several evaluations side by side, one a bit, combined with
/// & and |; `ones` is the word of all true. `value` gives the word of a kFace or kUnit token, its
/// negation applied. Iterative; linear in the formula.
template <class Word, class Value>
Word evaluate(std::span<const Token> formula, Word ones, Value&& value) {
  struct Open {
    size_t end;
    bool conjunction;
    Word so_far;
  };
  std::vector<Open> open;
  // The formula is one operand of a conjunction that holds nothing else.
  open.push_back({formula.size(), true, ones});
  size_t i = 0;
  const auto close_finished = [&] {
    while (open.size() > 1 && open.back().end == i) {
      const Word w = open.back().so_far;
      open.pop_back();
      Open& outer = open.back();
      outer.so_far = outer.conjunction ? Word(outer.so_far & w) : Word(outer.so_far | w);
    }
  };
  while (i < formula.size()) {
    const Token token = formula[i];
    if (token.is_pass()) {
      ++i;
    } else if (token.is_group()) {
      const bool conjunction = token.kind() == TokenKind::kAnd;
      open.push_back({i + token.payload(), conjunction, conjunction ? ones : Word(0)});
      ++i;
    } else {
      Open& group = open.back();
      const Word w = value(token);
      group.so_far = group.conjunction ? Word(group.so_far & w) : Word(group.so_far | w);
      ++i;
    }
    close_finished();
  }
  return open.front().so_far;
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
