// Every side covers what is to its right, up to the frame's edge: sides that go down cover it once,
// those that go up take it away. A row holds differences between neighbours, so that a side changes
// only the pixels that it crosses; sums along the row are what is covered.
#include "slice/pixel_coverage.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace whittle {
namespace {

/// A side in pixels, y pointing down.
struct Side {
  double x0, y0, x1, y1;  ///< y0 < y1
  double sign;            ///< 1 where what is to its right is inside

  double x_at(double y) const { return x0 + (y - y0) / (y1 - y0) * (x1 - x0); }
};

std::vector<Side> sides_of(std::span<const Contour> loops, const PixelFrame& frame) {
  std::vector<Side> sides;
  for (const Contour& loop : loops) {
    for (size_t i = 0; i < loop.size(); ++i) {
      const Vec2 a = loop[i], b = loop[i + 1 < loop.size() ? i + 1 : 0];
      Side side{(a.x - frame.corner.x) / frame.pixel, (frame.corner.y - a.y) / frame.pixel,
                (b.x - frame.corner.x) / frame.pixel, (frame.corner.y - b.y) / frame.pixel, 1};
      if (side.y0 > side.y1) {
        std::swap(side.x0, side.x1);
        std::swap(side.y0, side.y1);
        side.sign = -1;
      }
      const bool is_seen = side.y0 < side.y1 && side.y1 > 0 && side.y0 < frame.height;
      if (is_seen && is_finite(Vec2{side.x0, side.y0}) && is_finite(Vec2{side.x1, side.y1}))
        sides.push_back(side);
    }
  }
  std::ranges::sort(sides, {}, &Side::y0);
  return sides;
}

/// The differences of one row of pixels.
class Row {
 public:
  explicit Row(int width) : width_(width), differences_(size_t(width) + 1) {}

  /// A straight piece within the row from x0 to x1, `height` of it (negative: it takes away).
  void add(double x0, double x1, double height) {
    if (x0 > x1) std::swap(x0, x1);
    if (x1 <= 0) {
      differences_[0] += height;
      return;
    }
    if (x0 >= width_) return;
    if (x0 == x1) {
      add_in_pixel(std::floor(x0), x0, x1, height);
      return;
    }
    const double slope = height / (x1 - x0);
    if (x0 < 0) {
      differences_[0] += slope * -x0;
      x0 = 0;
    }
    const double end = std::min(x1, double(width_));
    for (double pixel = std::floor(x0), at = x0; at < end; ++pixel) {
      const double next = std::min(pixel + 1, end);
      add_in_pixel(pixel, at, next, slope * (next - at));
      at = next;
    }
  }

  /// The sums; then nothing is in the row again.
  std::span<const double> take() {
    double sum = 0;
    for (double& value : differences_) {
      sum += value;
      value = std::clamp(sum, 0.0, 1.0);
    }
    return {differences_.data(), size_t(width_)};
  }
  void clear() { std::ranges::fill(differences_, 0.0); }

 private:
  void add_in_pixel(double pixel, double x0, double x1, double height) {
    const double left = (x0 + x1) / 2 - pixel;  // mean share of the pixel on the left of the piece
    const auto i = size_t(pixel);
    differences_[i] += height * (1 - left);
    differences_[i + 1] += height * left;
  }

  int width_;
  std::vector<double> differences_;
};

}  // namespace

PixelFrame frame_around(const Rect& box, int width, int height, double pixel) {
  const Vec2 size = box.hi - box.lo;
  if (pixel == 0) pixel = std::max(size.x / width, size.y / height);
  if (!(pixel > 0)) pixel = 1;
  const Vec2 middle = box.lo + size * 0.5;
  return {width, height, {middle.x - pixel * width / 2, middle.y + pixel * height / 2}, pixel};
}

void cover_pixels(std::span<const Contour> loops, const PixelFrame& frame,
                  const CoverageRow& take) {
  const std::vector<Side> sides = sides_of(loops, frame);
  if (sides.empty()) return;
  Row row(frame.width);
  std::vector<const Side*> open;
  size_t next = 0;
  for (int y = int(std::max(0.0, std::floor(sides[0].y0))); y < frame.height; ++y) {
    while (next < sides.size() && sides[next].y0 < y + 1) open.push_back(&sides[next++]);
    std::erase_if(open, [y](const Side* side) { return side->y1 <= y; });
    if (open.empty()) {
      if (next == sides.size()) return;
      continue;
    }
    for (const Side* side : open) {
      const double top = std::max(side->y0, double(y)), bottom = std::min(side->y1, y + 1.0);
      row.add(side->x_at(top), side->x_at(bottom), side->sign * (bottom - top));
    }
    take(y, row.take());
    row.clear();
  }
}

}  // namespace whittle
