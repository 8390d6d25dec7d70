// The camera, and the rays of its pixels. The numbers stand in the order of view_data.cpp.
//
// Nothing in View may decide a branch by itself: Mesa's software device would compile the shader
// anew for every value. mix() and select() choose without a branch.
layout(set = 0, binding = 0) uniform View {
  uvec4 numbers[10];  // two numbers each
  ivec2 tile_origin;  // its first pixel in the picture
  ivec2 tile_size;
  uint orthographic;
  uint probes;   // rays go through positions of their own, not through the pixels' centres
  float margin;  // pixels that a box is grown by on the screen
  uint picture;  // its number
} view;

Real view_number(int i) {
  const uvec4 pair = view.numbers[i >> 1];
  return to_real((i & 1) == 0 ? pair.xy : pair.zw);
}
Vec3 view_vector(int i) { return Vec3(view_number(i), view_number(i + 1), view_number(i + 2)); }

Vec3 view_eye() { return view_vector(0); }  // local coordinates
Vec3 view_right() { return view_vector(3); }
Vec3 view_up() { return view_vector(6); }
Vec3 view_forward() { return view_vector(9); }
Real view_scale() { return view_number(12); }
Real view_half_width() { return view_number(13); }
Real view_half_height() { return view_number(14); }
Real view_start() { return view_number(15); }       // t where rays start
Real view_at_eye() { return view_number(16); }      // so near is at the eye
Real view_on_surface() { return view_number(17); }  // and so near on a surface
Real view_ahead() { return view_number(18); }       // and so far ahead it looks where it goes
Real view_together() { return view_number(19); }    // crossings closer than this are one

struct Ray {
  Vec3 origin;  // local: the point nearest to the region's middle, as on the CPU
  Vec3 direction;
  Real shift;   // t at the camera's start minus t here
};

// The ray through a position of the picture, in pixels.
Ray make_ray(vec2 position) {
  const Real x = (Real(position.x) - view_half_width()) * view_scale();
  const Real y = (view_half_height() - Real(position.y)) * view_scale();
  Ray ray;
  const bvec3 orthographic = bvec3(view.orthographic != 0);
  const Vec3 base = mix(view_forward(), view_eye(), orthographic);
  const Vec3 point = picture_point(base, view_right(), view_up(), x, y);
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

// The way of a ray through a box, from its start on. False if there is none.
bool clip_to(Box box, Ray ray, out Real t0, out Real t1) {
  t0 = view_start() - ray.shift;
  t1 = kFar;
  return clip(box.lo.x, box.hi.x, ray.origin.x, ray.direction.x, t0, t1) &&
         clip(box.lo.y, box.hi.y, ray.origin.y, ray.direction.y, t0, t1) &&
         clip(box.lo.z, box.hi.z, ray.origin.z, ray.direction.z, t0, t1) && t0 <= t1;
}
