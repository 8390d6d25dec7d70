// The arithmetic of one half-space {p : f(p) <= 0}, f a quadric (a plane is a quadric whose second
// degree is zero). Written in the subset that C++ and GLSL share (docs/numerics.md): pure
// functions of numbers, no branches on values, select/pmin/pmax instead.
//
//   f(q) = q.A q + 2 b.q + c        q = p - centre of the half-space
//
// diag = (A_xx, A_yy, A_zz), off = (A_yz, A_xz, A_xy).

struct Quadric {
  Vec3 diag;
  Vec3 off;
  Vec3 b;
  Real c;
};

// A q: the second-degree part applied once.
FN Vec3 quadric_apply(Quadric f, Vec3 q) {
  return make_vec3(f.diag.x * q.x + f.off.z * q.y + f.off.y * q.z,
                   f.off.z * q.x + f.diag.y * q.y + f.off.x * q.z,
                   f.off.y * q.x + f.off.x * q.y + f.diag.z * q.z);
}

FN Real quadric_value(Quadric f, Vec3 q) {
  return dot3(quadric_apply(f, q), q) + K(2) * dot3(f.b, q) + f.c;
}

// Half of the gradient: A q + b. Its direction is the outward normal of the half-space.
FN Vec3 quadric_half_gradient(Quadric f, Vec3 q) {
  Vec3 g = quadric_apply(f, q);
  return make_vec3(g.x + f.b.x, g.y + f.b.y, g.z + f.b.z);
}

// f along a ray o + t d (o relative to the half-space's centre, d unit) as a quadratic about some
// place of the ray: with s = t - about it is a s^2 + 2 h s + k.
struct AlongRay {
  Real a;
  Real h;
  Real k;
  Real about;
};

FN AlongRay make_along(Real a, Real h, Real k, Real about) {
  AlongRay r;
  r.a = a;
  r.h = h;
  r.k = k;
  r.about = about;
  return r;
}

// A plane's: b is half its normal.
FN AlongRay plane_along_ray(Vec3 b, Vec3 o, Vec3 d) {
  return make_along(K(0), dot3(b, d), K(2) * dot3(b, o), K(0));
}

// A sphere's, diag = (scale, scale, scale).
FN AlongRay sphere_along_ray(Real scale, Real c, Vec3 o, Vec3 d) {
  return make_along(scale, scale * dot3(o, d), scale * dot3(o, o) + c, K(0));
}

FN AlongRay quadric_along_ray(Quadric f, Vec3 o, Vec3 d) {
  Vec3 ad = quadric_apply(f, d);
  return make_along(dot3(ad, d), dot3(ad, o) + dot3(f.b, d), quadric_value(f, o), K(0));
}

// The same for a surface that is small beside o, or flat: squares of what is large would drown it
// in their rounding, so it is taken about a place next to it. That is where f is flat along the ray
// (inside a flat body, where its largest terms vanish), unless this is far from the place nearest
// to the centre, which is the better choice then.
FN AlongRay small_quadric_along_ray(Quadric f, Vec3 o, Vec3 d) {
  Real near = K(0) - dot3(o, d);
  Vec3 p = make_vec3(o.x + d.x * near, o.y + d.y * near, o.z + d.z * near);
  Vec3 ad = quadric_apply(f, d);
  Real bd = dot3(f.b, d);
  Real a = dot3(ad, d);
  Real h = dot3(ad, p) + bd;
  Bool close = h * h < K(256) * a * a * dot3(p, p);
  Real step = select(close, K(0) - h / select(close, a, K(1)), K(0));
  Vec3 q = make_vec3(p.x + d.x * step, p.y + d.y * step, p.z + d.z * step);
  return make_along(a, dot3(ad, q) + bd, quadric_value(f, q), near + step);
}

// a t^2 + 2 h t + k.
FN Real quadratic_value(Real a, Real h, Real k, Real t) { return (a * t + K(2) * h) * t + k; }

// The root of a t^2 + 2 h t + k at which it rises through zero (falls, if not `rising`), where a t +
// h = +-sqrt(h^2 - a k). The stable form: where the sum -h +- sqrt would cancel, the other root's
// product rule k / q is used, so no digits are lost (Press et al., Numerical Recipes, 5.6.4). a = 0
// needs no special case. Meaningless if there is no such root.
FN Real quadratic_root(Real a, Real h, Real k, Bool rising) {
  Real discriminant = h * h - a * k;
  Real s = sqrt(pmax(discriminant, K(0)));
  Real w = select(rising, s, K(0) - s);  // a t = w - h
  Bool cancels = h * w > K(0);
  return select(cancels, k, w - h) / select(cancels, K(0) - (h + w), a);
}

FN Real along_value(AlongRay f, Real t) { return quadratic_value(f.a, f.h, f.k, t - f.about); }

FN Real along_root(AlongRay f, Bool rising) {
  return f.about + quadratic_root(f.a, f.h, f.k, rising);
}

// Bounds of a sphere's f over the box with centre m and half size h: exact (from the box's nearest
// and farthest point), widened as in quadric_range.
FN Vec2 sphere_range(Real scale, Real c, Vec3 m, Vec3 h, Real slack) {
  Vec3 a = make_vec3(fabs_(m.x), fabs_(m.y), fabs_(m.z));
  Vec3 far_point = make_vec3(a.x + h.x, a.y + h.y, a.z + h.z);
  Vec3 near_point =
      make_vec3(pmax(a.x - h.x, K(0)), pmax(a.y - h.y, K(0)), pmax(a.z - h.z, K(0)));
  Real high = scale * dot3(far_point, far_point);
  Real w = slack * (high + fabs_(c));
  return make_vec2(scale * dot3(near_point, near_point) + c - w, high + c + w);
}

// The range of one term g x + a x^2 over -h <= x <= h: x is the low end, y the high end.
FN Vec2 axis_range(Real g, Real a, Real h) {
  Real low_end = a * h * h - g * h;
  Real high_end = a * h * h + g * h;
  // The vertex counts if it lies strictly inside.
  Bool inner = fabs_(g) < K(2) * fabs_(a) * h;
  Real vertex = select(inner, (K(0) - g * g) / (K(4) * select(inner, a, K(1))), low_end);
  return make_vec2(pmin(pmin(low_end, high_end), vertex), pmax(pmax(low_end, high_end), vertex));
}

// Bounds of f over the box with centre m (relative to the half-space's centre) and half size h:
// the centred form, exact for quadrics without mixed terms (planes, spheres, axis-aligned cylinders
// and cones), else widened by the mixed terms' extremes. Widened by `slack` times the sum of the
// terms' magnitudes, which covers the rounding of this evaluation and of a ray's.
FN Vec2 quadric_range(Quadric f, Vec3 m, Vec3 h, Real slack) {
  Real value = quadric_value(f, m);
  Vec3 g = quadric_half_gradient(f, m);
  Vec2 x = axis_range(K(2) * g.x, f.diag.x, h.x);
  Vec2 y = axis_range(K(2) * g.y, f.diag.y, h.y);
  Vec2 z = axis_range(K(2) * g.z, f.diag.z, h.z);
  Real mixed = K(2) * (fabs_(f.off.x) * h.y * h.z + fabs_(f.off.y) * h.x * h.z +
                       fabs_(f.off.z) * h.x * h.y);
  Vec3 r = make_vec3(fabs_(m.x) + h.x, fabs_(m.y) + h.y, fabs_(m.z) + h.z);
  Real magnitude = fabs_(f.diag.x) * r.x * r.x + fabs_(f.diag.y) * r.y * r.y +
                   fabs_(f.diag.z) * r.z * r.z +
                   K(2) * (fabs_(f.off.x) * r.y * r.z + fabs_(f.off.y) * r.x * r.z +
                           fabs_(f.off.z) * r.x * r.y + fabs_(f.b.x) * r.x +
                           fabs_(f.b.y) * r.y + fabs_(f.b.z) * r.z) +
                   fabs_(f.c);
  Real w = mixed + slack * magnitude;
  return make_vec2(value + x.x + y.x + z.x - w, value + x.y + y.y + z.y + w);
}
