// Facts: what a ray sees. Every backend fills these; colours are made from them elsewhere.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/uninitialized.h"
#include "base/vec.h"

namespace whittle {

/// A ray {origin + t * direction : t >= t_min}; the direction is unit, so t is a length.
struct Ray {
  Vec3 origin;
  Vec3 direction;
  double t_min = 0;
  /// Nobody asks what is farther: a hit there may be told or not.
  double t_max = std::numeric_limits<double>::infinity();
};

/// The first point with t > t_min at which the ray enters or leaves the solid.
struct Hit {
  float distance = std::numeric_limits<float>::infinity();  ///< t, model units; infinity: no hit
  uint32_t id = 0;  ///< owner primitive (docs/conventions.md, tie rules); 0: no hit
  Vec3f normal;     ///< unit outward normal of the solid, world space; zero: no hit
  bool hit() const { return id != 0; }
};

/// A point with t > t_min at which a ray enters or leaves the solid.
struct SurfaceCrossing {
  double distance = 0;  ///< t, model units
  uint32_t id = 0;      ///< as in Hit
  bool enters = false;  ///< beyond it the ray is in the solid
  Vec3 normal;          ///< as in Hit
};

/// All crossings of some rays, each ray's from its start on.
struct RayCrossings {
  std::vector<SurfaceCrossing> all;  ///< ray by ray
  std::vector<size_t> ends;          ///< by ray: where in `all` those of the next begin

  std::span<const SurfaceCrossing> of(size_t ray) const {
    const size_t first = ray == 0 ? 0 : ends[ray - 1];
    return std::span(all).subspan(first, ends[ray] - first);
  }
};

/// One hit a pixel, rows from the top, each from the left.
struct Frame {
  int width = 0, height = 0;
  UninitializedVector<Hit> hits;  ///< width * height

  Frame() = default;
  Frame(int w, int h) : width(w), height(h), hits(size_t(w) * size_t(h), Hit{}) {}
  /// For whoever writes every pixel, on many threads.
  static Frame unfilled(int w, int h) {
    Frame frame;
    frame.width = w, frame.height = h;
    frame.hits.resize(size_t(w) * size_t(h));
    return frame;
  }
  const Hit& at(int x, int y) const { return hits[size_t(y) * size_t(width) + size_t(x)]; }
  Hit& at(int x, int y) { return hits[size_t(y) * size_t(width) + size_t(x)]; }
};

}  // namespace whittle
