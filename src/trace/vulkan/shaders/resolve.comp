#version 460
// From the cell that a pixel sees to the facts: distance, owner, normal. The rules are those of
// docs/conventions.md; once a pixel, whatever stands behind it. All pixels of the tile, or in a row
// those that look at places of their own.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "numbers.glsl"
#include "cases.glsl"
#include "view.glsl"
#include "scene.glsl"

// Until a change is found, what held before the last crossings; then, what they changed.
uint changed[kMostLiterals / 32];
#define WHITTLE_BEFORE_CHANGE \
  for (uint w = 0; w < truth_words(); ++w) changed[w] = truth[w];
#include "solve.glsl"
#include "position.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;

layout(set = 0, binding = kSeenBinding) uniform utexture2D seen;
layout(set = 0, binding = kHitsBinding) writeonly buffer Hits { uint hits[]; };

// By cell: the picture in which it was last seen.
layout(set = 0, binding = kLastSeenBinding) writeonly buffer LastSeen { uint last_seen[]; };

// Where pixels look at places of their own: how many do, and their numbers.
layout(set = 0, binding = kPlacesBinding) readonly buffer Places { uint places[]; };

// Whether the host must look again. What was found out is then of no use.
bool is_doubtful = false;

bool is_true(uint i) { return (truth[i / 32] >> (i % 32) & 1) != 0; }
bool happens(uint i) { return (changed[i / 32] >> (i % 32) & 1) != 0; }

const uint kNone = 0xffffffffu;

// Of the crossings that coincide, the first that the solid would not have changed without,
// or that would have changed it alone; `size` counts them.
uint decisive(Change change, out uint size) {
  uint first = kNone;
  size = 0;
  for (uint i = 0; i < leaf.count; ++i)
    if (happens(i) && size++ == 0) first = i;
  if (size == 1) return first;
  for (uint i = 0; i < leaf.count; ++i) {
    if (!happens(i)) continue;
    // First without it, then it alone.
    for (uint alone = 0; alone < 2; ++alone) {
      bool solid = false;
      for (uint undo = 0; undo < 2; ++undo) {
        for (uint w = 0; w < truth_words(); ++w) {
          const uint it = w == i / 32 ? 1u << (i % 32) : 0;
          truth[w] ^= alone == 1 ? changed[w] ^ it : it;
        }
        if (undo == 0) solid = is_solid();
      }
      if ((solid == change.solid) == (alone == 1)) return i;
    }
  }
  return first;
}

// A step of the leaf's formula, in the order of evaluation; two words: kind and operand, owner.
uint kind_of(uint step) { return step & ((1u << kStepBits) - 1); }
uint operand_of(uint step) { return step >> kStepBits; }

// The step whose face owns a change: down the formula, at each group into the first operand that
// changes. kNone if there is none.
uint owning_step(uint first, uint count, Vec3 point, Next where) {
  uint conjunctions = 1, before = 1, after = 1;  // bit per open group
  uint found[kMostNested];
  found[0] = kNone;
  uint level = 0;
  for (uint s = 0; s < count; ++s) {
    const uint step = word(first + 2 * s), kind = kind_of(step), operand = operand_of(step);
    bool was, is;
    uint by = s;
    if (kind == kBeginAnd || kind == kBeginOr) {
      ++level;
      const uint bit = 1u << level;
      const bool conjunction = kind == kBeginAnd;
      conjunctions = conjunction ? conjunctions | bit : conjunctions & ~bit;
      before = conjunction ? before | bit : before & ~bit;
      after = conjunction ? after | bit : after & ~bit;
      found[level] = kNone;
      continue;
    }
    if (kind == kEnd) {
      was = (before >> level & 1) != 0;
      is = (after >> level & 1) != 0;
      by = found[level];
      --level;
    } else if (kind == kLiteral || kind == kNotLiteral) {
      is = is_true(operand) != (kind == kNotLiteral);
      was = is != happens(operand);
    } else {
      const Quadric f = half_space_quadric(operand, half_space_kind(operand));
      const Vec3 q = point - half_space_center(operand);
      was = is = (quadric_value(f, q) <= K(0)) != (kind == kNotElsewhere);
      is_doubtful = is_doubtful || is_side_in_doubt(f, q, where);
    }
    const uint bit = 1u << level;
    const bool conjunction = (conjunctions & bit) != 0;
    if (was != conjunction) before = conjunction ? before & ~bit : before | bit;
    if (is != conjunction) after = conjunction ? after & ~bit : after | bit;
    if (was != is && found[level] == kNone) found[level] = by;
  }
  return found[0];
}

Vec3 point_of(Next at) { return ray.origin + ray.direction * at.t; }

// The change that a pixel has seen.
uint look(uint what, ivec2 pixel, out Change change) {
  if (what == 0) return kNo;
  if ((what & kDoubtBit) != 0) return kDoubt;
  const bool meets = enter(what - 1, make_ray(position_of(pixel)));
  const uint verdict = meets ? find_change(change) : kNo;
  return verdict == kNo ? kIfNotFoundAgain : verdict;
}

void main() {
  const bool probes = view.probes != 0;
  // Those in the last workgroup that have no place do the last one again.
  const uint place = min(gl_WorkGroupID.x * kGroupSide * kGroupSide + gl_LocalInvocationIndex, places[0] - 1);
  const int number = int(places[(place + 1) * uint(probes)]);
  const ivec2 pixel = mix(ivec2(gl_GlobalInvocationID.xy),
                          ivec2(number % view.tile_size.x, number / view.tile_size.x),
                          bvec2(probes));
  if (any(greaterThanEqual(pixel, view.tile_size))) return;
  const uint at =
      mix(uint(pixel.y * view.tile_size.x + pixel.x), place, probes) * kHitWords;
  const uint what = texelFetch(seen, pixel, 0).x;
  const uint cell = what & ~kDoubtBit;
  if (cell != 0) last_seen[cell - 1] = view.picture;
  Change change;
  const uint verdict = look(what, pixel, change);
  if (verdict != kYes) {
    hits[at] = 0x7f800000u;  // infinity
    hits[at + 1] = verdict == kDoubt ? kDoubtfulId : 0;
    for (uint i = 2; i < kHitWords; ++i) hits[at + i] = 0;
    return;
  }
  for (uint w = 0; w < truth_words(); ++w) changed[w] ^= truth[w];

  const Vec3 point = point_of(change.at);
  uint size;
  uint literal = decisive(change, size);
  uint id = word(leaf.first + 2 * literal + 1);
  const uint first_step = leaf.first + 2 * leaf.count + 1, steps = word(first_step - 1);
  if (steps > 0 && (id == 0 || size > 1)) {
    uint step = owning_step(first_step, steps, point, change.at);
    // No operand changes: then the first face on that half-space has it.
    for (uint s = 0; s < steps && step == kNone; ++s) {
      const uint word_of = word(first_step + 2 * s), kind = kind_of(word_of);
      if ((kind == kLiteral || kind == kNotLiteral) && operand_of(word_of) == literal)
        step = s;
    }
    if (step != kNone) {
      id = word(first_step + 2 * step + 1);
      const uint word_of = word(first_step + 2 * step), kind = kind_of(word_of);
      if ((kind == kLiteral || kind == kNotLiteral) && happens(operand_of(word_of)))
        literal = operand_of(word_of);
    }
  }
  const uint half_space = literal_word(literal) >> 1;
  const bool complement = (literal_word(literal) & 1) != 0;
  const Vec3 center = half_space_center(half_space);
  const Quadric f = half_space_quadric(half_space, half_space_kind(half_space));
  const Next hit = refined(half_space, f, change.at);
  const Vec3 q = point_of(hit) - center;
  const Vec3 gradient = quadric_half_gradient(f, q);
  // The gradient points out of the half-space; that is out of the solid too if both were entered or
  // both left.
  const bool outward = (is_true(literal) != complement) == change.solid;
  const Real size_of = sqrt(dot3(gradient, gradient));
  const Real by = select(size_of > K(0), K(1) / size_of, K(1));
  const vec3 normal = vec3(gradient * by) * (outward ? 1.0 : -1.0);
  hits[at] = floatBitsToUint(float(hit.t + ray.shift));
  hits[at + 1] = is_doubtful || sign_in_doubt || are_facts_in_doubt(f, q, hit) ? kDoubtfulId : id;
  hits[at + 2] = floatBitsToUint(normal.x);
  hits[at + 3] = floatBitsToUint(normal.y);
  hits[at + 4] = floatBitsToUint(normal.z);
}
