// The camera in somebody's hand: how drags, the wheel and keys move it. Pure functions; a view is
// in OpenSCAD's words, so that every one of them is a --camera.
#pragma once

#include "trace/view.h"

namespace whittle {

struct OrbitView {
  Vec3 target;
  Vec3 rotation_degrees = kDefaultRotationDegrees;
  double distance = kDefaultDistance;
  double fov_degrees = kDefaultFovDegrees;
  bool orthographic = false;

  bool operator==(const OrbitView&) const = default;
};

struct PictureSize {
  int width = 512, height = 512;  ///< pixels, positive

  bool operator==(const PictureSize&) const = default;
};

ViewOptions view_options(const OrbitView& view, PictureSize size);
/// Framing the solid as the view is turned; `tight` as in ViewOptions.
ViewOptions framing_options(const OrbitView& view, PictureSize size, bool tight);
OrbitView orbit_view(const GimbalView& view, bool orthographic);
Camera camera_of(const OrbitView& view, PictureSize size);

/// The view in numbers that are short to write: angles to 1/100 degree, the distance to six digits,
/// the target to the place of the distance's sixth. Less than a hundredth of a pixel away.
OrbitView rounded(const OrbitView& view);

/// Turned by a drag of so many pixels, as OpenSCAD does it: 0.7 degrees a pixel, about the target.
OrbitView orbited(OrbitView view, double right, double down);
/// Turned by degrees about the model's z axis, and towards its top.
OrbitView turned(OrbitView view, double about_z, double to_top);
/// Moved so that what is `depth` away along the viewing axis follows a drag of so many pixels.
OrbitView panned(OrbitView view, PictureSize size, double right, double down, double depth);
/// The distance times `factor`, while the point stays where it is in the picture. Distances stay
/// within 1e-9 and 1e12.
OrbitView zoomed(OrbitView view, double factor, Vec3 about);
/// Turned about that point from now on; it moves to the middle of the picture.
OrbitView pivoted(OrbitView view, Vec3 point);
/// Turned to OpenSCAD's angles.
OrbitView rotated_to(OrbitView view, Vec3 rotation_degrees);

/// The factor of that many notches of the wheel away from the hand: 0.9 each.
double wheel_factor(double notches);
/// Where the ray through a position in the picture, pixels, meets the plane through the target that
/// is square to the viewing axis.
Vec3 point_on_target_plane(const OrbitView& view, PictureSize size, double x, double y);

}  // namespace whittle
