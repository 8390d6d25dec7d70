// What a tile of a picture can see of space: which boxes, and in which order.
#pragma once

#include <span>
#include <vector>

#include "base/box.h"
#include "trace/camera.h"
#include "trace/pixel_rect.h"

namespace whittle {

/// How a tile sees a box.
enum class BoxSight {
  kNone,  ///< no ray of the tile meets it
  kSome,
  /// Its corners have no good place in the picture: it reaches to the eye's plane or far beyond the
  /// picture's sides.
  kWide,
};

class Sight {
 public:
  /// `eye` and `origin`: the camera's eye in local coordinates, which all boxes have, and where
  /// these begin in the world. The tile is grown by `margin` pixels. The camera must outlive it.
  Sight(const Camera& camera, Vec3 eye, Vec3 origin, const PixelRect& tile, double margin);

  BoxSight look(Box box) const;

  /// Whether rays meet what is above a split before what is below it.
  bool starts_above(int axis, double split) const {
    return camera_.orthographic ? camera_.forward[axis] < 0 : eye_[axis] > split;
  }

  /// The pixels of the tile, counted from its corner, whose centres may see the box.
  PixelRect pixels(const Box& box) const;

 private:
  static bool is_far(double x, double ahead, double lo, double hi);

  const Camera& camera_;
  Vec3 eye_, origin_;
  PixelRect tile_;
  double grow_;                       ///< at distance 1
  double lo_x_, hi_x_, lo_y_, hi_y_;  ///< of the tile, at distance 1
};

/// The pixels of a tile that have been solved: cells behind all that has been drawn cannot change
/// them.
class SolvedPixels {
 public:
  /// `seen`: 0 where nothing has been seen yet, row by row.
  SolvedPixels(std::span<const uint32_t> seen, int width, int height);

  /// Whether all pixels of a rectangle are. May be false where it is so.
  bool holds(const PixelRect& pixels) const;

 private:
  static constexpr int kBlock = 8;  ///< pixels are looked at in squares of this side
  int columns_, rows_;
  /// Squares with unsolved pixels that lie above and left of each corner between squares.
  std::vector<uint32_t> unsolved_;
};

}  // namespace whittle
