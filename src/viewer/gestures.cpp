#include "viewer/gestures.h"

#include <cmath>

namespace whittle {
namespace {

/// A hand that clicks moves by no more than this, screen pixels.
constexpr double kSlack = 3;
constexpr double kDoubleClickSeconds = 0.4;

}  // namespace

void Gestures::press(MouseButton button, bool shift, double x, double y) {
  if (pressed_) return;
  pressed_ = button;
  pans_ = shift || button != MouseButton::kLeft;
  is_dragging_ = false;
  from_x_ = x_ = x, from_y_ = y_ = y;
}

std::optional<OrbitView> Gestures::move(double x, double y, const OrbitView& view, PictureSize size,
                                        const PointAt& point_at) {
  if (!pressed_) return std::nullopt;
  if (!is_dragging_) {
    if (std::hypot(x - from_x_, y - from_y_) <= kSlack * scale_) return std::nullopt;
    is_dragging_ = true;
    const Camera camera = camera_of(view, size);
    const std::optional<Vec3> grabbed = point_at(from_x_, from_y_);
    depth_ = grabbed ? dot(*grabbed - camera.eye, camera.forward) : view.distance;
  }
  const double right = x - x_, down = y - y_;
  x_ = x, y_ = y;
  if (right == 0 && down == 0) return std::nullopt;
  return pans_ ? panned(view, size, right, down, depth_)
               : orbited(view, right / scale_, down / scale_);
}

std::optional<Click> Gestures::release(MouseButton button, double x, double y, double seconds) {
  if (pressed_ != button) return std::nullopt;
  pressed_.reset();
  const bool was_drag = is_dragging_;
  is_dragging_ = false;
  if (was_drag || button != MouseButton::kLeft || pans_) return std::nullopt;
  Click click{x, y, false};
  click.is_double = last_click_ && seconds - last_seconds_ <= kDoubleClickSeconds &&
                    std::hypot(x - last_click_->x, y - last_click_->y) <= kSlack * scale_;
  // A third one begins anew.
  last_click_ = click.is_double ? std::nullopt : std::optional(click);
  last_seconds_ = seconds;
  return click;
}

OrbitView Gestures::wheel(double notches, double x, double y, const OrbitView& view,
                          PictureSize size, const PointAt& point_at) {
  const std::optional<Vec3> seen = point_at(x, y);
  return zoomed(view, wheel_factor(notches),
                seen ? *seen : point_on_target_plane(view, size, x, y));
}

}  // namespace whittle
