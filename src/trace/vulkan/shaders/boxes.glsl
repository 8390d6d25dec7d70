// Where the boxes of cells are in the picture.

// A cell's box seen from view_axis(), grown by so many pixels at its corner farthest from the eye.
Box grown_box(uint cell) {
  Box box = cell_box(cell);
  box.lo -= view_axis();
  box.hi -= view_axis();
  const bool orthographic = view.orthographic != 0;
  const vec3 farthest = vec3(max(abs(box.lo + view_to_axis()), abs(box.hi + view_to_axis())));
  const Real grow = view_scale() * view.margin * mix(length(farthest), 1.0, orthographic);
  box.lo -= grow;
  box.hi += grow;
  return box;
}

// Where a point seen from there is, in pixels from the tile's corner. It lies well ahead of the
// eye.
vec2 place_in_tile(Vec3 p) {
  const bool orthographic = view.orthographic != 0;
  const Real ahead = dot3(p, view_forward()) + view_axis_ahead();
  const Real scale = view_scale() * mix(ahead, K(1), orthographic);
  return vec2(view_half_width() + dot3(p, view_right()) / scale - Real(view.tile_origin.x),
              view_half_height() - dot3(p, view_up()) / scale - Real(view.tile_origin.y));
}
