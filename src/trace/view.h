// From what a user says about the view to a Camera.
//
// The rules are those of OpenSCAD's Camera.cc and openscad.cc (2021.01), re-described and checked
// against its pictures: two forms of --camera, view-all, auto-centre, and the file's $vp*
// variables. Where the solid is framed there are two: OpenSCAD's, by a ball around the box; and a
// tight one, by the solid itself.
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "base/box.h"
#include "base/result.h"
#include "model/model.h"
#include "trace/camera.h"
#include "trace/named_view.h"

namespace whittle {

/// OpenSCAD's view when nobody says anything: $vpr, $vpd and $vpf of a new document.
inline constexpr Vec3 kDefaultRotationDegrees{55, 0, 25};
inline constexpr double kDefaultDistance = 140;
inline constexpr double kDefaultFovDegrees = 22.5;
/// How far behind the eye's plane orthographic rays start, in eye-to-target distances.
inline constexpr double kOrthographicReach = 100;
/// A solid that is framed tightly fills this share of the side of the picture that it fills most.
inline constexpr double kTightFill = 0.85;

/// What the command line says about the view. If any of target, rotation_degrees, distance, eye and
/// center is set, a camera was given: the file's $vp* do not count, and what is missing has
/// OpenSCAD's defaults. eye and center win over the other three. A named view is a camera, too; it
/// frames the solid, and nothing else may be said beside it.
struct ViewOptions {
  std::optional<NamedView> named{};
  std::optional<Vec3> target;            ///< the point looked at
  std::optional<Vec3> rotation_degrees;  ///< OpenSCAD's Euler angles; (0, 0, 0) looks straight down
  std::optional<double> distance;        ///< from eye to target, model units
  std::optional<Vec3> eye, center;       ///< the vector form: from eye to center, +z up
  bool view_all = false;                 ///< choose the distance so that the box fits
  bool auto_center = false;              ///< with view_all: look at the middle of the box
  bool tight = false;                    ///< what fits is the solid, not a ball around it
  bool orthographic = false;
  std::optional<double> fov_degrees;  ///< vertical, in (0, 180); unset: $vpf, else 22.5
  int width = 512, height = 512;      ///< pixels, positive
};

/// Whether a camera is given: a name, or any of target, rotation_degrees, distance, eye and center.
bool gives_camera(const ViewOptions& options);

/// A kUsage error for a negative distance, unless view-all replaces it; and for a named view beside
/// another camera.
Status check_view(const ViewOptions& options);

/// Whether make_camera would look at `framed_box`: view-all is asked for, or nothing is said about
/// the view.
bool frames_the_solid(const ViewOptions& options, const FileView& file);

/// Whether it then also looks at the middle of the box.
bool centers_the_solid(const ViewOptions& options, const FileView& file);

/// A view in OpenSCAD's words: what $vpt, $vpr, $vpd and $vpf would be.
struct GimbalView {
  Vec3 target, rotation_degrees;
  double distance = 0, fov_degrees = 0;
};

/// How far something reaches along four directions: its largest direction . p, of any length.
using Directions = std::array<Vec3, 4>;
using Reach = std::function<std::array<double, 4>(const Directions&)>;
/// How far a box does.
std::array<double, 4> box_reach(const Box& box, const Directions& directions);

struct FramedView {
  Camera camera;
  GimbalView view;
};

/// The camera that OpenSCAD would use, and the same in its words. `framed_box` is what view-all
/// fits. Without a camera and without $vp* in the file, view-all and auto-centre are both on; $vp*
/// without a camera turn both off, even if asked for. An empty or infinite box is not fitted: the
/// distance and the target stay.
///
/// With `tight` view-all fits what `reach` tells of: as seen it fills kTightFill of the picture's
/// width or height, and no more of the other. With auto-centre it is in the middle; without, the
/// eye stays on the line through the target.
FramedView frame_view(const ViewOptions& options, const FileView& file, const Box& framed_box,
                      const Reach& reach);

/// The camera alone, where the box is what is fitted.
Camera make_camera(const ViewOptions& options, const FileView& file, const Box& framed_box);

}  // namespace whittle
