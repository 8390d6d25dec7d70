// The constants that the arithmetic of rays goes by, written once for C++ (constants.h) and GLSL
// (numbers.glsl). Lengths are shares of the region's longest edge.

// Curved surfaces whose radius is below this get the arithmetic for small ones (docs/numerics.md).
NUMBER(kSmallRadius, 1.0 / 64)

// An eye this close to a surface stands on it. This is above what rounding does.
NUMBER(kOnSurface, 2e-14)
// A ray that has come no farther than this is still at the eye.
NUMBER(kAtEye, 1e-13)
// A ray that starts on a surface is on the side where it is this far ahead. Near the tip of a cone,
// which has no slope, it is this share of the distance from the tip.
NUMBER(kAhead, 1e-9)

// Which arithmetic a half-space gets along a ray. It depends on the half-space alone, so that f is
// one polynomial in every cell. Cones stand last: about their tips their b and c are zero.
ENUM(AlongKind)
  IS(kPlane, 0)
  IS(kSphere, 1)
  IS(kSmallSphere, 2)
  IS(kDiagonal, 3)  // neither off nor b: ellipsoids and cylinders along the axes
  IS(kQuadric, 4)
  IS(kSmallQuadric, 5)
  IS(kCone, 6)
  IS(kSmallCone, 7)
END
