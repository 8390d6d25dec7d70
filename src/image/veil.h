// What is see-through in front of what is opaque: walls that rays go on through, laid over colours.
//
// Each surface of a see-through solid that a ray crosses, the near ones and the far ones alike,
// hides the share of what lies behind it that its alpha says. Walls are told apart exactly, by all
// crossings of each ray with each solid, whatever the order in the file. Where a wall lies on one
// of another solid, a rule says which is in front (docs/decisions/0051-see-through.md).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/workers.h"
#include "image/shade.h"
#include "model/instances.h"
#include "trace/tracer.h"

namespace whittle {

/// A solid that is seen through.
struct VeilLayer {
  Tracer* tracer = nullptr;
  Frame first;              ///< what the camera sees of it alone
  uint32_t first_look = 0;  ///< what to add to its ids to find looks
  bool is_ghost = false;    ///< no part of the solid: it casts no shadow, and is before others
};

/// A surface that a ray crosses before it meets what is opaque.
struct VeilWall {
  double distance = 0;
  uint32_t look = 0;   ///< index of looks
  uint32_t layer = 0;  ///< and the how many-th of its crossings with the ray it is
  uint32_t index = 0;
  Vec3f normal;
  float opacity = 1;  ///< 0 to 1
  float line = 0;     ///< how strong the line on it is, 0 to 1
  bool enters = false;
};

/// Crossings of the rays through some places of the picture.
struct VeilSight {
  std::span<const PixelPosition> places;
  std::span<const Hit> opaque;                ///< what is behind, one a place
  std::vector<RayCrossings> crossings;        ///< a layer each
  std::vector<std::vector<uint32_t>> ray_of;  ///< by layer, then place: which ray; kNone: none
  static constexpr uint32_t kNone = UINT32_MAX;
};

/// What one task works with.
struct VeilScratch {
  std::vector<VeilWall> walls;
  std::vector<size_t> ends;  ///< by place: where in `walls` those of the next begin
  std::vector<Hit> hits;
  std::vector<PixelPosition> places;
  SeenHits seen;
  Colors colors;
};

class Veil {
 public:
  /// `looks` are those of all layers, `tolerance` is the model's: surfaces that are no farther
  /// apart lie on one another. What the layers refer to must outlive this.
  Veil(std::vector<VeilLayer> layers, std::span<const Appearance> looks, const Camera& camera,
       const ShadeSettings& settings, double tolerance);

  const std::vector<VeilLayer>& layers() const { return layers_; }
  /// How much a shadow of that layer darkens, 0 to 1: the most that one of its surfaces hides.
  float shade(size_t layer) const { return shades_[layer]; }

  /// Sends rays through any places. From one thread at a time.
  void look(std::span<const PixelPosition> places, std::span<const Hit> opaque, VeilSight& sight);

  /// Goes through a picture in bands of rows: draw(first row, last row, sight) is told what is seen
  /// through the middles of the band's pixels. Adds where walls of neighbours differ to
  /// `differences` (later_differences()), unless that is empty: nobody asks.
  template <class Draw>
  void for_bands(const Frame& opaque, const Workers& workers, std::vector<uint8_t>& differences,
                 const Draw& draw);

  /// The walls seen through some places, near ones first, to scratch.walls.
  void find_walls(const VeilSight& sight, size_t first, size_t count, VeilScratch& scratch) const;
  /// Draws lines on the walls of a pixel's samples, the places [first, last) of `scratch`, by those
  /// that are seen through its middle.
  void draw_lines(std::span<const PixelPosition> places, size_t first, size_t last,
                  std::span<const VeilWall> middle, PixelPosition middle_place,
                  VeilScratch& scratch) const;
  /// Lays scratch.walls over as many colours, from the `at`-th on.
  void cover(std::span<const PixelPosition> places, VeilScratch& scratch, Colors& colors,
             size_t at) const;

 private:
  void look_at_rows(const Frame& opaque, size_t first, size_t last,
                    std::vector<PixelPosition>& places, VeilSight& sight);
  void cast(size_t layer, std::span<const PixelPosition> places, VeilSight& sight);
  void order(Vec3 direction, std::vector<VeilWall>& walls, size_t first) const;
  void add_differences(const VeilSight& sight, size_t width, size_t rows, bool has_below,
                       const Workers& workers, std::span<uint8_t> differences) const;

  std::vector<VeilLayer> layers_;
  std::vector<float> opacities_;  ///< by look
  std::vector<float> shades_;
  const Camera camera_;
  const Shader shader_;
  const double tolerance_;
  std::vector<Ray> rays_;
};

template <class Draw>
void Veil::for_bands(const Frame& opaque, const Workers& workers, std::vector<uint8_t>& differences,
                     const Draw& draw) {
  constexpr size_t kPixelsPerBand = size_t(1) << 17;
  const size_t width = size_t(opaque.width), height = size_t(opaque.height);
  const size_t rows = std::max<size_t>(1, kPixelsPerBand / width);
  std::vector<PixelPosition> places;
  VeilSight sight;
  for (size_t first = 0; first < height; first += rows) {
    const size_t last = std::min(height, first + rows);
    // And the row below, for the edges between.
    const size_t end = std::min(height, last + 1);
    look_at_rows(opaque, first, end, places, sight);
    if (!differences.empty())
      add_differences(sight, width, last - first, end > last, workers,
                      std::span(differences).subspan(first * width, (last - first) * width));
    draw(first, last, sight);
  }
}

}  // namespace whittle
