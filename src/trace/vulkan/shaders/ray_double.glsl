// A ray in a cell, and half-spaces along it, in double precision. The rules are those of
// docs/numerics.md: what this says counts, and nothing is in doubt. ray_float.glsl has the same
// names.

// What is seen and then not found again is not there.
const uint kIfNotFoundAgain = kNo;

struct Ray {
  Vec3 origin;  // local: the point nearest to the region's middle, as on the CPU
  Vec3 direction;
  Real shift;   // t at the camera's start minus t here
};

// The ray through a position of the picture, in pixels.
Ray make_ray(vec2 position) {
  const Vec2 at = in_picture(position);
  Ray ray;
  const bvec3 orthographic = bvec3(view.orthographic != 0);
  const Vec3 base = mix(view_forward(), view_eye(), orthographic);
  const Vec3 point = picture_point(base, view_right(), view_up(), at.x, at.y);
  const Vec3 from = mix(view_eye(), point, orthographic);
  ray.direction = mix(unit3(point), view_forward(), orthographic);
  ray.shift = K(0) - dot3(from, ray.direction);
  ray.origin = Vec3(from.x + ray.direction.x * ray.shift, from.y + ray.direction.y * ray.shift,
                    from.z + ray.direction.z * ray.shift);
  return ray;
}

// The part of one axis: neighbouring cells compute the same t for the side they share.
bool clip(Real lo, Real hi, Real origin, Real direction, inout Real t0, inout Real t1) {
  if (fabs_(direction) < kNothing) return lo <= origin && origin <= hi;
  const Real inverse = K(1) / direction;
  const Real a = (lo - origin) * inverse, b = (hi - origin) * inverse;
  t0 = pmax(t0, pmin(a, b));
  t1 = pmin(t1, pmax(a, b));
  return true;
}

// The ray at hand, its way through the cell at hand, and until where on it is at the eye.
Ray ray;
Real way_start, way_end, at_eye;

// The way of the ray through a box, from its start on. False if there is none.
bool enter_box(Box box) {
  const Real start = view_start() - ray.shift;
  at_eye = start + view_at_eye();
  way_start = start;
  way_end = kFar;
  return clip(box.lo.x, box.hi.x, ray.origin.x, ray.direction.x, way_start, way_end) &&
         clip(box.lo.y, box.hi.y, ray.origin.y, ray.direction.y, way_start, way_end) &&
         clip(box.lo.z, box.hi.z, ray.origin.z, ray.direction.z, way_start, way_end) &&
         way_start <= way_end;
}

bool is_too_far() { return false; }
bool is_entered() { return true; }

// A half-space along the ray.
struct OnRay {
  AlongRay f;
  Real on_surface;  // the most that |f| is where an eye stands on the surface
  Real ahead;       // so far ahead a ray looks from there where it goes
};
// f is about a distance.
OnRay as_distance(AlongRay f) { return OnRay(f, view_on_surface(), view_ahead()); }
// But near the tip of a cone it has no slope, and what is ahead of the eye is as near as the tip. o:
// the ray's origin from there.
OnRay from_tip(AlongRay along, Quadric f, Vec3 o) {
  OnRay r = as_distance(along);
  if (way_start > at_eye) return r;
  const Real t = view_start() - ray.shift;
  const Vec3 q = Vec3(o.x + ray.direction.x * t, o.y + ray.direction.y * t,
                      o.z + ray.direction.z * t);
  const Real distance = sqrt(dot3(q, q));
  if (distance > view_on_surface()) r.ahead = pmin(view_ahead(), kAhead * distance);
  r.on_surface *= pmin(K(1), cone_most_slope(f, distance + view_on_surface()));
  return r;
}
OnRay on_ray(uint half_space) {
  const Vec3 center = half_space_center(half_space);
  const Vec3 o = Vec3(ray.origin.x - center.x, ray.origin.y - center.y, ray.origin.z - center.z);
  const uint kind = kSurfaces == kPlanes ? kPlane : half_space_kind(half_space);
  if (kSurfaces == kPlanesAndSpheres && kind != kPlane) {
    const Quadric f = half_space_quadric(half_space, kSphere);
    return as_distance(kind == kSphere
                           ? sphere_along_ray(f.diag.x, f.c, o, ray.direction)
                           : small_sphere_along_ray(f.diag.x, f.c, o, ray.direction));
  }
  const Quadric f =
      half_space_quadric(half_space, kSurfaces == kAnySurfaces ? kind : kPlane);
  if (kind == kPlane || kSurfaces != kAnySurfaces)
    return as_distance(plane_along_ray(f.b, o, ray.direction));
  if (kind == kSphere) return as_distance(sphere_along_ray(f.diag.x, f.c, o, ray.direction));
  if (kind == kSmallSphere)
    return as_distance(small_sphere_along_ray(f.diag.x, f.c, o, ray.direction));
  if (kind == kCone) return from_tip(cone_along_ray(f, o, ray.direction), f, o);
  if (kind == kSmallCone) return from_tip(small_quadric_along_ray(f, o, ray.direction), f, o);
  if (kind == kSmallQuadric) return as_distance(small_quadric_along_ray(f, o, ray.direction));
  // kDiagonal, too: the same numbers, and no more code for the driver to write out.
  return as_distance(quadric_along_ray(f, o, ray.direction));
}

struct Signs {
  bool inside;  // the ray is in the half-space where it enters the cell
  bool at_end;  // and where it leaves it
  bool bends;   // it is the same at both, and the other between
};

Signs signs_of(OnRay on_ray) {
  const AlongRay f = on_ray.f;
  const Real t0 = way_start, t1 = way_end;
  const Real value0 = along_value(f, t0), value1 = along_value(f, t1);
  bool inside0 = value0 <= K(0), inside1 = value1 <= K(0);
  bool falls0 = f.a * (t0 - f.about) + f.h < K(0), falls1 = f.a * (t1 - f.about) + f.h < K(0);
  if (t0 <= at_eye) {
    // Who stands on a surface has passed it: there the side is that of the way just ahead.
    const bool on0 = fabs_(value0) <= on_ray.on_surface;
    if (on0) inside0 = falls0 = f.a * (t0 - f.about + on_ray.ahead) + f.h < K(0);
    if (t1 <= at_eye && fabs_(value1) <= on_ray.on_surface)
      inside1 = falls1 = f.a * (t1 - f.about + on_ray.ahead) + f.h < K(0);
    // A plane through the eye is not crossed again, and one that the ray runs in not at all.
    if (on0 && f.a == K(0)) inside0 = inside1;
  }
  const Real bend = inside0 ? K(0) - f.a : f.a;
  const bool bends = inside0 == inside1 && bend > K(0) && falls0 != falls1 && f.h * f.h > f.a * f.k;
  return Signs(inside0, inside1, bends);
}

bool in_doubt(Signs signs) { return false; }

// One crossing, and the first of several.
struct Crossing {
  Real t;
};
struct Next {
  Real t;
};

// Where f rises, or falls.
Crossing crossing_of(OnRay on_ray, bool rising) {
  // The signs say that it is within; rounding may not.
  return Crossing(pmin(pmax(way_start, along_root(on_ray.f, rising)), way_end));
}

const Crossing kNever = Crossing(kFar);
const Next kNoNext = Next(kFar);

void add(inout Next next, Crossing crossing) { next.t = pmin(next.t, crossing.t); }

// Crossings until then coincide with it.
Real end_of(Next next) { return next.t + view_ray_tolerance(); }

bool is_crowded(Next next) { return false; }

bool is_side_in_doubt(Quadric f, Vec3 q, Next at) { return false; }

Next refined(uint half_space, Quadric f, Next at) { return at; }

bool are_facts_in_doubt(Quadric f, Vec3 q, Next at) { return false; }
