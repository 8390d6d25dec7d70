// Cutters whose faces lie on faces of what they cut. The equivalent's cutters poke out.
#include "coincident/scenes.h"

namespace whittle {

std::vector<CoincidentScene> flush_scenes() {
  return {
      {.name = "flush_pocket",
       .text = "difference() { cube(10); translate([2, 2, 5]) cube([6, 6, 5]); }",
       .equal = "difference() { cube(10); translate([2, 2, 5]) cube([6, 6, 6]); }",
       .looks = {{{5, 5, 24}, {5.3, 5.2, 5}}, {{3, 4, 7}, {8, 7, 6}, 1}}},

      {.name = "flush_colours",
       .text = R"(
           color([1, 0, 0, 1]) cube([100, 100, 1]);
           color([1, 1, 0, 1]) difference() {
             translate([0, 0, 1]) cube([100, 100, 1]);
             translate([10, 10, -1]) cube([80, 80, 5]);
           })",
       .equal = R"(
           difference() {
             cube([100, 100, 2]);
             intersection() {
               translate([10, 10, -1]) cube([80, 80, 5]);
               halfspace(n = [0, 0, -1], d = -1);
             }
           })",
       .owners = {{1, 1, [](Vec3 p) { return p.z < 1; }},
                  {1, 2, [](Vec3 p) { return p.z > 1; }},
                  {2, 3},
                  {3, 1}},
       .looks = {{{50, 51, 150}, {50, 50, 0}}, {{-20, 30, 3}, {50, 50, 1}}}},

      {.name = "ring_convexity",
       .text = R"(
           difference() {
             difference() { cylinder(h = 18, r = 20); cylinder(h = 18, r = 18); }
             translate([0, 0, 9]) cube([100, 4, 4], center = true);
           })",
       .equal = R"(
           difference() {
             difference() {
               cylinder(h = 18, r = 20);
               translate([0, 0, -1]) cylinder(h = 20, r = 18);
             }
             translate([0, 0, 9]) cube([100, 4, 4], center = true);
           })",
       .looks = {{{60, 1, 10}, {0, 0, 9}}},
       .turns = false},

      {.name = "camera_inside_cutter",
       .text = "difference() { sphere(r = 30); cube([1000, 1000, 1000]); }",
       .equal = R"(
           difference() {
             sphere(r = 30);
             intersection() {
               halfspace(n = [-1, 0, 0], d = 0);
               halfspace(n = [0, -1, 0], d = 0);
               halfspace(n = [0, 0, -1], d = 0);
             }
           })",
       .owners = {{2, 2}, {3, 2}, {4, 2}},
       .looks = {{{40, 35, 30}, {0, 0, 0}}, {{500, 400, 600}, {0, 0, 0}, 0.08}},
       .turns = false},

      {.name = "pockets_on_all_sides",
       .text = R"(
           difference() {
             cube(10, center = true);
             translate([-2, -2, 3]) cube([4, 4, 2]);
             translate([-2, -2, -5]) cube([4, 4, 2]);
             translate([-2, 3, -2]) cube([4, 2, 4]);
             translate([-2, -5, -2]) cube([4, 2, 4]);
             translate([3, -2, -2]) cube([2, 4, 4]);
             translate([-5, -2, -2]) cube([2, 4, 4]);
           })",
       .equal = R"(
           difference() {
             cube(10, center = true);
             translate([-2, -2, 3]) cube([4, 4, 3]);
             translate([-2, -2, -6]) cube([4, 4, 3]);
             translate([-2, 3, -2]) cube([4, 3, 4]);
             translate([-2, -6, -2]) cube([4, 3, 4]);
             translate([3, -2, -2]) cube([3, 4, 4]);
             translate([-6, -2, -2]) cube([3, 4, 4]);
           })"},

      {.name = "bore",
       .text = "difference() { cube(10); translate([5, 5, 0]) cylinder(h = 10, r = 3); }",
       .equal = "difference() { cube(10); translate([5, 5, -1]) cylinder(h = 12, r = 3); }",
       .looks = {{{5.2, 5.1, 25}, {5, 5, 5}}, {{5, 5, 5}, {8, 7, 9}, 1}}},

      {.name = "bores_on_all_axes",
       .text = R"(
           difference() {
             cube(10, center = true);
             cylinder(h = 10, r = 3, center = true);
             rotate([90, 0, 0]) cylinder(h = 10, r = 2, center = true);
             rotate([0, 90, 0]) cylinder(h = 10, r = 1, center = true);
           })",
       .equal = R"(
           difference() {
             cube(10, center = true);
             cylinder(h = 12, r = 3, center = true);
             rotate([90, 0, 0]) cylinder(h = 12, r = 2, center = true);
             rotate([0, 90, 0]) cylinder(h = 12, r = 1, center = true);
           })",
       .looks = {{{0.2, 0.3, 20}, {0, 0, 0}}}},

      {.name = "corner_notch",
       .text = "difference() { cube(10); translate([5, 0, 5]) cube(5); }",
       .equal = "difference() { cube(10); translate([5, -1, 5]) cube(6); }"},

      {.name = "edge_slot",
       .text = "difference() { cube(10); translate([6, 0, 6]) cube([4, 10, 4]); }",
       .equal = "difference() { cube(10); translate([6, -1, 6]) cube([5, 12, 5]); }"},

      {.name = "t_slot",
       .text = R"(
           difference() {
             cube(10);
             translate([4, 0, 5]) cube([2, 10, 5]);
             translate([2, 0, 3]) cube([6, 10, 2]);
           })",
       .equal = R"(
           difference() {
             cube(10);
             translate([4, -1, 4]) cube([2, 12, 7]);
             translate([2, -1, 3]) cube([6, 12, 2]);
           })",
       .looks = {{{5.1, -12, 7}, {5, 0, 5}}, {{5, 5, 4}, {7, 8, 5}, 1}}},

      {.name = "countersink",
       .text = R"(
           difference() {
             cube(10);
             translate([5, 5, 0]) cylinder(h = 10, r = 1);
             translate([5, 5, 8]) cylinder(h = 2, r1 = 1, r2 = 3);
           })",
       .equal = R"(
           difference() {
             cube(10);
             translate([5, 5, -1]) cylinder(h = 12, r = 1);
             translate([5, 5, 7]) cylinder(h = 4, r1 = 0, r2 = 4);
           })",
       .looks = {{{5.2, 5.1, 25}, {5, 5, 5}, 0.3}}},

      {.name = "counterbore",
       .text = R"(
           difference() {
             cube(10);
             translate([5, 5, 6]) cylinder(h = 4, r = 3);
             translate([5, 5, 0]) cylinder(h = 6, r = 1.5);
           })",
       .equal = R"(
           difference() {
             cube(10);
             translate([5, 5, 6]) cylinder(h = 5, r = 3);
             translate([5, 5, -1]) cylinder(h = 8, r = 1.5);
           })",
       .looks = {{{6, 7, 25}, {5, 5, 5}, 0.3}}},

      {.name = "pocket_under_pocket",
       .text = R"(
           difference() {
             cube(10);
             translate([2, 2, 5]) cube([6, 6, 5]);
             translate([3, 3, 2]) cube([4, 4, 3]);
           })",
       .equal = R"(
           difference() {
             cube(10);
             translate([2, 2, 5]) cube([6, 6, 6]);
             translate([3, 3, 2]) cube([4, 4, 4]);
           })",
       .looks = {{{6, 4, 22}, {5, 5, 5}}, {{4, 4, 4}, {6, 6, 2}, 1}}},

      {.name = "pocket_in_cylinder",
       .text = "difference() { cylinder(h = 10, r = 5); translate([0, 0, 5]) cylinder(h = 5, r = "
               "4); }",
       .equal = "difference() { cylinder(h = 10, r = 5); translate([0, 0, 5]) cylinder(h = 6, r = "
                "4); }",
       .looks = {{{1, 2, 25}, {0, 0, 5}}}},

      {.name = "pocket_in_frustum",
       .text = R"(
           difference() {
             cylinder(h = 8, r1 = 6, r2 = 3);
             translate([0, 0, 4]) cylinder(h = 4, r1 = 1, r2 = 2);
           })",
       .equal = R"(
           difference() {
             cylinder(h = 8, r1 = 6, r2 = 3);
             translate([0, 0, 4]) cylinder(h = 8, r1 = 1, r2 = 3);
           })",
       .looks = {{{1, 2, 25}, {0, 0, 5}, 0.2}}},

      {.name = "ring_groove",
       .text = R"(
           difference() {
             cylinder(h = 4, r = 6);
             difference() {
               translate([0, 0, 2]) cylinder(h = 2, r = 5);
               translate([0, 0, 2]) cylinder(h = 2, r = 3);
             }
           })",
       .equal = R"(
           difference() {
             cylinder(h = 4, r = 6);
             difference() {
               translate([0, 0, 2]) cylinder(h = 3, r = 5);
               translate([0, 0, 1]) cylinder(h = 5, r = 3);
             }
           })",
       .looks = {{{5, 6, 15}, {0, 0, 2}}}},

      {.name = "three_cutters_in_a_row",
       .text = R"(
           difference() {
             cube(10);
             translate([0, 3, 5]) cube([3, 4, 5]);
             translate([3, 3, 5]) cube([4, 4, 5]);
             translate([7, 3, 5]) cube([3, 4, 5]);
           })",
       .equal = "difference() { cube(10); translate([-1, 3, 5]) cube([12, 4, 6]); }",
       .owners = {{2, 2, [](Vec3 p) { return p.x < 3; }},
                  {2, 3, [](Vec3 p) { return p.x > 3 && p.x < 7; }},
                  {2, 4, [](Vec3 p) { return p.x > 7; }}},
       .looks = {{{-12, 5.1, 9}, {5, 5, 7}}}},

      {.name = "four_cutters_around_an_edge",
       .text = R"(
           difference() {
             cube(10);
             translate([2, 2, 5]) cube([3, 3, 5]);
             translate([5, 2, 5]) cube([3, 3, 5]);
             translate([2, 5, 5]) cube([3, 3, 5]);
             translate([5, 5, 5]) cube([3, 3, 5]);
           })",
       .equal = "difference() { cube(10); translate([2, 2, 5]) cube([6, 6, 6]); }",
       .owners = {{2, 2, [](Vec3 p) { return p.x < 5 && p.y < 5; }},
                  {2, 3, [](Vec3 p) { return p.x > 5 && p.y < 5; }},
                  {2, 4, [](Vec3 p) { return p.x < 5 && p.y > 5; }},
                  {2, 5, [](Vec3 p) { return p.x > 5 && p.y > 5; }}},
       .looks = {{{5, 5, 24}, {5.3, 5.2, 5}}, {{3, 4, 7}, {8, 7, 6}, 1}}},
  };
}

}  // namespace whittle
