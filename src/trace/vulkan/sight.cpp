#include "trace/vulkan/sight.h"

#include <algorithm>
#include <cmath>

namespace whittle {
namespace {

/// A corner so many widths of the tile beside its middle would be placed badly by a rasteriser.
constexpr double kMostBeside = 16;
/// Corners that are not this share of their distance ahead of the eye, too.
constexpr double kLeastAhead = 1e-3;

}  // namespace

Sight::Sight(const Camera& camera, Vec3 eye, Vec3 origin, const PixelRect& tile, double margin)
    : camera_(camera),
      eye_(eye),
      origin_(origin),
      tile_(tile),
      grow_(margin * camera.units_per_pixel()) {
  const double s = camera.units_per_pixel();
  lo_x_ = (tile.x0 - margin - 0.5 * camera.width) * s;
  hi_x_ = (tile.x1 + margin - 0.5 * camera.width) * s;
  lo_y_ = (0.5 * camera.height - tile.y1 - margin) * s;
  hi_y_ = (0.5 * camera.height - tile.y0 + margin) * s;
}

BoxSight Sight::look(Box box) const {
  // As large as it is drawn: that may reach to the eye where the box itself does not.
  box = {box.lo - eye_, box.hi - eye_};
  const double grow = grow_ * (camera_.orthographic ? 1 : length(max(abs(box.lo), abs(box.hi))));
  box = {box.lo - Vec3{grow, grow, grow}, box.hi + Vec3{grow, grow, grow}};
  // Bits: all corners left of, right of, below, above, and behind what is seen.
  unsigned beside = 31;
  bool wide = false;
  for (int i = 0; i < 8; ++i) {
    const Vec3 p = box.corner(i);
    const double ahead = camera_.orthographic ? 1 : dot(p, camera_.forward);
    const double x = dot(p, camera_.right), y = dot(p, camera_.up);
    beside &= unsigned(x < lo_x_ * ahead) | unsigned(x > hi_x_ * ahead) << 1 |
              unsigned(y < lo_y_ * ahead) << 2 | unsigned(y > hi_y_ * ahead) << 3 |
              unsigned(ahead < 0) << 4;
    wide = wide || is_far(x, ahead, lo_x_, hi_x_) || is_far(y, ahead, lo_y_, hi_y_) ||
           (!camera_.orthographic && !(ahead > kLeastAhead * length(p)));
  }
  return beside != 0 ? BoxSight::kNone : wide ? BoxSight::kWide : BoxSight::kSome;
}

PixelRect Sight::pixels(const Box& box) const {
  PixelRect all = pixels_covering(camera_, {box.lo + origin_, box.hi + origin_});
  all = {std::max(all.x0, tile_.x0) - tile_.x0, std::max(all.y0, tile_.y0) - tile_.y0,
         std::min(all.x1, tile_.x1) - tile_.x0, std::min(all.y1, tile_.y1) - tile_.y0};
  return all;
}

bool Sight::is_far(double x, double ahead, double lo, double hi) {
  return !(std::fabs(x - 0.5 * (lo + hi) * ahead) < kMostBeside * (hi - lo) * ahead);
}

SolvedPixels::SolvedPixels(std::span<const uint32_t> seen, int width, int height)
    : columns_((width + kBlock - 1) / kBlock),
      rows_((height + kBlock - 1) / kBlock),
      unsolved_(size_t(columns_ + 1) * size_t(rows_ + 1)) {
  std::vector<uint32_t> open(size_t(columns_) * size_t(rows_));
  for (int y = 0; y < height; ++y) {
    const uint32_t* const row = &seen[size_t(y) * size_t(width)];
    uint32_t* const to = &open[size_t(y / kBlock) * size_t(columns_)];
    for (int block = 0; block < columns_; ++block) {
      const int end = std::min((block + 1) * kBlock, width);
      for (int x = block * kBlock; x < end; ++x) to[block] |= uint32_t(row[x] == 0);
    }
  }
  const auto stride = size_t(columns_ + 1);
  for (size_t y = 0; y < size_t(rows_); ++y) {
    uint32_t in_row = 0;
    for (size_t x = 0; x < size_t(columns_); ++x) {
      in_row += open[y * size_t(columns_) + x];
      unsolved_[(y + 1) * stride + x + 1] = unsolved_[y * stride + x + 1] + in_row;
    }
  }
}

bool SolvedPixels::holds(const PixelRect& pixels) const {
  if (pixels.width() <= 0 || pixels.height() <= 0) return true;
  const auto corner = [&](int x, int y) {
    return unsolved_[size_t(y) * size_t(columns_ + 1) + size_t(x)];
  };
  const int x0 = pixels.x0 / kBlock, y0 = pixels.y0 / kBlock;
  const int x1 = (pixels.x1 + kBlock - 1) / kBlock, y1 = (pixels.y1 + kBlock - 1) / kBlock;
  return corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0) == 0;
}

}  // namespace whittle
