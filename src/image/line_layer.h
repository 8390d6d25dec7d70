// Antialiased lines among what a picture shows.
#pragma once

#include <span>
#include <vector>

#include "image/ink.h"
#include "image/projected_line.h"
#include "trace/camera.h"

namespace whittle {

/// Lines between points of the world, about a pixel wide. Each pixel is under the strongest of the
/// lines that are seen there; of equally strong ones, under the first.
class LineLayer {
 public:
  /// `occluders`: the distance that each pixel of the camera shows, infinity for none; both must
  /// outlive this.
  LineLayer(const Camera& camera, std::span<const double> occluders);

  /// Of no length: a dot.
  void draw(Vec3 from, Vec3 to, const Ink& ink);

  std::span<const Ink> inks() const { return inks_; }

 private:
  void draw_projected(const ProjectedLine& line, const Ink& ink);
  void touch(int x, int y, Vec3 projected, double covered, const Ink& ink);

  const Camera& camera_;
  std::span<const double> occluders_;
  double units_;
  std::vector<Ink> inks_;
};

}  // namespace whittle
