// Where the boxes of cells are in the picture.

// A cell's box seen from the eye, grown by so many pixels at its farthest corner.
Box grown_box(uint cell) {
  Box box = cell_box(cell);
  const Vec3 eye = view_eye();
  box.lo -= eye;
  box.hi -= eye;
  const bool orthographic = view.orthographic != 0;
  const vec3 farthest = vec3(max(abs(box.lo), abs(box.hi)));
  const Real grow = view_scale() * view.margin * mix(length(farthest), 1.0, orthographic);
  box.lo -= grow;
  box.hi += grow;
  return box;
}

// Where such a point is, in pixels from the tile's corner. It lies well ahead of the eye.
vec2 place_in_tile(Vec3 p) {
  const bool orthographic = view.orthographic != 0;
  const Real scale = view_scale() * mix(dot3(p, view_forward()), K(1), orthographic);
  return vec2(view_half_width() + dot3(p, view_right()) / scale - Real(view.tile_origin.x),
              view_half_height() - dot3(p, view_up()) / scale - Real(view.tile_origin.y));
}
