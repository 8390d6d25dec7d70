#include "viewer/triangles.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace whittle {
namespace {

/// Corners are rounded to 1/256 of a pixel, so that edges are exact.
constexpr int kFraction = 256;
/// Beyond it products of coordinates would not fit into 64 bits.
constexpr float kFarthest = 1e5f;

struct Point {
  int64_t x = 0, y = 0;
};

/// How far to the left of an edge, seen along it, a point is: in units of its length.
int64_t side(const Point& a, const Point& b, const Point& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// Whether the points on an edge are the triangle's: those of upper and left edges are.
bool owns(const Point& a, const Point& b) {
  return a.y == b.y ? b.x > a.x : b.y < a.y;
}

std::array<float, 4> channels(uint32_t color) {
  return {float(color & 0xff), float(color >> 8 & 0xff), float(color >> 16 & 0xff),
          float(color >> 24)};
}

uint8_t texel(const Texture& texture, float u, float v) {
  const int x = std::clamp(int(u * float(texture.width)), 0, texture.width - 1),
            y = std::clamp(int(v * float(texture.height)), 0, texture.height - 1);
  return texture.at[size_t(y) * size_t(texture.width) + size_t(x)];
}

/// `alpha` 0 to 255.
uint32_t blended(uint32_t below, const std::array<float, 4>& color, float alpha) {
  const float share = alpha / 255;
  const auto mix = [&](int shift, float over) {
    const float under = float(below >> shift & 0xff);
    return uint32_t(under + (over - under) * share + 0.5f) << shift;
  };
  return mix(16, color[0]) | mix(8, color[1]) | mix(0, color[2]);
}

bool is_drawable(const Vertex& v) {
  return std::fabs(v.x) <= kFarthest && std::fabs(v.y) <= kFarthest && std::isfinite(v.u) &&
         std::isfinite(v.v);
}

Point point_of(const Vertex& v) {
  return {std::lround(v.x * kFraction), std::lround(v.y * kFraction)};
}

/// Before the first pixel whose centre is at a place or beyond it.
int first_centre(int64_t at) {
  const int64_t shifted = at - kFraction / 2;
  return int(shifted >= 0 ? (shifted + kFraction - 1) / kFraction : -(-shifted / kFraction));
}

class Triangle {
 public:
  Triangle(const Vertex& a, const Vertex& b, const Vertex& c, const Texture& texture)
      : corners_{&a, &b, &c}, texture_(texture) {
    for (size_t i = 0; i < 3; ++i) points_[i] = point_of(*corners_[i]);
    area_ = side(points_[0], points_[1], points_[2]);
    if (area_ < 0) {
      std::swap(corners_[1], corners_[2]);
      std::swap(points_[1], points_[2]);
      area_ = -area_;
    }
    is_flat_ = a.color == b.color && a.color == c.color;
    is_plain_ = a.u == b.u && a.u == c.u && a.v == b.v && a.v == c.v;
  }

  void draw(const Pixels& pixels, const ClipRect& clip) const {
    if (area_ == 0) return;
    const auto [left, right] = std::minmax({points_[0].x, points_[1].x, points_[2].x});
    const auto [top, bottom] = std::minmax({points_[0].y, points_[1].y, points_[2].y});
    const int x0 = std::max(clip.left, first_centre(left)),
              x1 = std::min(clip.right, first_centre(right) + 1),
              y0 = std::max(clip.top, first_centre(top)),
              y1 = std::min(clip.bottom, first_centre(bottom) + 1);
    for (int y = y0; y < y1; ++y) draw_row(pixels, y, x0, x1);
  }

 private:
  void draw_row(const Pixels& pixels, int y, int x0, int x1) const {
    if (x0 >= x1) return;
    // By edges 12, 20 and 01: the weights of corners 0, 1 and 2.
    const Point at{int64_t(x0) * kFraction + kFraction / 2, int64_t(y) * kFraction + kFraction / 2};
    std::array<int64_t, 3> inside, step;
    for (size_t i = 0; i < 3; ++i) {
      const Point &a = points_[(i + 1) % 3], &b = points_[(i + 2) % 3];
      inside[i] = side(a, b, at) - (owns(a, b) ? 0 : 1);
      step[i] = -(b.y - a.y) * kFraction;
      // Where the row is inside of this edge.
      if (step[i] == 0) {
        if (inside[i] < 0) return;
        continue;
      }
      if (step[i] > 0 && inside[i] < 0)
        x0 = int(std::max<int64_t>(x0, first_x(at, -inside[i], step[i])));
      if (step[i] < 0) {
        if (inside[i] < 0) return;
        x1 = int(std::min<int64_t>(x1, at.x / kFraction + inside[i] / -step[i] + 1));
      }
    }
    uint32_t* const row = pixels.at + ptrdiff_t(y) * pixels.stride;
    const double scale = 1 / double(area_);
    const int begin = int((at.x - kFraction / 2) / kFraction);
    for (int x = x0; x < x1; ++x) {
      std::array<float, 3> weights;
      for (size_t i = 0; i < 3; ++i)
        weights[i] = float(double(inside[i] + step[i] * (x - begin)) * scale);
      put(row[x], weights);
    }
  }

  static int64_t first_x(const Point& at, int64_t missing, int64_t step) {
    return (at.x - kFraction / 2) / kFraction + (missing + step - 1) / step;
  }

  void put(uint32_t& pixel, const std::array<float, 3>& weights) const {
    std::array<float, 4> color = channels(corners_[0]->color);
    if (!is_flat_) {
      const std::array<float, 4> second = channels(corners_[1]->color),
                                 third = channels(corners_[2]->color);
      for (size_t c = 0; c < 4; ++c)
        color[c] = color[c] * weights[0] + second[c] * weights[1] + third[c] * weights[2];
    }
    float u = corners_[0]->u, v = corners_[0]->v;
    if (!is_plain_) {
      u = u * weights[0] + corners_[1]->u * weights[1] + corners_[2]->u * weights[2];
      v = v * weights[0] + corners_[1]->v * weights[1] + corners_[2]->v * weights[2];
    }
    const float alpha = color[3] * float(texel(texture_, u, v)) / 255;
    if (alpha > 0) pixel = blended(pixel, color, std::min(alpha, 255.0f));
  }

  std::array<const Vertex*, 3> corners_;
  std::array<Point, 3> points_;
  const Texture& texture_;
  int64_t area_ = 0;
  bool is_flat_ = false;   ///< of one colour
  bool is_plain_ = false;  ///< of one texel
};

}  // namespace

void draw_triangles(const Pixels& pixels, const ClipRect& clip, std::span<const Vertex> vertices,
                    std::span<const uint16_t> indices, const Texture& texture) {
  const ClipRect inside{std::max(clip.left, 0), std::max(clip.top, 0),
                        std::min(clip.right, pixels.width), std::min(clip.bottom, pixels.height)};
  if (inside.left >= inside.right || inside.top >= inside.bottom) return;
  for (size_t i = 0; i + 2 < indices.size(); i += 3) {
    const Vertex &a = vertices[indices[i]], &b = vertices[indices[i + 1]],
                 &c = vertices[indices[i + 2]];
    if (is_drawable(a) && is_drawable(b) && is_drawable(c))
      Triangle(a, b, c, texture).draw(pixels, inside);
  }
}

}  // namespace whittle
