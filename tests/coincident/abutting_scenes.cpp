// Parts that stand side by side or fill one another: together they are one body, written as such
// in the equivalent.
#include <cmath>

#include "coincident/scenes.h"

namespace whittle {
namespace {

Where in_box(Vec3 lo, Vec3 hi) {
  return [=](Vec3 p) {
    return p.x >= lo.x && p.y >= lo.y && p.z >= lo.z && p.x <= hi.x && p.y <= hi.y && p.z <= hi.z;
  };
}

/// Bricks 3 long and 2 high in three courses, the middle one shifted by half a brick.
CoincidentScene brick_wall() {
  CoincidentScene scene{.name = "brick_wall",
                        .text = "",
                        .equal = "cube([9, 3, 6]);",
                        .looks = {{{4, 1, 3}, {9, 3, 6}, 1}}};
  uint32_t id = 0;
  const auto brick = [&](double x0, double x1, double z) {
    const auto number = [](double v) { return std::to_string(v); };
    scene.text += "translate([" + number(x0) + ", 0, " + number(z) + "]) cube([" + number(x1 - x0) +
                  ", 3, 2]);\n";
    scene.owners.push_back({1, ++id, in_box({x0, 0, z}, {x1, 3, z + 2})});
  };
  for (const double z : {0.0, 2.0, 4.0}) {
    const double shift = z == 2 ? 1.5 : 0;
    if (shift > 0) brick(0, shift, z);
    for (double x = shift; x < 9; x += 3) brick(x, std::min(x + 3, 9.0), z);
  }
  return scene;
}

}  // namespace

std::vector<CoincidentScene> abutting_scenes() {
  return {
      {.name = "two_boxes",
       .text = "cube(6); translate([6, 0, 0]) cube(6);",
       .equal = "cube([12, 6, 6]);",
       .owners = {{1, 1, [](Vec3 p) { return p.x < 6; }}, {1, 2, [](Vec3 p) { return p.x > 6; }}},
       .looks = {{{3, 3, 3}, {12, 4, 4}, 1}}},

      {.name = "eight_boxes_around_a_point",
       .text = R"(
           translate([-5, -5, -5]) cube(5);
           translate([0, -5, -5]) cube(5);
           translate([-5, 0, -5]) cube(5);
           translate([0, 0, -5]) cube(5);
           translate([-5, -5, 0]) cube(5);
           translate([0, -5, 0]) cube(5);
           translate([-5, 0, 0]) cube(5);
           translate([0, 0, 0]) cube(5);)",
       .equal = "cube(10, center = true);",
       .owners = {{1, 1, in_box({-5, -5, -5}, {0, 0, 0})},
                  {1, 2, in_box({0, -5, -5}, {5, 0, 0})},
                  {1, 3, in_box({-5, 0, -5}, {0, 5, 0})},
                  {1, 4, in_box({0, 0, -5}, {5, 5, 0})},
                  {1, 5, in_box({-5, -5, 0}, {0, 0, 5})},
                  {1, 6, in_box({0, -5, 0}, {5, 0, 5})},
                  {1, 7, in_box({-5, 0, 0}, {0, 5, 5})},
                  {1, 8, in_box({0, 0, 0}, {5, 5, 5})}}},

      brick_wall(),

      {.name = "l_shape",
       .text = "cube([9, 3, 3]); translate([0, 0, 3]) cube([3, 3, 6]);",
       .equal = "difference() { cube([9, 3, 9]); translate([3, -1, 3]) cube([7, 5, 7]); }",
       .owners = {{1, 1, [](Vec3 p) { return p.z < 3; }},
                  {1, 2, [](Vec3 p) { return p.z > 3; }},
                  {2, 1, [](Vec3 p) { return p.z < 3; }},
                  {2, 2, [](Vec3 p) { return p.x < 3; }}},
       .looks = {{{8, 1, 8}, {2, 1.5, 2}, 1}, {{2, 1, 5}, {5, 2, 1}, 1}}},

      {.name = "stacked_cylinders",
       .text = "cylinder(h = 4, r = 4); translate([0, 0, 4]) cylinder(h = 4, r = 4);",
       .equal = "cylinder(h = 8, r = 4);",
       .owners = {{1, 1, [](Vec3 p) { return p.z < 4; }}, {1, 2, [](Vec3 p) { return p.z > 4; }}}},

      {.name = "cylinder_on_box",
       .text = "translate([-4, -4, 0]) cube([8, 8, 3]); translate([0, 0, 3]) cylinder(h = 5, r = "
               "3);",
       .equal = "translate([-4, -4, 0]) cube([8, 8, 3]); translate([0, 0, 1]) cylinder(h = 7, r = "
                "3);",
       .looks = {{{0, 0, 4}, {2, 3, 2}, 1}}},

      {.name = "quarter_cylinders",
       .text = R"(
           intersection() {
             cylinder(h = 8, r = 5, center = true);
             translate([0, 0, -4]) cube([6, 6, 8]);
           }
           intersection() {
             cylinder(h = 8, r = 5, center = true);
             translate([-6, 0, -4]) cube([6, 6, 8]);
           }
           intersection() {
             cylinder(h = 8, r = 5, center = true);
             translate([-6, -6, -4]) cube([6, 6, 8]);
           }
           intersection() {
             cylinder(h = 8, r = 5, center = true);
             translate([0, -6, -4]) cube([6, 6, 8]);
           })",
       .equal = "cylinder(h = 8, r = 5, center = true);",
       .owners = {{1, 1, [](Vec3 p) { return p.x > 0 && p.y > 0; }},
                  {1, 3, [](Vec3 p) { return p.x < 0 && p.y > 0; }},
                  {1, 5, [](Vec3 p) { return p.x < 0 && p.y < 0; }},
                  {1, 7, [](Vec3 p) { return p.x > 0 && p.y < 0; }}}},

      {.name = "half_spheres",
       .text = R"(
           intersection() { sphere(r = 5); halfspace(n = [0, 0, 1], d = 0); }
           intersection() { sphere(r = 5); halfspace(n = [0, 0, -1], d = 0); })",
       .equal = "sphere(r = 5);",
       .owners = {{1, 1, [](Vec3 p) { return p.z < 0; }}, {1, 3, [](Vec3 p) { return p.z > 0; }}}},

      {.name = "mirrored_half_spheres",
       .text = R"(
           intersection() { sphere(r = 5); halfspace(n = [1, 2, 3], d = 0); }
           mirror([1, 2, 3]) intersection() { sphere(r = 5); halfspace(n = [1, 2, 3], d = 0); })",
       .equal = "sphere(r = 5);",
       .owners = {{1, 1, [](Vec3 p) { return p.x + 2 * p.y + 3 * p.z < 0; }},
                  {1, 3, [](Vec3 p) { return p.x + 2 * p.y + 3 * p.z > 0; }}}},

      {.name = "mirrored_halves_of_a_bracket",
       .text = R"(
           difference() { cube([5, 6, 4]); translate([0, 2, 0]) cube([3, 2, 4]); }
           mirror([1, 0, 0]) difference() { cube([5, 6, 4]); translate([0, 2, 0]) cube([3, 2, 4]); })",
       .equal = R"(
           difference() {
             translate([-5, 0, 0]) cube([10, 6, 4]);
             translate([-3, 2, -1]) cube([6, 2, 6]);
           })",
       .owners = {{1, 1, [](Vec3 p) { return p.x > 0; }},
                  {1, 3, [](Vec3 p) { return p.x < 0; }},
                  {2, 2, [](Vec3 p) { return p.x > 0; }},
                  {2, 4, [](Vec3 p) { return p.x < 0; }}},
       .looks = {{{1, 2, 15}, {0, 3, 2}}}},

      {.name = "nested_box_shells",
       .text = R"(
           difference() {
             union() {
               difference() { cube(10, center = true); cube(8, center = true); }
               difference() { cube(8, center = true); cube(6, center = true); }
             }
             cube(9);
           })",
       .equal = R"(
           difference() {
             difference() { cube(10, center = true); cube(6, center = true); }
             cube(9);
           })",
       .owners = {{2, 4}, {3, 5}},
       .looks = {{{15, 14, 13}, {0, 0, 0}}, {{-4.6, -1, -2}, {0, 0, -1}, 1}}},

      {.name = "nested_spherical_shells",
       .text = R"(
           difference() {
             union() {
               difference() { sphere(r = 5); sphere(r = 4); }
               difference() { sphere(r = 4); sphere(r = 3); }
             }
             cube(9);
           })",
       .equal = "difference() { difference() { sphere(r = 5); sphere(r = 3); } cube(9); }",
       .owners = {{2, 4}, {3, 5}},
       .looks = {{{15, 14, 13}, {0, 0, 0}}, {{-4.6, -1, -1}, {0, 0, 0}, 1}}},

      {.name = "nested_tubes",
       .text = R"(
           difference() {
             union() {
               difference() { cylinder(h = 8, r = 5); cylinder(h = 8, r = 4); }
               difference() { cylinder(h = 8, r = 4); cylinder(h = 8, r = 3); }
             }
             translate([0, 0, 4]) cube(9);
           })",
       .equal = R"(
           difference() {
             difference() {
               cylinder(h = 8, r = 5);
               translate([0, 0, -1]) cylinder(h = 10, r = 3);
             }
             translate([0, 0, 4]) cube(9);
           })",
       .owners = {{1, 1, [](Vec3 p) { return radius(p) > 4; }},
                  {1, 3, [](Vec3 p) { return radius(p) < 4; }},
                  {2, 4},
                  {3, 5}},
       .looks = {{{15, 14, 13}, {0, 0, 4}}}},

      {.name = "same_box_twice_and_a_slab",
       .text = "cube(9); cube(9); translate([2, 0, 6]) cube([3, 9, 3]);",
       .equal = "cube(9);"},

      {.name = "slab_first",
       .text = "translate([2, 0, 6]) cube([3, 9, 3]); cube(9);",
       .equal = "cube(9);",
       .owners = {{1, 1, in_box({2, 0, 6}, {5, 9, 9})},
                  {1, 2, [](Vec3 p) { return p.x < 2 || p.x > 5 || p.z < 6; }}}},

      {.name = "plug",
       .text = R"(
           difference() { cube(10); translate([5, 5, 0]) cylinder(h = 10, r = 3); }
           translate([5, 5, 0]) cylinder(h = 10, r = 3);)",
       .equal = "cube(10);",
       .owners = {{1, 1,
                   [](Vec3 p) {
                     return radius(p - Vec3{5, 5, 0}) > 3;
                   }},
                  {1, 3,
                   [](Vec3 p) {
                     return radius(p - Vec3{5, 5, 0}) < 3;
                   }}}},

      {.name = "tenon_in_mortise",
       .text = R"(
           difference() { cube([10, 6, 5]); translate([6, 2, 0]) cube([4, 2, 5]); }
           translate([6, 2, 0]) cube([6, 2, 5]);)",
       .equal = R"(
           intersection() {
             cube([12, 6, 5]);
             union() {
               halfspace(n = [1, 0, 0], d = 10);
               translate([-1, 2, -1]) cube([14, 2, 7]);
             }
           })",
       .owners = {{1, 1, [](Vec3 p) { return p.x < 6 || p.y < 2 || p.y > 4; }},
                  {1, 3, [](Vec3 p) { return p.x > 6 && p.y > 2 && p.y < 4; }},
                  {2, 1}}},
  };
}

}  // namespace whittle
