// Random models as `.csg` text: trees that nobody would think of, the same from the same seed.
#pragma once

#include <cstdint>
#include <string>

namespace whittle {

struct RandomTreeOptions {
  int primitives = 12;      ///< about how many primitive statements
  bool coincident = false;  ///< everything on a coarse grid and square to the axes, so that faces
                            ///< lie on one another often; otherwise coordinates lie on no grid
  bool nearly = false;      ///< with coincident: half of the sizes, places and angles are off by
                            ///< 1e-6.5 to 1e-2.5 (the tolerance is about 1e-4.5)
  bool halfspaces = false;  ///< some half-spaces among the operands
  bool modifiers = true;    ///< some operands under % and #, some empty operands
};

/// A model of all operations and primitives, nested, under all kinds of transforms and colours,
/// within about 12 units of the origin. Numbers carry six digits, as in OpenSCAD's own files, or
/// ten with `nearly`. The same seed and options give the same text on every platform.
std::string random_tree(uint64_t seed, const RandomTreeOptions& options = {});

}  // namespace whittle
