#version 460
// Is a change of the solid seen in this cell, at this pixel? Then the pixel gets the cell's number.
#extension GL_GOOGLE_include_directive : require
#include "numbers.glsl"
#include "cases.glsl"
#include "scene.glsl"
#include "view.glsl"
#define WHITTLE_BEFORE_CHANGE
#include "solve.glsl"
#include "position.glsl"

layout(location = 0) flat in uint cell;
layout(location = 0) out uint seen;

// The crossings of one literal along the way.
struct Literal {
  bool is_true;        // at its start
  bool changes;        // and not so at its end
  bool bends;          // or the other between
  Real first, second;  // where; kFar if there is none
};

Literal literal_along(uint i, bool complemented) {
  const AlongRay along = along_ray(literal_word(i) >> 1, ray);
  const Signs signs = signs_between(along, way_start, way_end, at_eye);
  Literal l;
  l.is_true = signs.inside != complemented;
  l.changes = signs.inside != signs.at_end;
  l.bends = signs.bends;
  l.first = select(l.changes || l.bends, root_in_way(along, signs.inside), kFar);
  l.second = select(l.bends, root_in_way(along, !signs.inside), kFar);
  return l;
}

// A surface alone is seen from either side, so its complement is the same. Two crossings that
// happen together are none.
bool is_seen_alone() {
  const Literal l = literal_along(0, false);
  return l.changes || (l.bends && pmax(l.first, l.second) > pmin(l.first, l.second) + view_together());
}

// The four cases of section 3.3.4 of the paper, by which of the two is complemented. They differ in
// what holds at the start; from there on the crossings are passed one after another, those together
// that happen together.
bool is_seen_pair() {
  const Literal a = literal_along(0, kFirstComplemented);
  const Literal b = literal_along(1, kSecondComplemented);
  const bool before = a.is_true && b.is_true;
  // What is false all along settles it.
  if ((!a.is_true && !a.changes && !a.bends) || (!b.is_true && !b.changes && !b.bends))
    return false;
  if (before != ((a.is_true != a.changes) && (b.is_true != b.changes))) return true;
  Real until = K(0) - kFar;
  // No more than four crossings.
  for (uint round = 0; round < 4; ++round) {
    Real next = select(a.first > until, a.first, kFar);
    next = pmin(next, select(a.second > until, a.second, kFar));
    next = pmin(next, select(b.first > until, b.first, kFar));
    next = pmin(next, select(b.second > until, b.second, kFar));
    if (next >= kFar) return false;
    until = next + view_together();
    const bool a_is = a.is_true != ((a.first <= until) != (a.second <= until));
    const bool b_is = b.is_true != ((b.first <= until) != (b.second <= until));
    if ((a_is && b_is) != before) return true;
  }
  return false;
}

// Any leaf. Most rays are settled by the signs at the ends of their way alone.
bool is_seen_any() {
  const bool conjunction = leaf.kind == kConjunction, disjunction = leaf.kind == kDisjunction;
  uint crossings = 0, bits = 0, change_bits = 0;
  uint changes[kMostLiterals / 32];
  for (uint i = 0; i < leaf.count; ++i) {
    const uint literal = literal_word(i);
    const Signs signs =
        signs_between(along_ray(literal >> 1, ray), way_start, way_end, at_eye);
    const bool is_true = signs.inside != ((literal & 1) != 0);
    const bool changes_here = signs.inside != signs.at_end;
    // One literal that is false all along settles a conjunction, one that is true a disjunction.
    if (!changes_here && !signs.bends && (is_true ? disjunction : conjunction)) return false;
    crossings += uint(changes_here) + 2 * uint(signs.bends);
    bits |= uint(is_true) << (i % 32);
    change_bits |= uint(changes_here) << (i % 32);
    if (i % 32 == 31 || i + 1 == leaf.count) {
      truth[i / 32] = bits;
      changes[i / 32] = change_bits;
      bits = change_bits = 0;
    }
  }
  if (crossings == 0) return false;
  bool at_start = false;
  for (uint end = 0; end < 2; ++end) {
    const bool solid = is_solid();
    if (end == 0)
      at_start = solid;
    else if (solid != at_start)
      return true;
    for (uint w = 0; w < truth_words(); ++w) truth[w] ^= changes[w];
  }
  if (crossings == 1) return false;
  Change change;
  return find_change(change);
}

bool is_seen() {
  if (kFormulas == kOneLiteral) return is_seen_alone();
  if (kIsPair) return is_seen_pair();
  return is_seen_any();
}

void main() {
  if (!enter(cell, make_ray(position_of(ivec2(gl_FragCoord.xy)))) || !is_seen()) discard;
  seen = cell + 1;
}
