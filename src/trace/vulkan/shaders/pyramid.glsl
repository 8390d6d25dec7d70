// The farthest depths of squares of the tile, in two levels: squares of 8 x 8 pixels, and behind
// them squares of 8 x 8 such. Row by row.
const int kSquare = 8;

ivec2 squares() { return (view.tile_size + kSquare - 1) / kSquare; }
ivec2 large_squares() { return (squares() + kSquare - 1) / kSquare; }
int place_of_square(ivec2 at) { return at.y * squares().x + at.x; }
int place_of_large_square(ivec2 at) {
  return squares().x * squares().y + at.y * large_squares().x + at.x;
}
