// Where in the picture a pixel of the tile looks: its centre, or a place that was asked for.
#if WHITTLE_STORAGE
layout(set = 0, binding = kPositionsBinding) readonly buffer Positions { vec2 positions[]; };
vec2 asked_position(int i) { return positions[i]; }
#else
layout(set = 0, binding = kPositionsBinding) uniform samplerBuffer positions;
vec2 asked_position(int i) { return texelFetch(positions, i).xy; }
#endif

vec2 position_of(ivec2 pixel) {
  const bool probes = view.probes != 0;
  const vec2 asked =
      asked_position((pixel.y * view.tile_size.x + pixel.x) * int(probes));
  return mix(vec2(pixel + view.tile_origin) + 0.5, asked, bvec2(probes));
}
