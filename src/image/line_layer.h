// Antialiased lines among what a picture shows.
#pragma once

#include <span>
#include <vector>

#include "image/ink.h"
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
  Vec3 to_eye(Vec3 world) const;
  bool clip(Vec3& a, Vec3& b) const;
  Vec3 project(Vec3 p) const;
  void draw_clipped(Vec3 a, Vec3 b, const Ink& ink);
  void touch(int x, int y, Vec3 projected, double covered, const Ink& ink);

  const Camera& camera_;
  std::span<const double> occluders_;
  double units_;
  std::vector<Ink> inks_;
};

}  // namespace whittle
