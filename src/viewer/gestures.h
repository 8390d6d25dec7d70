// What a hand with a mouse does to a view.
#pragma once

#include <functional>
#include <optional>

#include "viewer/orbit_view.h"

namespace whittle {

/// The point of the solid that is seen at a position of the picture; none if nothing is.
using PointAt = std::function<std::optional<Vec3>(double x, double y)>;

enum class MouseButton { kLeft, kRight, kMiddle };

struct Click {
  double x = 0, y = 0;  ///< pixels
  bool is_double = false;
};

/// Positions are in pixels of the picture, times in seconds.
class Gestures {
 public:
  /// Pixels of the picture for one of a screen without many of them.
  explicit Gestures(double scale) : scale_(scale) {}

  void press(MouseButton button, bool shift, double x, double y);
  /// The view after the mouse came to that place; none if it does not drag anything. What is moved
  /// follows the mouse: the point under it when it was pressed.
  std::optional<OrbitView> move(double x, double y, const OrbitView& view, PictureSize size,
                                const PointAt& point_at);
  /// The click that ends here, if it is one.
  std::optional<Click> release(MouseButton button, double x, double y, double seconds);
  /// The view after so many notches away from the hand: closer to what is under the mouse.
  static OrbitView wheel(double notches, double x, double y, const OrbitView& view,
                         PictureSize size, const PointAt& point_at);

  bool is_dragging() const { return is_dragging_; }

 private:
  double scale_;
  std::optional<MouseButton> pressed_;
  bool pans_ = false;
  bool is_dragging_ = false;        ///< far enough away from where it was pressed
  double from_x_ = 0, from_y_ = 0;  ///< where it was pressed
  double x_ = 0, y_ = 0;            ///< where it was last
  double depth_ = 0;                ///< of what is moved, along the viewing axis
  std::optional<Click> last_click_;
  double last_seconds_ = 0;
};

}  // namespace whittle
