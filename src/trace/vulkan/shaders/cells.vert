#version 460
// The cells on the screen: of each box the faces that the eye sees, a little larger than they are,
// so that no rounding of the rasteriser loses a pixel. The fragments cut exactly.
#extension GL_GOOGLE_include_directive : require
#include "numbers.glsl"
#include "cases.glsl"
#include "view.glsl"
#include "scene.glsl"
#include "boxes.glsl"

layout(location = 0) in uint cell;    // per instance
layout(location = 1) in float depth;  // and in which order
layout(location = 0) flat out uint cell_out;

// Vertices 0 to 11: three faces of four; 12 to 15: a square that covers the picture.
void main() {
  cell_out = cell;
  const vec2 corner = vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1 & 1);
  if (gl_VertexIndex >= 12) {
    gl_Position = vec4(corner * 2 - 1, depth, 1);
    return;
  }
  const Box box = grown_box(cell);
  const Vec3 forward = view_forward();
  const bool orthographic = view.orthographic != 0;
  // The side of the box that is seen along the face's axis, if any.
  const int axis = gl_VertexIndex >> 2;
  const bvec3 is_axis = equal(ivec3(axis), ivec3(0, 1, 2));
  const Vec3 toward_lo = mix(box.lo + view_to_axis(), forward, bvec3(orthographic));
  const Vec3 toward_hi =
      mix(Vec3(0) - (box.hi + view_to_axis()), Vec3(0) - forward, bvec3(orthographic));
  const bool sees_lo = any(greaterThan(mix(vec3(0), vec3(toward_lo), is_axis), vec3(0)));
  const bool sees_hi = any(greaterThan(mix(vec3(0), vec3(toward_hi), is_axis), vec3(0)));
  if (!sees_lo && !sees_hi) {
    gl_Position = vec4(2, 2, depth, 1);
    return;
  }
  // Which corner: the face's side along its axis, and the vertex's along the next two.
  const bool first = corner.x != 0, second = corner.y != 0;
  const bvec3 is_hi = bvec3(axis == 0 ? sees_hi : axis == 1 ? second : first,
                            axis == 1 ? sees_hi : axis == 2 ? second : first,
                            axis == 2 ? sees_hi : axis == 0 ? second : first);
  const Vec3 p = Vec3(is_hi.x ? box.hi.x : box.lo.x, is_hi.y ? box.hi.y : box.lo.y,
                      is_hi.z ? box.hi.z : box.lo.z);
  gl_Position = vec4(place_in_tile(p) / vec2(view.tile_size) * 2 - 1, depth, 1);
}
