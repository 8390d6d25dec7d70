// Where points of space are in a line drawing.
#pragma once

#include <optional>

#include "trace/camera.h"

namespace whittle {

/// A straight line of the drawing, and the line in space that it shows. x runs to the right and y
/// down, as in pictures.
struct DrawnLine {
  Vec2 a, b;
  Vec3 from, to;                ///< in space
  double key_a = 0, key_b = 0;  ///< what is linear along the line: 1 / depth in perspective, else
                                ///< the depth
  uint32_t edge = 0;            ///< whose line it is

  Vec2 at(double s) const { return a + (b - a) * s; }
  double key(double s) const { return key_a + (key_b - key_a) * s; }
};

/// How far a line may be drawn from where it belongs, in units of the drawing: a fortieth of a
/// millimetre, and of a picture a tenth of a pixel, which is as much where 96 pixels are an inch.
inline constexpr double kFinenessToScale = 0.025, kFinenessOfPicture = 0.1;

class ViewProjection {
 public:
  /// A perspective camera's drawing is its picture, in pixels. An orthographic one's is to scale:
  /// `scale` units of the drawing are one of the model, the camera's eye is at (0, 0), and there is
  /// no frame. `size`: about the model's, for what is nearest to the eye.
  ViewProjection(const Camera& camera, double scale, double size)
      : camera_(camera), scale_(scale), nearest_(1e-6 * size) {}

  bool is_to_scale() const { return camera_.orthographic; }
  double fineness() const { return is_to_scale() ? kFinenessToScale : kFinenessOfPicture; }

  /// The part of a line that is before the eye and, in perspective, in the frame or a little
  /// beside it.
  std::optional<DrawnLine> draw(Vec3 from, Vec3 to) const;

  /// The point of space that a drawn line shows at 0 <= s <= 1.
  Vec3 point(const DrawnLine& line, double s) const;

  /// Whether the first of two keys is that of a point nearer to the eye, by more than rounding.
  bool is_before(double key, double other) const;

  /// Units of the drawing in one of the model, about a point or as near to the eye as `depth`.
  double units_at(double depth) const;
  double depth(Vec3 point) const { return dot(point - camera_.eye, camera_.forward); }

  /// The cosine of the angle at which a surface with this unit normal looks at the eye.
  double facing(Vec3 normal, Vec3 point) const;

  /// The eye's ray to a point, and how far it is along it. An orthographic one starts before all.
  Ray ray_to(Vec3 point, double& distance) const;
  /// The ray through a place of the drawing.
  Ray ray_at(Vec2 place) const;

 private:
  Vec2 place(Vec3 point, double depth) const;

  Camera camera_;
  double scale_, nearest_;
};

}  // namespace whittle
