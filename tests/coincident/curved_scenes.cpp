// Curved walls that two or more primitives share: cylinders, cones, spheres and their stretched
// images.
#include <cmath>

#include "coincident/scenes.h"

namespace whittle {
std::vector<CoincidentScene> curved_scenes() {
  return {
      {.name = "sleeve_on_shaft",
       .text = "translate([0, 0, 5]) cylinder(h = 6, r = 4); cylinder(h = 16, r = 4);",
       .equal = "cylinder(h = 16, r = 4);",
       .owners = {{1, 1, [](Vec3 p) { return p.z > 5 && p.z < 11; }},
                  {1, 2, [](Vec3 p) { return p.z < 5 || p.z > 11; }}}},

      {.name = "overlapping_shafts",
       .text = R"(
           cylinder(h = 8, r = 4);
           translate([0, 0, 4]) cylinder(h = 8, r = 4);
           translate([0, 0, 8]) cylinder(h = 8, r = 4);)",
       .equal = "cylinder(h = 16, r = 4);",
       .owners = {{1, 1, below(8)},
                  {1, 2, [](Vec3 p) { return p.z > 8 && p.z < 12; }},
                  {1, 3, above(12)}}},

      {.name = "common_part_of_shafts",
       .text = R"(
           intersection() {
             cylinder(h = 12, r = 5);
             translate([0, 0, 1]) cylinder(h = 12, r = 5);
             translate([0, 0, 0.5]) cylinder(h = 12, r = 5);
           })",
       .equal = "translate([0, 0, 1]) cylinder(h = 11, r = 5);",
       .owners = {{1, 1, above(1)}, {1, 2, below(1)}}},

      {.name = "bores_of_two_lengths",
       .text = R"(
           difference() {
             cube(10);
             translate([5, 5, 5]) cylinder(h = 5, r = 3);
             translate([5, 5, 0]) cylinder(h = 10, r = 3);
           })",
       .equal = "difference() { cube(10); translate([5, 5, -1]) cylinder(h = 12, r = 3); }",
       .owners = {{2, 2, above(5)}, {2, 3, below(5)}},
       .looks = {{{5.2, 5.1, 25}, {5, 5, 5}}, {{5, 4, 5}, {8, 7, 5}, 1}}},

      {.name = "bores_from_both_sides",
       .text = R"(
           difference() {
             cube(10);
             translate([5, 5, 0]) cylinder(h = 4, r = 3);
             translate([5, 5, 4]) cylinder(h = 6, r = 3);
           })",
       .equal = "difference() { cube(10); translate([5, 5, -1]) cylinder(h = 12, r = 3); }",
       .owners = {{2, 2, below(4)}, {2, 3, above(4)}},
       .looks = {{{5.2, 5.1, 25}, {5, 5, 5}}, {{5, 4, 5}, {8, 7, 4}, 1}}},

      {.name = "conical_bores_of_two_lengths",
       .text = R"(
           difference() {
             translate([-5, -5, 0]) cube(10);
             cylinder(h = 5, r1 = 4, r2 = 2);
             cylinder(h = 10, r1 = 4, r2 = 0);
           })",
       .equal = R"(
           difference() {
             translate([-5, -5, 0]) cube(10);
             translate([0, 0, -1]) cylinder(h = 11, r1 = 4.4, r2 = 0);
           })",
       .owners = {{2, 2, below(5)}, {2, 3, above(5)}},
       .looks = {{{1, -2, -15}, {0, 0, 5}}}},

      {.name = "tube_minus_its_bore",
       .text = R"(
           difference() {
             difference() { cylinder(h = 8, r = 5); cylinder(h = 8, r = 4); }
             cylinder(h = 8, r = 4);
           })",
       .equal = "difference() { cylinder(h = 8, r = 5); translate([0, 0, -1]) cylinder(h = 10, r "
                "= 4); }",
       .looks = {{{1, 2, 25}, {0, 0, 4}}}},

      {.name = "tube_and_its_core",
       .text = R"(
           difference() { cylinder(h = 8, r = 5); cylinder(h = 8, r = 4); }
           cylinder(h = 8, r = 4);)",
       .equal = "cylinder(h = 8, r = 5);",
       .owners = {{1, 1, [](Vec3 p) { return radius(p) > 4; }},
                  {1, 3, [](Vec3 p) { return radius(p) < 4; }}},
       .looks = {{{1, 0, 4}, {5, 1, 4}, 1}}},

      {.name = "bored_boss_on_bored_plate",
       .text = R"(
           difference() { translate([-5, -5, 0]) cube([10, 10, 2]); cylinder(h = 2, r = 2); }
           difference() {
             translate([0, 0, 2]) cylinder(h = 6, r = 4);
             translate([0, 0, 2]) cylinder(h = 6, r = 2);
           })",
       .equal = R"(
           difference() {
             union() {
               translate([-5, -5, 0]) cube([10, 10, 2]);
               translate([0, 0, 1]) cylinder(h = 7, r = 4);
             }
             translate([0, 0, -1]) cylinder(h = 10, r = 2);
           })",
       .owners = {{2, 3}, {3, 2, below(2)}, {3, 4, above(2)}},
       .looks = {{{0.3, 0.5, 7}, {1, 1, 0}, 1}}},

      {.name = "ball_in_its_seat",
       .text = R"(
           difference() { translate([-5, -5, -8]) cube([10, 10, 8]); sphere(r = 4); }
           sphere(r = 4);)",
       .equal = "translate([-5, -5, -8]) cube([10, 10, 8]); sphere(r = 4);",
       .owners = {{2, 3}},
       .looks = {{{0, 0, -1}, {1, 2, -4}, 1}}},

      {.name = "cone_in_its_seat",
       .text = R"(
           difference() { translate([-5, -5, 0]) cube([10, 10, 6]); cylinder(h = 6, r1 = 1, r2 = 4); }
           cylinder(h = 6, r1 = 1, r2 = 4);)",
       .equal = "translate([-5, -5, 0]) cube([10, 10, 6]);",
       .owners = {{1, 1, [](Vec3 p) { return radius(p) > 1 + p.z / 2; }},
                  {1, 3, [](Vec3 p) { return radius(p) < 1 + p.z / 2; }}},
       .looks = {{{0, 0, 3}, {3, 1, 2}, 1}}},

      {.name = "cone_continued",
       .text = "cylinder(h = 2, r1 = 5, r2 = 4); translate([0, 0, 2]) cylinder(h = 6, r1 = 4, r2 "
               "= 1);",
       .equal = "cylinder(h = 8, r1 = 5, r2 = 1);",
       .owners = {{1, 1, below(2)}, {1, 2, above(2)}}},

      {.name = "cone_to_its_apex_continued",
       .text = "translate([0, 0, 4]) cylinder(h = 4, r1 = 2, r2 = 0); cylinder(h = 4, r1 = 4, r2 "
               "= 2);",
       .equal = "cylinder(h = 8, r1 = 4, r2 = 0);",
       .owners = {{1, 1, above(4)}, {1, 2, below(4)}}},

      {.name = "sphere_by_scale",
       .text = R"(
           scale(0.9) sphere(r = 10);
           sphere(r = 9);
           scale([0.5, 0.75, 1.5]) scale([1.8, 1.2, 0.6]) sphere(r = 10);)",
       .equal = "sphere(r = 9);"},

      {.name = "ellipsoid_by_other_routes",
       .text = R"(
           scale([0.9, 0.6, 0.3]) sphere(r = 10);
           rotate([0, 0, 90]) scale([0.6, 0.9, 0.3]) sphere(r = 10);
           scale([0.45, 0.3, 0.15]) sphere(r = 20);)",
       .equal = "scale([0.9, 0.6, 0.3]) sphere(r = 10);"},

      {.name = "ellipsoid_seat_by_another_route",
       .text = R"(
           difference() {
             translate([-5, -5, -4]) cube([10, 10, 4]);
             scale([0.8, 0.6, 0.4]) sphere(r = 5);
             rotate([0, 90, 0]) scale([0.2, 0.3, 0.4]) sphere(r = 10);
           })",
       .equal = "difference() { translate([-5, -5, -4]) cube([10, 10, 4]); scale([0.8, 0.6, 0.4]) "
                "sphere(r = 5); }",
       .looks = {{{1, 2, 15}, {0, 0, -1}}}},

      {.name = "elliptic_cylinder_mirrored",
       .text = R"(
           rotate([0, 0, 25]) scale([0.8, 0.4, 1]) cylinder(h = 6, r = 8);
           mirror([0, 0, 1]) rotate([0, 0, 25]) scale([0.64, 0.32, 1]) cylinder(h = 6, r = 10);)",
       .equal =
           "translate([0, 0, -6]) rotate([0, 0, 25]) scale([0.8, 0.4, 1]) cylinder(h = 12, r = "
           "8);",
       .owners = {{1, 1, above(0)}, {1, 2, below(0)}}},

      {.name = "shaft_turned_about_its_axis",
       .text = R"(
           difference() {
             cube(10, center = true);
             rotate([0, 0, 17]) cylinder(h = 10, r = 3, center = true);
             rotate([180, 0, 71]) cylinder(h = 10, r = 3, center = true);
           })",
       .equal = "difference() { cube(10, center = true); cylinder(h = 12, r = 3, center = true); }",
       .looks = {{{1, 2, 20}, {0, 0, 0}}, {{0, 0, 0}, {2, 3, 4}, 1}}},
  };
}

}  // namespace whittle
