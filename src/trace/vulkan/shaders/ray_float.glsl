// A ray in a cell, and half-spaces along it, in single precision: with bounds of what rounding and
// the conversion to floats have done, so that each answer is a proof or in doubt. Where the bounds
// come from: docs/numerics.md. ray_double.glsl has the same names.

// What is seen and then not found again: one of the two is wrong.
const uint kIfNotFoundAgain = kDoubt;

#include "pairs.glsl"

struct Ray {
  Vec3 origin;  // relative to the view's reference, and near to it
  Vec3 direction;
  Real shift;  // t at the camera's start minus t here
};

// The ray through a position of the picture, in pixels.
Ray make_ray(vec2 position) {
  const Vec2 at = in_picture(position);
  Ray ray;
  const bool orthographic = view.orthographic != 0;
  const Vec3 beside = picture_point(Vec3(0), view_right(), view_up(), at.x, at.y);
  const Vec3 point = picture_point(view_forward(), view_right(), view_up(), at.x, at.y);
  ray.direction = mix(unit3(point), view_forward(), bvec3(orthographic));
  ray.origin = beside * mix(view_axis_ahead(), K(1), orthographic);
  ray.shift = view_axis_ahead() * mix(sqrt(dot3(point, point)), K(1), orthographic);
  return ray;
}

// Of a result, the most that one rounding changes, in whichever direction a device rounds.
const Real kRounding = K(1) / K(1 << 23);

// The ray at hand; its way through the cell at hand, which it takes `grown` larger, as places along
// it are so uncertain; and that part of it which is surely in the cell.
Ray ray;
Real way_start, way_end, grown, sure_start, sure_end;
bool too_far;  // leaves are not right so far beyond their cells

Real norm1(Vec3 v) { return fabs_(v.x) + fabs_(v.y) + fabs_(v.z); }

// How far from where it should be the ray may be, no farther than that from its origin. So near to
// a surface that an eye stands on it, doubles do not go by f's sign: that is in doubt, too.
Real error_of_way(Real farthest) {
  return K(14) * kRounding * (farthest + norm1(ray.origin)) + view_at_surface();
}

// The part of one axis.
bool clip(Real lo, Real hi, Real origin, Real direction) {
  // In so short a way as there is a ray does not get anywhere along this axis.
  if (fabs_(direction) < K(1e-20)) {
    if (!(lo + grown <= origin && origin <= hi - grown)) sure_end = K(0) - kFar;
    return lo - grown <= origin && origin <= hi + grown;
  }
  const Real inverse = K(1) / direction;
  const Real a = (lo - origin) * inverse, b = (hi - origin) * inverse;
  const Real first = pmin(a, b), last = pmax(a, b), more = grown * fabs_(inverse);
  way_start = pmax(way_start, first - more);
  way_end = pmin(way_end, last + more);
  sure_start = pmax(sure_start, first + more);
  sure_end = pmin(sure_end, last - more);
  return true;
}

// The way of the ray through a box, from its start on. False if there surely is none.
bool enter_box(Box box) {
  const Vec3 corner = max(abs(box.lo), abs(box.hi));
  grown = K(40) * kRounding * (sqrt(dot3(corner, corner)) + norm1(ray.origin));
  too_far = !(grown <= view_grown());
  way_start = sure_start = view_start() - ray.shift;
  way_end = sure_end = kFar;
  return clip(box.lo.x, box.hi.x, ray.origin.x, ray.direction.x) &&
         clip(box.lo.y, box.hi.y, ray.origin.y, ray.direction.y) &&
         clip(box.lo.z, box.hi.z, ray.origin.z, ray.direction.z) && way_start <= way_end;
}

// Then a cell that the ray meets may be taken for one that it does not meet.
bool is_too_far() { return too_far; }

// Whether the ray surely passes the cell, so that what it meets there is not behind something in a
// cell beside it.
bool is_entered() { return sure_start < sure_end; }

// All terms with the signs that make them largest.
Quadric all_positive(Quadric f) {
  return Quadric(abs(f.diag), abs(f.off), abs(f.b), fabs_(f.c));
}

// A half-space along the ray, about the middle of its way.
struct OnRay {
  AlongRay f;
  Real error;  // the most that f may be wrong along the way
};

OnRay on_ray(uint half_space) {
  const Real middle = K(0.5) * (way_start + way_end), half_way = way_end - middle;
  const Vec3 center = half_space_center(half_space);
  const Vec3 q = (ray.origin + ray.direction * middle) - center;
  uint kind = kSurfaces == kPlanes ? kPlane : half_space_kind(half_space);
  if (kSurfaces == kPlanesAndSpheres && kind != kPlane) kind = kSphere;
  const Quadric f = half_space_quadric(half_space, kind);
  const Vec3 farthest = abs(q) + abs(ray.direction) * half_way;
  const Real place_error = error_of_way(pmax(fabs_(way_start), fabs_(way_end))) +
                           K(3) * kRounding * (norm1(q) + half_way);
  OnRay r;
  if (kind == kPlane) {
    r.f = plane_along_ray(f.b, q, ray.direction);
    r.error = place_error + K(16) * kRounding * dot3(abs(f.b), farthest);
  } else if (kSurfaces == kPlanesAndSpheres || is_sphere(kind)) {
    r.f = diagonal_along_ray(f.diag, f.c, q, ray.direction);
    const Real slope = f.diag.x * sqrt(dot3(farthest, farthest));
    r.error = K(2) * slope * place_error +
              K(14) * kRounding * (f.diag.x * dot3(farthest, farthest) + fabs_(f.c));
  } else {
    r.f = quadric_along_ray(f, q, ray.direction);
    const Quadric largest = all_positive(f);
    const Vec3 slope = quadric_half_gradient(largest, farthest);
    r.error = K(2) * sqrt(dot3(slope, slope)) * place_error +
              K(20) * kRounding * quadric_value(largest, farthest);
  }
  r.f.about = middle;
  return r;
}

struct Signs {
  bool inside;       // the ray is in the half-space where it enters the cell
  bool at_end;       // and where it leaves it
  bool bends;        // it is the same at both, and the other between
  bool is_doubtful;  // or who knows
};

Signs signs_of(OnRay on_ray) {
  const AlongRay f = on_ray.f;
  const Real half_way = way_end - f.about;
  const Real linear = K(2) * f.h * half_way, square = f.a * half_way * half_way;
  const Real value0 = (square - linear) + f.k, value1 = (square + linear) + f.k;
  Signs s;
  s.inside = value0 <= K(0);
  s.at_end = value1 <= K(0);
  // Written so that a NaN is in doubt.
  s.is_doubtful = !(pmin(fabs_(value0), fabs_(value1)) > on_ray.error);
  // The value farthest on the other side, if it is on the way.
  const Real bend = s.inside ? K(0) - f.a : f.a;
  const bool may_bend = s.inside == s.at_end && bend > K(0) && fabs_(f.h) < bend * half_way;
  const Real turn = f.k - f.h * f.h / (may_bend ? f.a : K(1));
  s.bends = may_bend && (turn <= K(0)) != s.inside;
  s.is_doubtful = s.is_doubtful || (may_bend && !(fabs_(turn) > on_ray.error));
  return s;
}

bool in_doubt(Signs signs) { return signs.is_doubtful; }

// One crossing: where, and by how much that may be wrong.
struct Crossing {
  Real t, error;
};
// The first of several, and where the others may begin.
struct Next {
  Real t, error, others;
};

// Where f rises, or falls.
Crossing crossing_of(OnRay on_ray, bool rising) {
  const AlongRay f = on_ray.f;
  const Real t = along_root(f, rising);
  // Half of the slope there, and where f is as much nearer to its turn as it may be wrong.
  const Real square = f.h * f.h - f.a * f.k;
  const Real slope = sqrt(pmax(square, K(0))) +
                     sqrt(pmax(square - fabs_(f.a) * on_ray.error, K(0)));
  const Real rounding = K(8) * kRounding * (fabs_(t - f.about) + fabs_(f.about));
  return Crossing(pmin(pmax(way_start, t), way_end), on_ray.error / slope + rounding);
}

const Crossing kNever = Crossing(kFar, K(0));
const Next kNoNext = Next(kFar, K(0), kFar);

void add(inout Next next, Crossing crossing) {
  const bool is_first = crossing.t < next.t;
  const Real later = is_first ? next.t - next.error : crossing.t - crossing.error;
  next.others = pmin(next.others, later);
  next.t = is_first ? crossing.t : next.t;
  next.error = is_first ? crossing.error : next.error;
}

// It has happened by then.
Real end_of(Next next) { return next.t + next.error; }

// Whether another one may come before it. Written so that a NaN may.
bool is_crowded(Next next) { return !(next.others > end_of(next)); }

// The most that f's value, q from the half-space's centre, may be wrong if q is by so much.
Real error_of_value(Quadric f, Vec3 q, Real place_error) {
  const Quadric largest = all_positive(f);
  const Vec3 farthest = abs(q) + place_error;
  const Vec3 slope = quadric_half_gradient(largest, farthest);
  return K(2) * sqrt(dot3(slope, slope)) * place_error +
         K(20) * kRounding * quadric_value(largest, farthest);
}

// Of a place of the ray, q from that centre, the same.
Real error_of_place(Real t, Vec3 q) {
  return error_of_way(fabs_(t)) + K(3) * kRounding * norm1(q);
}

// Whether a crossing, q from the half-space's centre, may be on either side of it.
bool is_side_in_doubt(Quadric f, Vec3 q, Next at) {
  return !(fabs_(quadric_value(f, q)) > error_of_value(f, q, error_of_place(at.t, q) + at.error));
}

// The crossing of that surface by Newton's rule, with f's value in pairs of floats: only what is
// wrong with the ray itself is left. `f`: the half-space's.
Next refined(uint half_space, Quadric f, Next at) {
  const Vec3 place = ray.origin + ray.direction * at.t, center = half_space_center(half_space);
  const Vec3 q = place - center, gradient = quadric_half_gradient(f, q);
  const Real slope = dot3(gradient, ray.direction);
  const Real bend = fabs_(dot3(quadric_apply(f, ray.direction), ray.direction));
  const Vec3 largest = quadric_half_gradient(all_positive(f), abs(q));
  const Real least = fabs_(slope) - bend * at.error - K(12) * kRounding * norm1(largest);
  const Real steepest = sqrt(dot3(gradient, gradient)) + K(12) * kRounding * norm1(largest);
  const Real error = K(2) * steepest * error_of_way(fabs_(at.t)) +
                     kRounding * kRounding * K(64) * quadric_value(all_positive(f), abs(q)) +
                     bend * at.error * at.error;
  const Real value = value_by_pairs(half_space, place);
  // A driver that does not keep to the order of sums loses what pairs have gained.
  const bool is_plausible = fabs_(value - quadric_value(f, q)) <=
                            error_of_value(f, q, error_of_place(at.t, q));
  Next better = at;
  better.t = at.t - value / (K(2) * slope);
  better.error = error / (K(2) * least) + K(4) * kRounding * fabs_(at.t);
  return is_plausible && least > K(0) && better.error < at.error ? better : at;
}

// Whether distance and normal of a crossing on that surface, q from its centre, may be too wrong to
// be told. Across the surface and as a sine.
const Real kMostAcross = K(1) / K(1 << 18), kMostTurned = K(1) / K(1 << 11);
// Along the ray: a share of the distance, or if the surface is aslant, across it one of a pixel.
const Real kMostAlong = K(1) / K(1 << 17), kMostOfPixel = K(1) / K(1 << 11);

bool are_facts_in_doubt(Quadric f, Vec3 q, Next at) {
  const Vec3 gradient = quadric_half_gradient(f, q);
  const bool orthographic = view.orthographic != 0;
  const Real beside = mix(K(0), dot3(ray.origin, ray.origin), orthographic);
  const Real ahead = at.t + ray.shift, distance = sqrt(ahead * ahead + beside);
  const Real size = sqrt(dot3(gradient, gradient));
  const Real along = at.error + K(12) * kRounding * distance;
  const Real across = along * fabs_(dot3(gradient, ray.direction)) / size;
  const Real pixel = view_scale() * mix(distance, K(1), orthographic);
  const Quadric largest = all_positive(f);
  const Vec3 turn = quadric_apply(largest, Vec3(at.error));
  const Vec3 slope = quadric_half_gradient(largest, abs(q));
  const Real turned = sqrt(dot3(turn, turn)) + K(8) * kRounding * sqrt(dot3(slope, slope));
  // Of a solid without end nothing is seen beyond the last cell.
  return !(across <= kMostAcross * distance && turned <= kMostTurned * size &&
           (along <= kMostAlong * distance || across <= kMostOfPixel * pixel) &&
           at.t <= sure_end + view_beyond());
}
