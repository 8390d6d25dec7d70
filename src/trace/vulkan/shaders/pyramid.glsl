// The farthest depths of squares of the tile, in two levels: squares of pixels, and behind them
// squares of as many squares. Row by row.
const int kSquare = int(kGroupSide);

ivec2 squares() { return (view.tile_size + kSquare - 1) / kSquare; }
ivec2 large_squares() { return (squares() + kSquare - 1) / kSquare; }
int place_of_square(ivec2 at) { return at.y * squares().x + at.x; }
int place_of_large_square(ivec2 at) {
  return squares().x * squares().y + at.y * large_squares().x + at.x;
}
