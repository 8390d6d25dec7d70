#version 460
// Which instances may be seen: not those behind all that has been drawn in the pixels where they
// are. A row of workgroups looks at the instances of one command.
#extension GL_GOOGLE_include_directive : require
#include "numbers.glsl"
#include "cases.glsl"
#include "view.glsl"
#include "scene.glsl"
#include "boxes.glsl"
#include "pyramid.glsl"

layout(local_size_x = kGroupSide * kGroupSide) in;

struct Command {
  uint index_count, instance_count, first_index, vertex_offset, first_instance;
  uint first, count;  // instances to look at
  uint to;            // where those go that may be seen
};
struct Instance {
  uint cell;
  float depth;
};
layout(set = 0, binding = kPyramidBinding) readonly buffer Pyramid { float pyramid[]; };
layout(set = 0, binding = kInstancesBinding) buffer Instances { Instance instances[]; };
layout(set = 0, binding = kDrawsBinding) buffer Commands { Command commands[]; };

bool is_hidden(Instance instance) {
  const Box box = grown_box(instance.cell);
  vec2 lo = vec2(1e30), hi = vec2(-1e30);
  for (int i = 0; i < 8; ++i) {
    const vec2 at = place_in_tile(Vec3((i & 1) != 0 ? box.hi.x : box.lo.x,
                                       (i & 2) != 0 ? box.hi.y : box.lo.y,
                                       (i & 4) != 0 ? box.hi.z : box.lo.z));
    lo = min(lo, at);
    hi = max(hi, at);
  }
  // A pixel more than that: rasterisers round.
  const vec2 last_pixel = vec2(view.tile_size - 1);
  ivec2 first = ivec2(clamp(lo - 1, vec2(0), last_pixel)) / kSquare;
  ivec2 last = ivec2(clamp(hi + 1, vec2(0), last_pixel)) / kSquare;
  // Where there are many squares, large ones say enough.
  const bool large = any(greaterThan(last - first, ivec2(4)));
  if (large) {
    first /= kSquare;
    last /= kSquare;
  }
  for (int y = first.y; y <= last.y; ++y)
    for (int x = first.x; x <= last.x; ++x) {
      const ivec2 at = ivec2(x, y);
      const int place = large ? place_of_large_square(at) : place_of_square(at);
      if (pyramid[place] > instance.depth) return false;
    }
  return true;
}

void main() {
  const uint command = gl_WorkGroupID.y;
  if (gl_GlobalInvocationID.x >= commands[command].count) return;
  const Instance instance = instances[commands[command].first + gl_GlobalInvocationID.x];
  if (is_hidden(instance)) return;
  const uint at = atomicAdd(commands[command].instance_count, 1);
  instances[commands[command].to + at] = instance;
}
