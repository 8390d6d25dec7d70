#include "image/draw_outlines.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/result.h"
#include "image/ink.h"
#include "image/projected_line.h"

namespace whittle {
namespace {

constexpr double kHalfWidth = 1;  ///< pixels
/// Ends of lines lie on this part of a pixel, as Mesa's and most other rasterisers have them.
constexpr double kSubpixels = 256;

double snapped(double v) {
  return std::round(v * kSubpixels) / kSubpixels;
}

class OutlineLayer {
 public:
  OutlineLayer(const Camera& camera, Rgb8 color, int samples)
      : size_{camera.width, camera.height},
        color_(to_unit(color)),
        samples_(samples),
        inks_(size_t(camera.width) * size_t(camera.height)) {}

  void draw(const ProjectedLine& line) {
    const double from[2] = {snapped(line.from.x) * samples_, snapped(line.from.y) * samples_};
    const double to[2] = {snapped(line.to.x) * samples_, snapped(line.to.y) * samples_};
    const double way[2] = {to[0] - from[0], to[1] - from[1]};
    const int major = std::fabs(way[0]) >= std::fabs(way[1]) ? 0 : 1, minor = 1 - major;
    if (way[major] == 0) return;
    const bool rises = way[major] > 0;
    const double slope = way[minor] / way[major];
    const int start = first_column(from[major], from[minor], rises);
    const int stop = first_column(to[major], to[minor], rises);
    const int begin = std::max(std::min(start, stop), 0);
    const int end = std::min(std::max(start, stop), size_[major] * samples_);
    const double half = kHalfWidth * samples_;
    for (int sample = begin; sample < end;) {
      const int column = sample / samples_;
      covered_.clear();
      for (; sample < end && sample / samples_ == column; ++sample) {
        const double middle = from[minor] + slope * (sample + 0.5 - from[major]);
        covered_.push_back({std::max(first_sample(middle - half), 0),
                            std::min(first_sample(middle + half), size_[minor] * samples_)});
      }
      draw_column(column, major == 0);
    }
  }

  std::span<const Ink> inks() const { return inks_; }

 private:
  /// Samples from `first` to before `last`, from the edge of the picture.
  struct Range {
    int first, last;
  };

  /// The first sample whose middle is not before v.
  static int first_sample(double v) { return int(std::ceil(v - 0.5)); }

  /// The first column of samples that is behind an end of a line. A column that a line begins or
  /// ends in, without its middle: it begins there if the end is in the diamond about a sample, and
  /// goes on to there if it is not.
  static int first_column(double along, double across, bool rises) {
    const double column = std::floor(along), row = std::floor(across);
    if (std::fabs(along - column - 0.5) + std::fabs(across - row - 0.5) < 0.5)
      return int(column) + (rises ? 0 : 1);
    return first_sample(along);
  }

  /// A column of pixels, or a row, of whose samples these are covered.
  void draw_column(int column, bool is_column) {
    Range all{size_[is_column ? 1 : 0] * samples_, 0};
    for (const Range& range : covered_) {
      all = {std::min(all.first, range.first), std::max(all.last, range.last)};
    }
    for (int row = all.first / samples_; row * samples_ < all.last; ++row) {
      int count = 0;
      for (const Range& range : covered_) {
        count += std::max(
            0, std::min(range.last, (row + 1) * samples_) - std::max(range.first, row * samples_));
      }
      if (count == 0) continue;
      Ink& ink = inks_[is_column ? index(column, row) : index(row, column)];
      ink.color = color_;
      // Lines that meet share the samples of a pixel.
      ink.strength = std::min(ink.strength + float(count) / float(samples_ * samples_), 1.0f);
    }
  }

  size_t index(int x, int y) const { return size_t(y) * size_t(size_[0]) + size_t(x); }

  const int size_[2];
  const Vec3f color_;
  const int samples_;  ///< a side of a pixel
  std::vector<Ink> inks_;
  std::vector<Range> covered_;  ///< scratch space: one of each column of samples
};

}  // namespace

void draw_outlines(const Drawing& drawing, const Camera& camera, Rgb8 color, int antialias,
                   Picture& picture) {
  WHITTLE_CHECK(picture.width == camera.width && picture.height == camera.height);
  const auto in_space = [](Vec2 p) { return Vec3{p.x, p.y, 0}; };
  OutlineLayer lines(camera, color, antialias);
  for (const std::vector<Vec2>& outline : drawing.outlines) {
    for (size_t i = 0; i < outline.size(); ++i) {
      const Vec3 to = in_space(outline[(i + 1) % outline.size()]);
      if (const std::optional<ProjectedLine> line = project_line(camera, in_space(outline[i]), to))
        lines.draw(*line);
    }
  }
  lay_over(lines.inks(), picture);
}

}  // namespace whittle
