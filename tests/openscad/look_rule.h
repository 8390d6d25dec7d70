// When `whittle --style openscad` shows what `openscad --render` shows: the same picture to a level
// of 255, away from edges.
//
// What an edge is, whittle's own facts say: a pixel is compared if it and its eight neighbours see
// one face of one primitive (or all see nothing) in one colour. At edges each pixel of OpenSCAD's
// must be found in ours at most one pixel away; slivers narrower than a pixel, at corners, may not
// be.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include "image/picture.h"
#include "trace/frame.h"

namespace whittle {

struct Look {
  Picture theirs, ours;
  Frame facts;
};

/// The largest difference of a channel, of 255.
int difference(const uint8_t* a, const uint8_t* b);

/// The pixels at which whittle sees a surface.
size_t hits(const Frame& facts);

struct Differences {
  size_t pixels = 0;        ///< of the picture
  size_t hits = 0;          ///< pixels where we see the solid
  size_t inner_hits = 0;    ///< of them, those compared
  size_t edges = 0;         ///< pixels not compared
  size_t wrong = 0;         ///< compared, and off by more than one level
  size_t unequal = 0;       ///< at edges: another colour than ours
  size_t unexplained = 0;   ///< and nowhere around in ours
  int largest = 0;          ///< of all that are compared
  std::string first_wrong;  ///< place and values

  bool same() const { return wrong == 0 && unexplained <= edges / 500; }
  /// Of a file that is flat at the top, lines count, too: all but a few pixels at edges are equal,
  /// where a corner lies so that the last bit of a float decides.
  bool same_drawing() const { return same() && unequal <= std::max<size_t>(3, edges / 200); }
  /// Whether so much was compared that `same` says something.
  bool enough_seen() const { return hits > pixels / 100; }
  bool enough_compared() const { return inner_hits > hits / 2 && edges < pixels / 8; }
};

/// All three must have one size.
Differences compare(const Look& look);

}  // namespace whittle
