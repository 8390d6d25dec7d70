// What the shared arithmetic of src/kernels means in GLSL. WHITTLE_DOUBLE chooses the number type.
// A number travels in two words either way, so that all data have one layout: a double, or the
// float next to it and the float next to what is left.
#if WHITTLE_DOUBLE
#define Real double
#define Vec2 dvec2
#define Vec3 dvec3
Real to_real(uvec2 words) { return packDouble2x32(words); }
#else
#define Real float
#define Vec2 vec2
#define Vec3 vec3
Real to_real(uvec2 words) { return uintBitsToFloat(words.x); }
// What that has lost of the number.
Real rest_of(uvec2 words) { return uintBitsToFloat(words.y); }
#endif

#define Bool bool
#define FN
#define K(x) Real(x)

Real select(bool condition, Real yes, Real no) { return condition ? yes : no; }
Real pmin(Real a, Real b) { return b < a ? b : a; }
Real pmax(Real a, Real b) { return a < b ? b : a; }
Real fabs_(Real a) { return abs(a); }
Real dot3(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3 make_vec3(Real x, Real y, Real z) { return Vec3(x, y, z); }
Vec2 make_vec2(Real x, Real y) { return Vec2(x, y); }

// What is written once for C++ and GLSL.
#define NUMBER(name, value) const Real name = Real(value);
#define UINT(name, value) const uint name = value;
#define ENUM(name)
#define IS(name, value) const uint name = value;
#define END
#include "kernels/constants.inl"
#include "trace/vulkan/shader_constants.inl"

#include "kernels/camera.inl"
#include "kernels/halfspace.inl"

// Beyond any t of a ray that matters, and below any length that does.
const Real kFar = Real(1e38);
const Real kNothing = Real(1e-30);
