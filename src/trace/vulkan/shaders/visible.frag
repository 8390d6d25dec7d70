#version 460
// Is a change of the solid seen in this cell, at this pixel? Then the pixel gets the cell's number.
#extension GL_GOOGLE_include_directive : require
#include "numbers.glsl"
#include "cases.glsl"
#include "view.glsl"
#include "scene.glsl"
#define WHITTLE_BEFORE_CHANGE
#include "solve.glsl"
#include "position.glsl"

layout(location = 0) flat in uint cell;
layout(location = 0) out uint seen;

// The crossings of one literal along the way.
struct Literal {
  bool is_true;            // at its start
  bool changes;            // and not so at its end
  bool bends;              // or the other between
  bool is_doubtful;        // or who knows
  Crossing first, second;  // where; kNever if there is none
};

Literal literal_along(uint i, bool complemented) {
  const OnRay along = on_ray(literal_word(i) >> 1);
  const Signs signs = signs_of(along);
  Literal l;
  l.is_true = signs.inside != complemented;
  l.changes = signs.inside != signs.at_end;
  l.bends = signs.bends;
  l.is_doubtful = in_doubt(signs);
  l.first = kNever;
  l.second = kNever;
  if (l.changes || l.bends) l.first = crossing_of(along, signs.inside);
  if (l.bends) l.second = crossing_of(along, !signs.inside);
  return l;
}

// A surface alone is seen from either side, so its complement is the same. Two crossings that
// coincide are none.
uint is_seen_alone() {
  const Literal l = literal_along(0, false);
  if (l.is_doubtful) return kDoubt;
  if (l.changes) return kYes;
  if (!l.bends) return kNo;
  Next next = kNoNext;
  add(next, l.first);
  add(next, l.second);
  if (is_crowded(next)) return kDoubt;
  return pmax(l.first.t, l.second.t) > end_of(next) ? kYes : kNo;
}

// The four cases of section 3.3.4 of the paper, by which of the two is complemented. They differ in
// what holds at the start. From there on the crossings are passed one after another, coincident ones
// in one step.
uint is_seen_pair() {
  const Literal a = literal_along(0, kFirstComplemented);
  const Literal b = literal_along(1, kSecondComplemented);
  const bool before = a.is_true && b.is_true;
  // What is false all along settles it.
  if ((!a.is_true && !a.changes && !a.bends && !a.is_doubtful) ||
      (!b.is_true && !b.changes && !b.bends && !b.is_doubtful))
    return kNo;
  if (a.is_doubtful || b.is_doubtful) return kDoubt;
  if (before != ((a.is_true != a.changes) && (b.is_true != b.changes))) return kYes;
  Real until = K(0) - kFar;
  // No more than four crossings.
  for (uint round = 0; round < 4; ++round) {
    Next next = kNoNext;
    if (a.first.t > until) add(next, a.first);
    if (a.second.t > until) add(next, a.second);
    if (b.first.t > until) add(next, b.first);
    if (b.second.t > until) add(next, b.second);
    if (next.t >= kFar) return kNo;
    if (is_crowded(next)) return kDoubt;
    until = end_of(next);
    const bool a_is = a.is_true != ((a.first.t <= until) != (a.second.t <= until));
    const bool b_is = b.is_true != ((b.first.t <= until) != (b.second.t <= until));
    if ((a_is && b_is) != before) return kYes;
  }
  return kNo;
}

// Any leaf. Most rays are settled by the signs at the ends of their way alone.
uint is_seen_any() {
  const bool conjunction = leaf.kind == kConjunction, disjunction = leaf.kind == kDisjunction;
  uint crossings = 0, bits = 0, change_bits = 0;
  uint changes[kMostLiterals / 32];
  bool is_doubtful = false;
  for (uint i = 0; i < leaf.count; ++i) {
    const uint literal = literal_word(i);
    const Signs signs = signs_of(on_ray(literal >> 1));
    const bool is_true = signs.inside != ((literal & 1) != 0);
    const bool changes_here = signs.inside != signs.at_end;
    // One literal that is false all along settles a conjunction, one that is true a disjunction.
    if (!changes_here && !signs.bends && !in_doubt(signs) && (is_true ? disjunction : conjunction))
      return kNo;
    is_doubtful = is_doubtful || in_doubt(signs);
    crossings += uint(changes_here) + 2 * uint(signs.bends);
    bits |= uint(is_true) << (i % 32);
    change_bits |= uint(changes_here) << (i % 32);
    if (i % 32 == 31 || i + 1 == leaf.count) {
      truth[i / 32] = bits;
      changes[i / 32] = change_bits;
      bits = change_bits = 0;
    }
  }
  if (is_doubtful) return kDoubt;
  if (crossings == 0) return kNo;
  bool at_start = false;
  for (uint end = 0; end < 2; ++end) {
    const bool solid = is_solid();
    if (end == 0)
      at_start = solid;
    else if (solid != at_start)
      return kYes;
    for (uint w = 0; w < truth_words(); ++w) truth[w] ^= changes[w];
  }
  if (crossings == 1) return kNo;
  Change change;
  return find_change(change);
}

uint is_seen() {
  if (kFormulas == kOneLiteral) return is_seen_alone();
  if (kIsPair) return is_seen_pair();
  return is_seen_any();
}

void main() {
  const bool meets = enter(cell, make_ray(position_of(ivec2(gl_FragCoord.xy))));
  uint verdict = kNo;
  if (is_too_far())
    verdict = kDoubt;
  else if (meets)
    verdict = is_seen();
  if (verdict == kNo) discard;
  seen = (cell + 1) | (verdict == kDoubt || !is_entered() ? kDoubtBit : 0);
}
