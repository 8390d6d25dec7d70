// Where the solid changes along a ray in one leaf. A change of sign between the ends of the way is
// a crossing, and roots only put crossings in order.
//
// Drivers write out every call of a function, so what computes a literal is called at one place
// only in each of the loops below.

// What shaders find out.
const uint kNo = 0, kYes = 1, kDoubt = 2;

#if WHITTLE_DOUBLE
#include "ray_double.glsl"
#else
#include "ray_float.glsl"
#endif

// The leaf at hand.
Leaf leaf;

// Bit i: literal i is true. In conjunctions and disjunctions a literal may be a complement; in
// tables and programs it is the half-space itself.
uint truth[kMostLiterals / 32];

// The crossings of literals, where they are few: 2 i and 2 i + 1 are those of literal i, kNever
// where there is none. In larger leaves they are computed again whenever they are needed.
const uint kKept = 16;
Crossing crossing[kKept * 2];
uint true_at_start;
bool sign_in_doubt = false;  // of some literal

uint literal_word(uint i) { return word(leaf.first + 2 * i); }
uint truth_words() { return (leaf.count + 31) / 32; }

// Starts on a cell. False if the ray does not meet it.
bool enter(uint cell, Ray with) {
  ray = with;
  leaf = cell_leaf(cell);
  return enter_box(cell_box(cell));
}

// Whether a point is in the solid where the literals are as `truth` says.
bool is_solid() {
  if (leaf.kind == kTable) {
    const uint row = truth[0];
    return ((row < 32 ? leaf.rule.x >> row : leaf.rule.y >> (row - 32)) & 1) != 0;
  }
  if (leaf.kind == kProgram) {
    uint at = 0;
    while (at < kProgramFalse) {
      const uint step = leaf.rule.x + 3 * at, test = word(step), i = test >> 1;
      at = word(step + ((truth[i / 32] >> (i % 32) & 1) != (test & 1) ? 1 : 2));
    }
    return at == kProgramTrue;
  }
  // What decides a conjunction is a literal that is false, and a disjunction one that is true.
  const bool conjunction = leaf.kind == kConjunction;
  for (uint i = 0; i < leaf.count; i += 32) {
    const uint some = leaf.count - i < 32 ? (1u << (leaf.count - i)) - 1 : 0xffffffffu;
    if (((conjunction ? ~truth[i / 32] : truth[i / 32]) & some) != 0) return !conjunction;
  }
  return conjunction;
}

// Writes to `truth` what holds once all crossings up to `t` have happened. The first crossing after
// that; kNoNext if there is none. `begins`: it is the first call in this leaf.
Next pass_crossings(Real t, bool begins) {
  Next next = kNoNext;
  uint bits = 0;
  for (uint i = 0; i < leaf.count; ++i) {
    bool is_true;
    Crossing first = kNever, second = kNever;
    if (begins || leaf.count > kKept) {
      const uint literal = literal_word(i);
      const OnRay along = on_ray(literal >> 1);
      const Signs signs = signs_of(along);
      sign_in_doubt = sign_in_doubt || in_doubt(signs);
      // f rises where the ray leaves the half-space.
      if (signs.inside != signs.at_end || signs.bends) first = crossing_of(along, signs.inside);
      if (signs.bends) second = crossing_of(along, !signs.inside);
      is_true = signs.inside != ((literal & 1) != 0);
      if (leaf.count <= kKept) {
        crossing[2 * i] = first;
        crossing[2 * i + 1] = second;
        true_at_start = (begins && i == 0 ? 0 : true_at_start) | uint(is_true) << i;
      }
    } else {
      first = crossing[2 * i];
      second = crossing[2 * i + 1];
      is_true = (true_at_start >> i & 1) != 0;
    }
    is_true = is_true != ((first.t <= t) != (second.t <= t));
    bits |= uint(is_true) << (i % 32);
    if (i % 32 == 31 || i + 1 == leaf.count) {
      truth[i / 32] = bits;
      bits = 0;
    }
    if (first.t > t) add(next, first);
    if (second.t > t) add(next, second);
  }
  return next;
}

struct Change {
  Next at;     // where it happens
  bool solid;  // what is there after it
};

// The first change along the way, if there is one. Then `truth` is what holds after it, and
// WHITTLE_BEFORE_CHANGE has seen what held before it. No sign along the way is in doubt.
uint find_change(out Change change) {
  Next at = kNoNext;
  Real until = K(0) - kFar;
  bool before = false;
  // Two crossings a literal at most, and each round passes one.
  for (uint round = 0; round <= 2 * leaf.count + 1; ++round) {
    WHITTLE_BEFORE_CHANGE
    const Next next = pass_crossings(until, round == 0);
    const bool solid = is_solid();
    if (round == 0) before = solid;
    if (solid != before) {
      change = Change(at, solid);
      return kYes;
    }
    if (next.t >= kFar) return kNo;
    if (is_crowded(next)) return kDoubt;
    at = next;
    until = end_of(next);
  }
  return kNo;
}
