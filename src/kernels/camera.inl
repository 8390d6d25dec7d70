// From a place in the picture to the direction of its ray. The dialect is that of halfspace.inl.

// A unit vector along v, which is not zero.
FN Vec3 unit3(Vec3 v) {
  Real inverse = K(1) / sqrt(dot3(v, v));
  return make_vec3(v.x * inverse, v.y * inverse, v.z * inverse);
}

// base + right x + up y: where picture position (x, y) lies, seen from `base`.
FN Vec3 picture_point(Vec3 base, Vec3 right, Vec3 up, Real x, Real y) {
  return make_vec3(base.x + right.x * x + up.x * y, base.y + right.y * x + up.y * y,
                   base.z + right.z * x + up.z * y);
}
