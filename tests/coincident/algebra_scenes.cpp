// Laws of sets, on solids that share faces: what is left is worked out by hand.
#include <cmath>

#include "coincident/scenes.h"

namespace whittle {
namespace {

/// One of every kind of primitive, apart from one another; with an operator, each of them is two
/// alike under that operator.
std::string of_every_kind(const std::string& op) {
  const char* const kinds[] = {
      "cube(3);",
      "sphere(r = 1.6);",
      "cylinder(h = 3, r = 1.5);",
      "cylinder(h = 3, r1 = 1.5, r2 = 0.5);",
      "cylinder($fn = 7, h = 3, r = 1.5);",
      "sphere($fn = 9, r = 1.6);",
      "rotate([20, 30, 40]) cube([3, 2, 2]);",
      "rotate([10, 50, 0]) scale([1, 0.5, 0.8]) sphere(r = 1.6);",
      "polyhedron(points = [[0, 0, 0], [3, 0, 0], [0, 3, 0], [0, 0, 3]], faces = [[0, 1, 2], [0, "
      "3, 1], [0, 2, 3], [1, 3, 2]]);"};
  std::string text;
  for (int i = 0; i < 9; ++i)
    text += "translate([" + std::to_string(i % 3 * 4 - 4) + ", " + std::to_string(i / 3 * 4 - 4) +
            ", 0]) " + (op.empty() ? kinds[i] : op + "() { " + kinds[i] + " " + kinds[i] + " }") +
            "\n";
  return text;
}

/// The second of two alike is never seen: ids 1, 3, 5, ... of the scene for 1, 2, 3, ...
std::vector<Owner> every_second_of_nine() {
  std::vector<Owner> owners;
  for (uint32_t i = 1; i <= 9; ++i) owners.push_back({i, 2 * i - 1});
  return owners;
}

bool in_second_box(Vec3 p) {
  return p.x > 3 && p.y > 3 && p.z > 0;
}

}  // namespace

std::vector<CoincidentScene> algebra_scenes() {
  // A and B share the planes z = 0 and z = 6.
  const std::string a = "cube([6, 6, 6]);", b = "translate([3, 3, 0]) cube([6, 5, 6]);";
  const std::string c = "translate([3, 3, 0]) cylinder(h = 6, r = 2);";
  return {
      {.name = "a_minus_a",
       .text = of_every_kind("difference"),
       .equal = kNothing,
       .looks = {{{0, 0, 0.5}, {3, 2, 0}, 1}, {{0.3, 0.4, 20}, {0, 0, 0}}}},

      {.name = "a_or_a",
       .text = of_every_kind("union"),
       .equal = of_every_kind(""),
       .owners = every_second_of_nine(),
       .looks = {{{0, 0, 0.5}, {3, 2, 0}, 1}}},

      {.name = "a_and_a",
       .text = of_every_kind("intersection"),
       .equal = of_every_kind(""),
       .owners = every_second_of_nine(),
       .looks = {{{0, 0, 0.5}, {3, 2, 0}, 1}}},

      // The inner bodies' own faces never count: A - (A - B) = A and B.
      {.name = "a_minus_a_minus_b",
       .text = "difference() { cube(8); difference() { cube(8); translate([8, 0, 8]) sphere(r = "
               "6); } }",
       .equal = "intersection() { cube(8); translate([8, 0, 8]) sphere(r = 6); }",
       .owners = {{2, 3}}},

      {.name = "round_a_minus_a_minus_b",
       .text = "difference() { sphere(r = 5); difference() { sphere(r = 5); translate([0, 0, 3]) "
               "cylinder(h = 9, r = 3, center = true); } }",
       .equal = "intersection() { sphere(r = 5); translate([0, 0, 3]) cylinder(h = 9, r = 3, "
                "center = true); }",
       .owners = {{2, 3}}},

      {.name = "a_without_b_or_a_with_b",
       .text = R"(
           difference() { sphere(r = 5); translate([3, 0, 0]) cube(8, center = true); }
           intersection() { sphere(r = 5); translate([3, 0, 0]) cube(8, center = true); })",
       .equal = "sphere(r = 5);",
       .owners = {{1, 1,
                   [](Vec3 p) { return p.x < -1 || std::fabs(p.y) > 4 || std::fabs(p.z) > 4; }},
                  {1, 3,
                   [](Vec3 p) { return p.x > -1 && std::fabs(p.y) < 4 && std::fabs(p.z) < 4; }}}},

      {.name = "a_without_b_or_b_flush",
       .text = "difference() { " + a + b + " } " + b,
       .equal = R"(
           difference() {
             cube([9, 8, 6]);
             translate([6, -1, -1]) cube([5, 4, 8]);
             translate([-1, 6, -1]) cube([4, 4, 8]);
           })",
       .owners = {{1, 1, [](Vec3 p) { return p.x < 3 || p.y < 3; }},
                  {1, 3, in_second_box},
                  {2, 1, [](Vec3 p) { return p.x < 6; }},
                  {2, 3, [](Vec3 p) { return p.y > 3; }},
                  {3, 1, [](Vec3 p) { return p.y < 6; }},
                  {3, 3, [](Vec3 p) { return p.x > 3; }}}},

      {.name = "three_parts_of_a_union",
       .text = "difference() { " + a + b + " } intersection() { " + a + b + " } difference() { " +
               b + a + " }",
       .equal = R"(
           difference() {
             cube([9, 8, 6]);
             translate([6, -1, -1]) cube([5, 4, 8]);
             translate([-1, 6, -1]) cube([4, 4, 8]);
           })",
       .owners = {{1, 1, [](Vec3 p) { return p.x < 3 || p.y < 3; }},
                  {1, 3, [](Vec3 p) { return p.x > 3 && p.y > 3 && p.x < 6 && p.y < 6; }},
                  {1, 5, [](Vec3 p) { return in_second_box(p) && (p.x > 6 || p.y > 6); }},
                  {2, 1, [](Vec3 p) { return p.x < 6; }},
                  {2, 5, [](Vec3 p) { return p.y > 3; }},
                  {3, 1, [](Vec3 p) { return p.y < 6; }},
                  {3, 5, [](Vec3 p) { return p.x > 3; }}}},

      {.name = "the_same_cutter_twice",
       .text = "difference() { " + a + c + c + " }",
       .equal = "difference() { cube(6); translate([3, 3, -1]) cylinder(h = 8, r = 2); }",
       .looks = {{{3, 2, 16}, {3, 3, 0}}}},

      {.name = "what_is_common_to_two_differences",
       .text = "intersection() { difference() { " + a + b + " } difference() { " + a + c + " } }",
       .equal = R"(
           difference() {
             cube(6);
             translate([3, 3, -1]) cube(8);
             translate([3, 3, -1]) cylinder(h = 8, r = 2);
           })",
       .owners = {{3, 4}},
       .looks = {{{3, 2, 16}, {3, 3, 0}}}},

      {.name = "a_in_two_halves",
       .text = R"(
           difference() {
             translate([-4, -4, 0]) cylinder(h = 7, r1 = 3, r2 = 2);
             halfspace(n = [0, 0, 1], d = 3);
           }
           intersection() {
             translate([-4, -4, 0]) cylinder(h = 7, r1 = 3, r2 = 2);
             halfspace(n = [0, 0, 1], d = 3);
           })",
       .equal = "translate([-4, -4, 0]) cylinder(h = 7, r1 = 3, r2 = 2);",
       .owners = {{1, 1, [](Vec3 p) { return p.z > 3; }}, {1, 3, [](Vec3 p) { return p.z < 3; }}},
       .looks = {{{-4, -4, 2}, {-3, -3, 3}, 1}}},

      {.name = "touching_in_a_face",
       .text = R"(
           intersection() { cube(5); translate([5, 1, 1]) cube(3); }
           translate([-6, 0, 0]) intersection() { cylinder(h = 4, r = 2); translate([0, 0, 4]) cylinder(h = 3, r = 1); }
           translate([0, -6, 0]) intersection() { cube(4); halfspace(n = [0, 0, 1], d = 0); }
           translate([-6, -6, 0]) intersection() { cylinder($fn = 6, h = 4, r = 2); translate([0, 0, -2]) sphere($fn = 4, r = 2.82842712474619); })",
       .equal = kNothing,
       .looks = {{{1, 1, 9}, {0, 0, 1}, 1}, {{9, -9, 3}, {0, 0, 1}}}},

      {.name = "touching_in_an_edge_or_a_point",
       .text = R"(
           intersection() { cube(5); translate([5, 5, 0]) cube(5); }
           intersection() { translate([-6, 0, 0]) cube(5); translate([-1, 5, 5]) cube(5); }
           intersection() { translate([0, -8, 0]) sphere(r = 2); translate([0, -4, 0]) sphere(r = 2); }
           intersection() { translate([-6, -7, 0]) cylinder(h = 4, r1 = 2, r2 = 0); translate([-9, -9, 4]) cube(5); })",
       .equal = kNothing,
       .looks = {{{1, 1, 9}, {0, 0, 1}, 1}, {{9, -9, 3}, {0, 0, 1}}}},

      {.name = "halves_taken_away",
       .text = "difference() { cube(8); cube([8, 8, 3]); translate([0, 0, 3]) cube([8, 8, 5]); }",
       .equal = kNothing,
       .looks = {{{3, 3, 20}, {4, 4, 4}}}},

      {.name = "tube_and_core_taken_away",
       .text = R"(
           difference() {
             cylinder(h = 7, r = 5);
             difference() { cylinder(h = 7, r = 5); cylinder(h = 7, r = 3); }
             cylinder(h = 7, r = 3);
           })",
       .equal = kNothing,
       .looks = {{{1, 2, 20}, {0, 0, 4}}, {{1, 0, 3}, {4, 1, 3}, 1}}},

      {.name = "shell_and_core_taken_away",
       .text = R"(
           difference() {
             sphere(r = 5);
             difference() { sphere(r = 5); translate([1, 0, 0]) sphere(r = 3); }
             translate([1, 0, 0]) sphere(r = 3);
           })",
       .equal = kNothing,
       .looks = {{{1, 0, 0}, {4, 1, 3}, 1}}},

      {.name = "film_of_no_thickness",
       .text = "difference() { cube(8); translate([2, 2, 0]) cube([4, 4, 5]); translate([1, 1, 5]) "
               "cube([6, 6, 3]); }",
       .equal = "difference() { cube(8); translate([2, 2, -1]) cube([4, 4, 7]); translate([1, 1, "
                "5]) cube([6, 6, 4]); }",
       .looks = {{{4.2, 4.1, 20}, {4, 4, 4}}, {{4.2, 4.1, -12}, {4, 4, 4}}}},
  };
}

}  // namespace whittle
