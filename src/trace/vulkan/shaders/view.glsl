// The camera. shader_constants.inl says where its numbers stand.
//
// Nothing in View may decide a branch by itself: Mesa's software device would compile the shader
// anew for every value. mix() and select() choose without a branch.
layout(set = 0, binding = kViewBinding) uniform View {
  uvec4 numbers[kViewNumbers / 2];  // two numbers each
  ivec2 tile_origin;  // its first pixel in the picture
  ivec2 tile_size;
  uint orthographic;
  uint probes;   // rays go through positions of their own, not through the pixels' centres
  float margin;  // pixels that a box is grown by on the screen
  uint picture;  // its number
} view;

uvec2 view_words(uint i) {
  const uvec4 pair = view.numbers[i >> 1];
  return (i & 1) == 0 ? pair.xy : pair.zw;
}
Real view_number(uint i) { return to_real(view_words(i)); }
Vec3 view_vector(uint i) { return Vec3(view_number(i), view_number(i + 1), view_number(i + 2)); }

Vec3 view_right() { return view_vector(kViewRight); }
Vec3 view_up() { return view_vector(kViewUp); }
Vec3 view_forward() { return view_vector(kViewForward); }
Real view_scale() { return view_number(kViewScale); }
Real view_half_width() { return view_number(kViewHalfWidth); }
Real view_half_height() { return view_number(kViewHalfHeight); }
Real view_start() { return view_number(kViewStart); }  // t where rays start
// Where a position in pixels lies in the picture, from its middle.
Vec2 in_picture(vec2 position) {
  return Vec2((Real(position.x) - view_half_width()) * view_scale(),
              (view_half_height() - Real(position.y)) * view_scale());
}
// A place on the camera's axis, from which others are seen without loss, and from the eye to it.
Vec3 view_axis() { return view_vector(kViewAxis); }
#if WHITTLE_DOUBLE
Vec3 view_eye() { return view_axis(); }
Real view_axis_ahead() { return K(0); }
Vec3 view_to_axis() { return Vec3(0); }
Real view_at_eye() { return view_number(kViewAtEye); }  // so near is at the eye
Real view_on_surface() { return view_number(kViewOnSurface); }  // and so near on a surface
Real view_ahead() { return view_number(kViewAhead); }  // and so far ahead it looks where it goes
Real view_ray_tolerance() { return view_number(kViewRayTolerance); }  // closer crossings coincide
// Places are in the scene's local coordinates.
Vec3 place(uvec2 x, uvec2 y, uvec2 z) { return Vec3(to_real(x), to_real(y), to_real(z)); }
#else
Real view_axis_ahead() { return view_number(kViewAxisAhead); }  // so far ahead of the eye is the reference
Vec3 view_to_axis() { return view_forward() * view_axis_ahead(); }
Real view_grown() { return view_number(kViewGrown); }  // leaves are right so far beyond their cells
Real view_beyond() { return view_number(kViewBeyond); }  // so far beyond the cells changes count
Real view_at_surface() { return view_number(kViewAtSurface); }  // so near an eye stands on a surface
// Places are relative to the view's reference: what is near to it keeps its digits.
Real from_reference(uvec2 words, uint axis) {
  const uvec2 reference = view_words(kViewReference + axis);
  return (to_real(words) - to_real(reference)) + (rest_of(words) - rest_of(reference));
}
Vec3 place(uvec2 x, uvec2 y, uvec2 z) {
  return Vec3(from_reference(x, 0), from_reference(y, 1), from_reference(z, 2));
}
#endif
