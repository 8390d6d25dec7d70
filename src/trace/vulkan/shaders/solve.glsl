// Where the solid changes along a ray in one leaf. The rules are those of docs/numerics.md: a
// change of sign between the ends of the way is a crossing, roots only put crossings in order, and
// crossings closer than `together` happen at once.
//
// Drivers write out every call of a function, so what computes a literal is called at one place
// only in each of the loops below.

// A half-space along a ray.
AlongRay along_ray(uint half_space, Ray ray) {
  const Vec3 center = half_space_center(half_space);
  const Vec3 o = Vec3(ray.origin.x - center.x, ray.origin.y - center.y, ray.origin.z - center.z);
  const uint kind = kSurfaces == kPlanes ? kPlane : half_space_kind(half_space);
  if (kSurfaces == kPlanesAndSpheres && kind != kPlane) {
    const Quadric f = half_space_quadric(half_space, kSphere);
    return sphere_along_ray(f.diag.x, f.c, o, ray.direction);
  }
  const Quadric f =
      half_space_quadric(half_space, kSurfaces == kAnySurfaces ? kind : kPlane);
  if (kind == kPlane || kSurfaces != kAnySurfaces) return plane_along_ray(f.b, o, ray.direction);
  if (kind == kSphere) return sphere_along_ray(f.diag.x, f.c, o, ray.direction);
  if (kind == kSmallQuadric) return small_quadric_along_ray(f, o, ray.direction);
  return quadric_along_ray(f, o, ray.direction);
}

struct Signs {
  bool inside;  // the ray is in the half-space where it enters the cell
  bool at_end;  // and where it leaves it
  bool bends;   // it is the same at both, and the other between
};

Signs signs_between(AlongRay f, Real t0, Real t1, Real at_eye) {
  const Real value0 = along_value(f, t0), value1 = along_value(f, t1);
  bool inside0 = value0 <= K(0), inside1 = value1 <= K(0);
  bool falls0 = f.a * (t0 - f.about) + f.h < K(0), falls1 = f.a * (t1 - f.about) + f.h < K(0);
  if (t0 <= at_eye) {
    // Who stands on a surface has passed it: there the side is that of the way just ahead.
    const bool on0 = fabs_(value0) <= view_on_surface();
    if (on0) inside0 = falls0 = f.a * (t0 - f.about + view_ahead()) + f.h < K(0);
    if (t1 <= at_eye && fabs_(value1) <= view_on_surface())
      inside1 = falls1 = f.a * (t1 - f.about + view_ahead()) + f.h < K(0);
    // A plane through the eye is not crossed again, and one that the ray runs in not at all.
    if (on0 && f.a == K(0)) inside0 = inside1;
  }
  const Real bend = inside0 ? K(0) - f.a : f.a;
  const bool bends = inside0 == inside1 && bend > K(0) && falls0 != falls1 && f.h * f.h > f.a * f.k;
  return Signs(inside0, inside1, bends);
}

// The leaf and ray at hand.
Leaf leaf;
Ray ray;
Real way_start, way_end, at_eye;

// Bit i: literal i is true. In conjunctions and disjunctions a literal may be a complement; in
// tables and programs it is the half-space itself.
const uint kMostLiterals = 1024;
uint truth[kMostLiterals / 32];

// The crossings of literals, where they are few: 2 i and 2 i + 1 are those of literal i, kFar where
// there is none. In larger leaves they are computed again whenever they are needed.
const uint kKept = 16;
Real crossing[kKept * 2];
uint true_at_start;

uint literal_word(uint i) { return word(leaf.first + 2 * i); }
uint truth_words() { return (leaf.count + 31) / 32; }

// Starts on a cell. False if the ray does not meet it.
bool enter(uint cell, Ray with) {
  ray = with;
  leaf = cell_leaf(cell);
  at_eye = view_start() - ray.shift + view_at_eye();
  return clip_to(cell_box(cell), ray, way_start, way_end);
}

const uint kAnswerTrue = 0xffffffffu, kAnswerFalse = 0xfffffffeu;

// Whether a point is in the solid where the literals are as `truth` says.
bool is_solid() {
  if (leaf.kind == kTable) {
    const uint row = truth[0];
    return ((row < 32 ? leaf.rule.x >> row : leaf.rule.y >> (row - 32)) & 1) != 0;
  }
  if (leaf.kind == kProgram) {
    uint at = 0;
    while (at < kAnswerFalse) {
      const uint step = leaf.rule.x + 3 * at, test = word(step), i = test >> 1;
      at = word(step + ((truth[i / 32] >> (i % 32) & 1) != (test & 1) ? 1 : 2));
    }
    return at == kAnswerTrue;
  }
  // What decides a conjunction is a literal that is false, and a disjunction one that is true.
  const bool conjunction = leaf.kind == kConjunction;
  for (uint i = 0; i < leaf.count; i += 32) {
    const uint some = leaf.count - i < 32 ? (1u << (leaf.count - i)) - 1 : 0xffffffffu;
    if (((conjunction ? ~truth[i / 32] : truth[i / 32]) & some) != 0) return !conjunction;
  }
  return conjunction;
}

Real root_in_way(AlongRay along, bool rising) {
  const Real t = along_root(along, rising);
  // The signs say that it is within; rounding may not.
  return pmin(pmax(way_start, t), way_end);
}

// Writes to `truth` what holds once all crossings up to `t` have happened. The first crossing after
// that; kFar if there is none. `begins`: it is the first call in this leaf.
Real pass_crossings(Real t, bool begins) {
  Real next = kFar;
  uint bits = 0;
  for (uint i = 0; i < leaf.count; ++i) {
    bool is_true;
    Real first = kFar, second = kFar;
    if (begins || leaf.count > kKept) {
      const uint literal = literal_word(i);
      const AlongRay along = along_ray(literal >> 1, ray);
      const Signs signs = signs_between(along, way_start, way_end, at_eye);
      // f rises where the ray leaves the half-space.
      if (signs.inside != signs.at_end || signs.bends) first = root_in_way(along, signs.inside);
      if (signs.bends) second = root_in_way(along, !signs.inside);
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
    is_true = is_true != ((first <= t) != (second <= t));
    bits |= uint(is_true) << (i % 32);
    if (i % 32 == 31 || i + 1 == leaf.count) {
      truth[i / 32] = bits;
      bits = 0;
    }
    if (first > t) next = pmin(next, first);
    if (second > t) next = pmin(next, second);
  }
  return next;
}

struct Change {
  Real t;      // where it happens
  bool solid;  // what is there after it
};

// The first change along the way. Then `truth` is what holds after it, and WHITTLE_BEFORE_CHANGE
// has seen what held before it.
bool find_change(out Change change) {
  Real t = kFar, until = K(0) - kFar;
  bool before = false;
  // Two crossings a literal at most, and each round passes one.
  for (uint round = 0; round <= 2 * leaf.count + 1; ++round) {
    WHITTLE_BEFORE_CHANGE
    const Real next = pass_crossings(until, round == 0);
    const bool solid = is_solid();
    if (round == 0) before = solid;
    if (solid != before) {
      change = Change(t, solid);
      return true;
    }
    if (next >= kFar) return false;
    t = next;
    until = t + view_together();
  }
  return false;
}
