#include "trace/view.h"

#include <algorithm>
#include <cmath>

#include "base/degrees.h"

namespace whittle {
namespace {

/// Where the eye stands, and the three axes of the picture.
struct Pose {
  Vec3 right, up, forward;
  Vec3 target;
  double distance = 0;
};

/// The axes of OpenSCAD's Rx(90 - rx) Ry(-ry) Rz(-rz), which look along +y with z up: the rows of
/// that matrix are right, forward and up.
Pose gimbal_pose(Vec3 rotation_degrees, Vec3 target, double distance) {
  const double cx = sin_degrees(rotation_degrees.x), sx = cos_degrees(rotation_degrees.x);
  const double cy = cos_degrees(rotation_degrees.y), sy = -sin_degrees(rotation_degrees.y);
  const double cz = cos_degrees(rotation_degrees.z), sz = -sin_degrees(rotation_degrees.z);
  return {.right = {cy * cz, -cy * sz, sy},
          .up = {sx * sz - cx * sy * cz, sx * cz + cx * sy * sz, cx * cy},
          .forward = {cx * sz + sx * sy * cz, cx * cz - sx * sy * sz, -sx * cy},
          .target = target,
          .distance = distance};
}

/// The vector form. Looking straight down is rotation (0, 0, 0), straight up (180, 0, 180).
Pose vector_pose(Vec3 eye, Vec3 center) {
  Pose pose;
  pose.target = center;
  pose.distance = length(center - eye);
  pose.forward = pose.distance > 0 ? (center - eye) / pose.distance : Vec3{0, 0, -1};
  const double horizontal = std::hypot(pose.forward.x, pose.forward.y);
  if (horizontal > 0) {
    pose.right = Vec3{pose.forward.y, -pose.forward.x, 0} / horizontal;
  } else {
    pose.right = {pose.forward.z < 0 ? 1.0 : -1.0, 0, 0};
  }
  pose.up = cross(pose.right, pose.forward);
  return pose;
}

/// Whether a camera is given by numbers.
bool gives_numbers(const ViewOptions& options) {
  return options.eye || options.center || options.target || options.rotation_degrees ||
         options.distance;
}

bool gives_view(const FileView& file) {
  return file.target || file.rotation_degrees || file.distance || file.fov_degrees;
}

/// The vector form's angles, as OpenSCAD has them.
Vec3 gimbal_rotation(Vec3 forward) {
  const double degrees = 180 / std::acos(-1.0);
  const double horizontal = std::hypot(forward.x, forward.y);
  if (!(horizontal > 0)) return forward.z < 0 ? Vec3{0, 0, 0} : Vec3{180, 0, 180};
  return {std::atan2(horizontal, -forward.z) * degrees, 0,
          std::atan2(-forward.x, forward.y) * degrees};
}

double tangent_of(double degrees) {
  return std::tan(degrees * (std::acos(-1.0) / 180));
}

std::optional<Vec3> rotation_given(const ViewOptions& options) {
  return options.named ? rotation_of(*options.named) : options.rotation_degrees;
}

/// Moves the eye to where the solid fills the picture, without turning it.
///
/// The four planes through the eye that bound the part of the picture to be filled must each have
/// the solid on their inner side, and touch it. Where the planes are that touch it, `reach` says;
/// two that face one another meet in a line, and the eye stands on the one that is farther back.
void fit_tightly(const ViewOptions& options, double fov_degrees, const Box& box, bool centers,
                 const Reach& reach, Pose& pose) {
  const double aspect = double(options.width) / double(options.height);
  const double slope_y = kTightFill * tangent_of(fov_degrees / 2), slope_x = slope_y * aspect;
  const Vec3 right = pose.right, up = pose.up, forward = pose.forward;
  const double lean_x = options.orthographic ? 0 : slope_x;
  const double lean_y = options.orthographic ? 0 : slope_y;
  const auto [to_right, to_left, to_top, to_bottom] =
      reach({right - forward * lean_x, right * -1 - forward * lean_x, up - forward * lean_y,
             up * -1 - forward * lean_y});
  // In the eye's axes.
  const double x = centers ? (to_right - to_left) / 2 : dot(right, pose.target);
  const double y = centers ? (to_top - to_bottom) / 2 : dot(up, pose.target);
  const double back = std::max(std::max(to_right - x, to_left + x) / slope_x,
                               std::max(to_top - y, to_bottom + y) / slope_y);
  const double depth = dot(forward, centers ? box.center() : pose.target);
  const double distance = options.orthographic ? back : depth + back;
  if (!(distance > 0 && std::isfinite(distance))) return;
  pose.distance = distance;
  pose.target = right * x + up * y + forward * depth;
}

struct Framed {
  Pose pose;
  Vec3 rotation_degrees;
  double fov_degrees = 0;
};

Framed frame(const ViewOptions& options, const FileView& file, const Box& framed_box,
             const Reach& reach) {
  const bool vector_given = options.eye || options.center;
  const bool camera_given = gives_camera(options);
  const bool file_given = !camera_given && gives_view(file);
  const bool view_all = frames_the_solid(options, file);
  const bool auto_center = centers_the_solid(options, file);
  const FileView said = file_given ? file
                                   : FileView{.target = options.target,
                                              .rotation_degrees = rotation_given(options),
                                              .distance = options.distance,
                                              .fov_degrees = {}};

  Pose pose;
  if (vector_given) {
    const Vec3 center = options.center.value_or(Vec3{});
    pose = vector_pose(options.eye.value_or(center + Vec3{0, 0, kDefaultDistance}), center);
  } else {
    const double distance = said.distance.value_or(kDefaultDistance);
    pose = gimbal_pose(said.rotation_degrees.value_or(kDefaultRotationDegrees),
                       said.target.value_or(Vec3{}),
                       camera_given && distance < 0 ? kDefaultDistance : distance);
  }

  double fov = options.fov_degrees.value_or(said.fov_degrees.value_or(kDefaultFovDegrees));
  if (!(fov > 0 && fov < 180)) fov = kDefaultFovDegrees;
  const bool can_fit = view_all && !framed_box.is_empty() && framed_box.is_finite();
  if (can_fit && options.tight) {
    fit_tightly(options, fov, framed_box, auto_center, reach, pose);
  } else if (can_fit) {
    if (auto_center) pose.target = framed_box.center();
    const double radius = length(framed_box.center() - pose.target) + framed_box.diagonal() / 2;
    if (radius > 0) pose.distance = radius / sin_degrees(fov / 2);
  }
  const Vec3 rotation = vector_given ? gimbal_rotation(pose.forward)
                                     : said.rotation_degrees.value_or(kDefaultRotationDegrees);
  return {pose, rotation, fov};
}

}  // namespace

bool frames_the_solid(const ViewOptions& options, const FileView& file) {
  return gives_camera(options) ? options.view_all || options.named : !gives_view(file);
}

bool centers_the_solid(const ViewOptions& options, const FileView& file) {
  return gives_camera(options) ? options.auto_center || options.named : !gives_view(file);
}

bool gives_camera(const ViewOptions& options) {
  return options.named || gives_numbers(options);
}

Status check_view(const ViewOptions& options) {
  if (options.named && gives_numbers(options))
    return Error{ErrorKind::kUsage, "--from and --camera each say where the eye is; give one"};
  if (options.distance.value_or(0) >= 0 || options.view_all) return Done{};
  return Error{ErrorKind::kUsage,
               "Camera distance must not be negative, unless the view of all replaces it"};
}

std::array<double, 4> box_reach(const Box& box, const Directions& directions) {
  std::array<double, 4> reach;
  std::ranges::transform(directions, reach.begin(), [&](Vec3 direction) {
    double most = -kInfinity;
    for (int i = 0; i < 8; ++i) most = std::max(most, dot(direction, box.corner(i)));
    return most;
  });
  return reach;
}

FramedView frame_view(const ViewOptions& options, const FileView& file, const Box& framed_box,
                      const Reach& reach) {
  WHITTLE_CHECK(options.width > 0 && options.height > 0);
  const Framed framed = frame(options, file, framed_box, reach);
  const Pose& pose = framed.pose;
  const double tangent = tangent_of(framed.fov_degrees / 2);
  Camera camera;
  camera.right = pose.right;
  camera.up = pose.up;
  camera.forward = pose.forward;
  camera.eye = pose.target - pose.forward * pose.distance;
  camera.orthographic = options.orthographic;
  camera.half_height = options.orthographic ? pose.distance * tangent : tangent;
  camera.ortho_reach = options.orthographic ? kOrthographicReach * pose.distance : 0;
  camera.width = options.width;
  camera.height = options.height;
  return {camera, {pose.target, framed.rotation_degrees, pose.distance, framed.fov_degrees}};
}

Camera make_camera(const ViewOptions& options, const FileView& file, const Box& framed_box) {
  const Reach reach = [&](const Directions& directions) {
    return box_reach(framed_box, directions);
  };
  return frame_view(options, file, framed_box, reach).camera;
}

}  // namespace whittle
