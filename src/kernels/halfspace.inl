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

// No less than the slope of a cone's f, q from its tip.
FN Real cone_most_slope(Quadric f, Real distance) {
  Real squares = dot3(f.diag, f.diag) + K(2) * dot3(f.off, f.off);
  return K(2) * sqrt(squares) * distance;
}

// A plane's: b is half its normal.
FN AlongRay plane_along_ray(Vec3 b, Vec3 o, Vec3 d) {
  return make_along(K(0), dot3(b, d), K(2) * dot3(b, o), K(0));
}

// A sphere's, diag = (scale, scale, scale).
FN AlongRay sphere_along_ray(Real scale, Real c, Vec3 o, Vec3 d) {
  return make_along(scale, scale * dot3(o, d), scale * dot3(o, o) + c, K(0));
}

// A sphere's that is small beside o, taken about the place nearest to its centre: see
// small_quadric_along_ray.
FN AlongRay small_sphere_along_ray(Real scale, Real c, Vec3 o, Vec3 d) {
  Real near = K(0) - dot3(o, d);
  Vec3 p = make_vec3(o.x + d.x * near, o.y + d.y * near, o.z + d.z * near);
  return make_along(scale, scale * dot3(p, d), scale * dot3(p, p) + c, near);
}

// A quadric's with neither off nor b, about the axes: the same numbers for less.
FN AlongRay diagonal_along_ray(Vec3 diag, Real c, Vec3 o, Vec3 d) {
  Vec3 ad = make_vec3(diag.x * d.x, diag.y * d.y, diag.z * d.z);
  Vec3 ao = make_vec3(diag.x * o.x, diag.y * o.y, diag.z * o.z);
  return make_along(dot3(ad, d), dot3(ad, o), dot3(ao, o) + c, K(0));
}

FN AlongRay quadric_along_ray(Quadric f, Vec3 o, Vec3 d) {
  Vec3 ad = quadric_apply(f, d);
  return make_along(dot3(ad, d), dot3(ad, o) + dot3(f.b, d), quadric_value(f, o), K(0));
}

// A cone's about its tip, where f has neither b nor c. Near the tip f is a difference of squares that
// are as small as it is only about the place nearest to the tip.
FN AlongRay cone_along_ray(Quadric f, Vec3 o, Vec3 d) {
  Real near = K(0) - dot3(o, d);
  Vec3 p = make_vec3(o.x + d.x * near, o.y + d.y * near, o.z + d.z * near);
  Vec3 ad = quadric_apply(f, d);
  return make_along(dot3(ad, d), dot3(ad, p), dot3(quadric_apply(f, p), p), near);
}

// quadric_along_ray for a surface that is small beside o, or flat: squares of what is large would drown it
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

// The same as along_value for a plane.
FN Real plane_value(AlongRay f, Real t) { return K(2) * f.h * t + f.k; }

// Bounds of a sphere's f over the box with centre m and half size h: exact (from the box's nearest
// and farthest point), widened by `slack` times the magnitudes of the terms, which covers the rounding
// of this evaluation and of a ray's.
FN Vec2 sphere_range(Real scale, Real c, Vec3 m, Vec3 h, Real slack) {
  Vec3 a = make_vec3(fabs_(m.x), fabs_(m.y), fabs_(m.z));
  Vec3 far_point = make_vec3(a.x + h.x, a.y + h.y, a.z + h.z);
  Vec3 near_point =
      make_vec3(pmax(a.x - h.x, K(0)), pmax(a.y - h.y, K(0)), pmax(a.z - h.z, K(0)));
  Real high = scale * dot3(far_point, far_point);
  Real w = slack * (high + fabs_(c));
  return make_vec2(scale * dot3(near_point, near_point) + c - w, high + c + w);
}
