// Extrusions, revolutions, hulls and meshes with faces on one another, and one solid written in
// several ways. The equivalents are of primitives alone, or nothing is left.
#include <utility>

#include "coincident/scenes.h"

namespace whittle {
namespace {

const std::string kCube = "cube(10);";
const std::string kPolygon =
    "linear_extrude(height = 10) polygon([[0, 0], [10, 0], [10, 10], [0, 10]]);";
const std::string kCorners =
    "[[0, 0, 0], [10, 0, 0], [10, 10, 0], [0, 10, 0],"
    " [0, 0, 10], [10, 0, 10], [10, 10, 10], [0, 10, 10]]";
const std::string kPolyhedron =
    "polyhedron(points = " + kCorners +
    ", faces = [[0, 1, 2, 3], [4, 7, 6, 5], [0, 4, 5, 1], [1, 5, 6, 2], [2, 6, 7, 3],"
    " [3, 7, 4, 0]]);";
const std::string kTriangles =
    "polyhedron(points = " + kCorners +
    ", faces = [[0, 1, 2], [0, 2, 3], [4, 7, 6], [4, 6, 5], [0, 4, 5], [0, 5, 1], [1, 5, 6],"
    " [1, 6, 2], [2, 6, 7], [2, 7, 3], [3, 7, 4], [3, 4, 0]]);";
const std::string kHull = "hull() { cube([10, 10, 1]); translate([0, 0, 9]) cube([10, 10, 1]); }";
const std::string kL =
    "linear_extrude(height = 5) polygon([[0, 0], [10, 0], [10, 4], [4, 4], [4, 10], [0, 10]]);";
const std::string kRing = "rotate_extrude($fn = 24) translate([4, 0]) square([3, 5]);";

// Beside a seam that no edge shows, either body may be seen.
constexpr double kAside = 1e-6;

std::string difference(const std::string& a, const std::string& b) {
  return "difference() { " + a + " " + b + " }";
}

}  // namespace

std::vector<CoincidentScene> body_scenes() {
  std::vector<CoincidentScene> scenes = {
      {.name = "l_less_flush_cubes",
       .text = difference(kL, "translate([4, 0, 0]) cube([6, 4, 5]);"),
       .equal = "cube([4, 10, 5]);",
       .owners = {{1, 1, [](Vec3 p) { return p.x < 4 - kAside || p.y > 4 - kAside; }},
                  {1, 3, [](Vec3 p) { return p.x > 4 - kAside && p.y < 4 + kAside; }}},
       .looks = {{{20, -9, 15}, {3, 5, 2}}},
       .turns = false},

      {.name = "extrusions_abut",
       .text = kL + " translate([4, 4, 0]) linear_extrude(height = 5) square(6);",
       .equal = "cube([10, 10, 5]);",
       .owners = {{1, 1, [](Vec3 p) { return p.x < 4 + kAside || p.y < 4 + kAside; }},
                  {1, 3, [](Vec3 p) { return p.x > 4 - kAside && p.y > 4 - kAside; }}},
       .turns = false},

      {.name = "ring_less_its_bore",
       .text = difference("rotate_extrude($fn = 24) square([7, 5]);",
                          "cylinder(h = 5, r = 4, $fn = 24);"),
       .equal = difference("cylinder(h = 5, r = 7, $fn = 24);",
                           "translate([0, 0, -1]) cylinder(h = 7, r = 4, $fn = 24);"),
       .owners = {{2, 3}},
       .turns = false},
  };
  // One solid, less the same solid, is nothing.
  const std::pair<const char*, std::string> solids[] = {{"cube", kCube},
                                                        {"polygon", kPolygon},
                                                        {"polyhedron", kPolyhedron},
                                                        {"triangles", kTriangles},
                                                        {"hull", kHull}};
  for (const auto& [name, solid] : solids)
    for (const auto& [other_name, other] : solids)
      scenes.push_back({.name = std::string(name) + "_less_" + other_name,
                        .text = difference(solid, other),
                        .equal = kNothing,
                        .turns = false});
  scenes.push_back({.name = "ring_less_cylinders",
                    .text = "difference() { " + kRing +
                            " difference() { cylinder(h = 5, r = 7, $fn = 24);"
                            " cylinder(h = 5, r = 4, $fn = 24); } }",
                    .equal = kNothing,
                    .turns = false});
  return scenes;
}

}  // namespace whittle
