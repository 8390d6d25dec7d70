#version 460
// Is a change of the solid seen in this cell, at this pixel? Then the pixel gets the cell's number.
#extension GL_GOOGLE_include_directive : require
#include "numbers.glsl"
#include "scene.glsl"
#include "view.glsl"
#define WHITTLE_BEFORE_CHANGE
#include "solve.glsl"
#include "position.glsl"

layout(location = 0) flat in uint cell;
layout(location = 0) out uint seen;

// Most rays are settled by the signs at the ends of their way alone.
bool is_seen() {
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

void main() {
  if (!enter(cell, make_ray(position_of(ivec2(gl_FragCoord.xy)))) || !is_seen()) discard;
  seen = cell + 1;
}
