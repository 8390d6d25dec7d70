// Which neighbouring pixels see different things, in vector lanes; every instruction set finds the
// same. edge_mask() is what others use.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "image/pixel_rays.h"
#include "trace/frame.h"

namespace whittle {

/// The numbers of a row's pixels that are compared with their neighbours', one array a number.
/// Pixel x stands at kBefore + x; there is room for lanes on either side.
class EdgeRow {
 public:
  static constexpr size_t kBefore = 1;
  enum Column {
    kNormalX,
    kNormalY,
    kNormalZ,
    kDirectionX,
    kDirectionY,
    kDirectionZ,
    kPointX,
    kPointY,
    kPointZ,
    kStep,
    kColumns
  };

  explicit EdgeRow(size_t width) : ids(width + kMargin) {
    for (std::vector<float>& column : columns) column.resize(width + kMargin);
  }

  std::vector<uint32_t> ids;
  std::array<std::vector<float>, kColumns> columns;

 private:
  static constexpr size_t kMargin = kBefore + kMostFloatLanes + 1;
};

/// Fills in row y.
void look_at_row(const PixelRays& rays, std::span<const Hit> hits, int y, EdgeRow& row);

/// Neighbours that stand after a pixel, and the bit of each.
enum LaterNeighbour : uint8_t { kRight = 1, kBelowLeft = 2, kBelow = 4, kBelowRight = 8 };

/// For each pixel of a row, as many as `bits`, which of its later neighbours differ from it; those
/// do whose normals have a lesser cosine, and others (edge_pixels.h).
/// Neighbours beyond the row's ends do not; `below` is null for the last row.
void find_differences(const EdgeRow& here, const EdgeRow* below, float least_cosine,
                      std::span<uint8_t> bits);

}  // namespace whittle
