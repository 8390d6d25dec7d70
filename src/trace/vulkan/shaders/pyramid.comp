#version 460
// From the depths of a tile to the farthest of each square of it. The squares of a workgroup are
// one large square.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "numbers.glsl"
#include "cases.glsl"
#include "view.glsl"
#include "scene.glsl"
#include "pyramid.glsl"

layout(local_size_x = kSquare, local_size_y = kSquare) in;

layout(set = 0, binding = kDepthsBinding) uniform texture2D depths;
layout(set = 0, binding = kPyramidBinding) writeonly buffer Pyramid { float pyramid[]; };

shared float of_square[kSquare * kSquare];

void main() {
  const ivec2 square = ivec2(gl_GlobalInvocationID.xy);
  float farthest = 0;
  for (int y = 0; y < kSquare; ++y)
    for (int x = 0; x < kSquare; ++x) {
      const ivec2 pixel = min(square * kSquare + ivec2(x, y), view.tile_size - 1);
      farthest = max(farthest, texelFetch(depths, pixel, 0).x);
    }
  if (all(lessThan(square, squares()))) pyramid[place_of_square(square)] = farthest;
  of_square[gl_LocalInvocationIndex] = farthest;
  barrier();
  if (gl_LocalInvocationIndex != 0) return;
  for (int i = 1; i < kSquare * kSquare; ++i) farthest = max(farthest, of_square[i]);
  pyramid[place_of_large_square(ivec2(gl_WorkGroupID.xy))] = farthest;
}
