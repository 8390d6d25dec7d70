// Extrusions, revolutions and polyhedra that are not convex, against what is known on paper of the
// boxes and cylinders that they equal: of all sizes, far away, and through narrow and wide eyes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "numbers/accuracy.h"

namespace whittle {
namespace {

struct Body {
  const char* name;
  const char* text;
  Known (*seen)(const ExactRay& ray, ExactVec at, Exact scale);
};

/// An angle of two walls, 10 x 10 x 6, walls 4 thick.
Known seen_of_angle(const ExactRay& ray, ExactVec at, Exact scale) {
  return seen_of_union(ray, {box(1, ray, at, at + ExactVec{10, 4, 6} * scale),
                             box(1, ray, at, at + ExactVec{4, 10, 6} * scale)});
}

/// The same with a hole through one of the walls.
Known seen_of_drilled_angle(const ExactRay& ray, Exact scale) {
  const Known drilled =
      seen_of_difference(ray, {box(1, ray, {}, ExactVec{10, 4, 6} * scale),
                               cylinder(2, ray, 2, ExactVec{7, 2, -1} * scale, scale, 8 * scale)});
  const Known whole = seen_of_union(ray, {box(1, ray, {}, ExactVec{4, 10, 6} * scale)});
  return whole.distance < drilled.distance ? whole : drilled;
}

Known seen_of_tube(const ExactRay& ray, ExactVec at, Exact scale) {
  return seen_of_difference(
      ray, {cylinder(1, ray, 2, at, 5 * scale, 7 * scale),
            cylinder(1, ray, 2, at - ExactVec{0, 0, scale}, 3 * scale, 9 * scale)});
}

constexpr const char* kAngleOutline = "polygon([[0,0],[10,0],[10,4],[4,4],[4,10],[0,10]]);";
constexpr const char* kAngleMesh =
    "polyhedron(points = [[0,0,0],[10,0,0],[10,4,0],[4,4,0],[4,10,0],[0,10,0],"
    "[0,0,6],[10,0,6],[10,4,6],[4,4,6],[4,10,6],[0,10,6]],"
    " faces = [[0,1,2,3,4,5],[11,10,9,8,7,6],[1,0,6,7],[2,1,7,8],[3,2,8,9],[4,3,9,10],"
    "[5,4,10,11],[0,5,11,6]]);";
const std::string kExtrudedAngle = fmt::format("linear_extrude(6) {}", kAngleOutline);
/// What is cut off above it and between its walls lies along its own faces, and takes nothing away.
const std::string kDrilledMesh = fmt::format(
    "difference() {{ {} translate([7, 2, -1]) cylinder(h = 8, r = 1);"
    " translate([0, 0, 6]) cube([10, 10, 5]); translate([4, 4, -1]) cube([6, 6, 8]); }}",
    kAngleMesh);
const std::string kTube = "rotate_extrude() translate([3, 0]) square([2, 7]);";

const Body kBodies[] = {
    {"extruded", kExtrudedAngle.c_str(), seen_of_angle},
    {"polyhedron", kAngleMesh, seen_of_angle},
    {"revolved", kTube.c_str(), seen_of_tube},
};

std::string placed(const char* text, Vec3 at, double scale) {
  return fmt::format(
      "multmatrix([[{0}, 0, 0, {1}], [0, {0}, 0, {2}], [0, 0, {0}, {3}], [0, 0, 0, 1]]) {4}", scale,
      at.x, at.y, at.z, text);
}

TEST(Bodies, OfAllSizesAndFarFromTheOrigin) {
  for (const Body& body : kBodies)
    for (const double scale : {1e-6, 1.0, 1e6})
      for (const double away : {0.0, 1e6}) {
        SCOPED_TRACE(fmt::format("{}, scale {}, {} sizes away", body.name, scale, away));
        const Vec3 at = Vec3{1, -1, 0.5} * (away * scale);
        const std::string text = placed(body.text, at, scale);
        const Answer answer = [&](const ExactRay& ray) {
          return body.seen(ray, exact(at), Exact(scale));
        };
        const Vec3 middle = at + Vec3{2, 2, 3} * scale;
        for (const Vec3 from : {Vec3{16, -20, 13}, Vec3{-9, 14, -21}, Vec3{1, 2, 40}}) {
          const PictureCounts counts =
              expect_known(text, look(middle + from * scale, middle, 40), answer);
          EXPECT_GT(counts.hits, counts.pixels / 20);
          EXPECT_LE(counts.undecided, counts.pixels / 20);
        }
        expect_known(text, look_parallel(middle + Vec3{16, -20, 13} * scale, middle, 16 * scale),
                     answer);
      }
}

TEST(Bodies, ThroughNarrowAndWideEyes) {
  for (const Body& body : kBodies)
    for (const double fov : {0.001, 1.0, 60.0, 120.0, 170.0}) {
      SCOPED_TRACE(fmt::format("{}, fov {}", body.name, fov));
      const double away = std::max(9 / std::tan(fov * std::atan(1.0) / 90), 12.0);
      const Vec3 middle{2, 2, 3}, from = normalize(Vec3{0.57, -0.74, 0.43});
      const Answer answer = [&](const ExactRay& ray) { return body.seen(ray, {}, 1); };
      expect_known(body.text, look(middle + from * away, middle, fov, 65, 49), answer);
      // From in the angle and from in the tube.
      expect_known(body.text, look({7, 7, 5}, {3, 2, 2}, fov), answer);
      expect_known(body.text, look({0.5, 0.25, 5}, {0, 4, 2}, fov), answer);
    }
}

TEST(Bodies, APolyhedronDrilledAndCutAlongItsOwnFaces) {
  for (const double scale : {1e-3, 1.0, 1e3}) {
    SCOPED_TRACE(scale);
    const Answer answer = [&](const ExactRay& ray) {
      return seen_of_drilled_angle(ray, Exact(scale));
    };
    const std::string text = placed(kDrilledMesh.c_str(), {}, scale);
    for (const Vec3 from : {Vec3{5, -7, 26}, Vec3{30, -40, 20}})
      expect_known(text, look(Vec3{7, 2, 6} * scale + from * scale, Vec3{7, 2, 3} * scale, 20),
                   answer);
  }
}

}  // namespace
}  // namespace whittle
