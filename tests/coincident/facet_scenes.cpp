// Flat-faced solids that share faces by different routes: polyhedra, curves of facets, half-spaces.
#include <cmath>

#include "coincident/scenes.h"

namespace whittle {
std::vector<CoincidentScene> facet_scenes() {
  return {
      {.name = "house",
       .text = R"(
           cube([6, 8, 4]);
           polyhedron(points = [[0, 0, 4], [6, 0, 4], [3, 0, 7], [0, 8, 4], [6, 8, 4], [3, 8, 7]],
                      faces = [[0, 2, 1], [3, 4, 5], [0, 1, 4, 3], [1, 2, 5, 4], [2, 0, 3, 5]]);)",
       .equal = R"(
           polyhedron(points = [[0, 0, 0], [6, 0, 0], [6, 0, 4], [3, 0, 7], [0, 0, 4],
                                [0, 8, 0], [6, 8, 0], [6, 8, 4], [3, 8, 7], [0, 8, 4]],
                      faces = [[4, 3, 2, 1, 0], [5, 6, 7, 8, 9], [0, 1, 6, 5], [1, 2, 7, 6],
                               [2, 3, 8, 7], [3, 4, 9, 8], [4, 0, 5, 9]]);)",
       .owners = {{1, 1, below(4)}, {1, 2, above(4)}},
       .looks = {{{3, 4, 2}, {4, 8, 5}, 1}}},

      {.name = "two_wedges",
       .text = R"(
           polyhedron(points = [[0, 0, 0], [6, 0, 0], [6, 0, 6], [0, 6, 0], [6, 6, 0], [6, 6, 6]],
                      faces = [[0, 2, 1], [3, 4, 5], [0, 1, 4, 3], [1, 2, 5, 4], [2, 0, 3, 5]]);
           polyhedron(points = [[0, 0, 0], [0, 0, 6], [6, 0, 6], [0, 6, 0], [0, 6, 6], [6, 6, 6]],
                      faces = [[0, 1, 2], [3, 5, 4], [1, 0, 3, 4], [2, 1, 4, 5], [0, 2, 5, 3]]);)",
       .equal = "cube(6);",
       .owners = {{1, 1, [](Vec3 p) { return p.x > p.z; }},
                  {1, 2, [](Vec3 p) { return p.x < p.z; }}}},

      {.name = "six_pyramids_to_the_middle",
       .text = R"(
           polyhedron(points = [[0, 0, 0], [-4, -4, -4], [4, -4, -4], [4, 4, -4], [-4, 4, -4]],
                      faces = [[1, 2, 3, 4], [0, 2, 1], [0, 3, 2], [0, 4, 3], [0, 1, 4]]);
           rotate([180, 0, 0])
           polyhedron(points = [[0, 0, 0], [-4, -4, -4], [4, -4, -4], [4, 4, -4], [-4, 4, -4]],
                      faces = [[1, 2, 3, 4], [0, 2, 1], [0, 3, 2], [0, 4, 3], [0, 1, 4]]);
           rotate([90, 0, 0])
           polyhedron(points = [[0, 0, 0], [-4, -4, -4], [4, -4, -4], [4, 4, -4], [-4, 4, -4]],
                      faces = [[1, 2, 3, 4], [0, 2, 1], [0, 3, 2], [0, 4, 3], [0, 1, 4]]);
           rotate([-90, 0, 0])
           polyhedron(points = [[0, 0, 0], [-4, -4, -4], [4, -4, -4], [4, 4, -4], [-4, 4, -4]],
                      faces = [[1, 2, 3, 4], [0, 2, 1], [0, 3, 2], [0, 4, 3], [0, 1, 4]]);
           rotate([0, 90, 0])
           polyhedron(points = [[0, 0, 0], [-4, -4, -4], [4, -4, -4], [4, 4, -4], [-4, 4, -4]],
                      faces = [[1, 2, 3, 4], [0, 2, 1], [0, 3, 2], [0, 4, 3], [0, 1, 4]]);
           rotate([0, -90, 0])
           polyhedron(points = [[0, 0, 0], [-4, -4, -4], [4, -4, -4], [4, 4, -4], [-4, 4, -4]],
                      faces = [[1, 2, 3, 4], [0, 2, 1], [0, 3, 2], [0, 4, 3], [0, 1, 4]]);)",
       .equal = "cube(8, center = true);",
       .owners = {{1, 1, below(-4)},
                  {1, 2, above(4)},
                  {1, 3, [](Vec3 p) { return p.y > 4; }},
                  {1, 4, [](Vec3 p) { return p.y < -4; }},
                  {1, 5, [](Vec3 p) { return p.x < -4; }},
                  {1, 6, [](Vec3 p) { return p.x > 4; }}}},

      {.name = "box_of_triangles_on_box",
       .text = R"(
           cube([5, 6, 7]);
           polyhedron(points = [[0, 0, 0], [5, 0, 0], [5, 6, 0], [0, 6, 0],
                                [0, 0, 7], [5, 0, 7], [5, 6, 7], [0, 6, 7]],
                      faces = [[0, 1, 2], [0, 2, 3], [4, 6, 5], [4, 7, 6], [0, 5, 1], [0, 4, 5],
                               [1, 6, 2], [1, 5, 6], [2, 7, 3], [2, 6, 7], [3, 4, 0], [3, 7, 4]]);)",
       .equal = "cube([5, 6, 7]);"},

      {.name = "pyramid_pocket",
       .text = R"(
           difference() {
             cube(8);
             polyhedron(points = [[4, 4, 2], [1, 1, 8], [7, 1, 8], [7, 7, 8], [1, 7, 8]],
                        faces = [[4, 3, 2, 1], [0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]]);
           })",
       .equal = R"(
           difference() {
             cube(8);
             polyhedron(points = [[4, 4, 2], [0, 0, 10], [8, 0, 10], [8, 8, 10], [0, 8, 10]],
                        faces = [[4, 3, 2, 1], [0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]]);
           })",
       .looks = {{{3, 5, 20}, {4, 4, 5}}}},

      {.name = "octahedron_in_box",
       .text = R"(
           intersection() {
             cube(6, center = true);
             polyhedron(points = [[5, 0, 0], [0, 5, 0], [-5, 0, 0], [0, -5, 0], [0, 0, 5],
                                  [0, 0, -5]],
                        faces = [[0, 4, 1], [1, 4, 2], [2, 4, 3], [3, 4, 0],
                                 [1, 5, 0], [2, 5, 1], [3, 5, 2], [0, 5, 3]]);
             sphere($fn = 0, r = 9);
             cube([6, 8, 6], center = true);
           })",
       .equal = R"(
           intersection() {
             cube(6, center = true);
             polyhedron(points = [[5, 0, 0], [0, 5, 0], [-5, 0, 0], [0, -5, 0], [0, 0, 5],
                                  [0, 0, -5]],
                        faces = [[0, 4, 1], [1, 4, 2], [2, 4, 3], [3, 4, 0],
                                 [1, 5, 0], [2, 5, 1], [3, 5, 2], [0, 5, 3]]);
           })"},

      {.name = "prism_minus_equal_polyhedron",
       .text = R"(
           difference() {
             cylinder($fn = 6, h = 8, r = 4);
             polyhedron(points = [[4, 0, 3], [2, 3.4641, 3], [-2, 3.4641, 3],
                                  [-4, 0, 3], [-2, -3.4641, 3], [2, -3.4641, 3],
                                  [4, 0, 8], [2, 3.4641, 8], [-2, 3.4641, 8],
                                  [-4, 0, 8], [-2, -3.4641, 8], [2, -3.4641, 8]],
                        faces = [[0, 1, 2, 3, 4, 5], [11, 10, 9, 8, 7, 6], [0, 6, 7, 1],
                                 [1, 7, 8, 2], [2, 8, 9, 3], [3, 9, 10, 4], [4, 10, 11, 5],
                                 [5, 11, 6, 0]]);
           })",
       .equal = "intersection() { cylinder($fn = 6, h = 8, r = 4); halfspace(n = [0, 0, 1], d = "
                "3); }"},

      {.name = "stacked_heptagons",
       .text = "cylinder($fn = 7, h = 4, r = 4); translate([0, 0, 4]) cylinder($fn = 7, h = 4, r = "
               "4);",
       .equal = "cylinder($fn = 7, h = 8, r = 4);",
       .owners = {{1, 1, below(4)}, {1, 2, above(4)}}},

      {.name = "facetted_bores_turned_by_a_facet",
       .text = R"(
           difference() {
             cube(10, center = true);
             translate([0, 0, -5]) cylinder($fn = 8, h = 5, r = 3);
             rotate([0, 0, 45]) cylinder($fn = 8, h = 5, r = 3);
           })",
       .equal = R"(
           difference() {
             cube(10, center = true);
             cylinder($fn = 8, h = 12, r = 3, center = true);
           })",
       .owners = {{2, 2, below(0)}, {2, 3, above(0)}},
       .looks = {{{1, 2, 20}, {0, 0, 0}}, {{0, 0, 0}, {2, 3, 1}, 1}}},

      {.name = "facetted_sphere_turned_by_a_facet",
       .text = "rotate([0, 0, 30]) sphere($fn = 12, r = 5); sphere($fn = 12, r = 5);",
       .equal = "sphere($fn = 12, r = 5);"},

      {.name = "facetted_ball_in_its_seat",
       .text = R"(
           difference() {
             translate([-5, -5, -6]) cube([10, 10, 6]);
             sphere($fn = 10, r = 4);
           }
           rotate([0, 0, 36]) sphere($fn = 10, r = 4);)",
       .equal = "translate([-5, -5, -6]) cube([10, 10, 6]); sphere($fn = 10, r = 4);",
       .owners = {{2, 3}},
       .looks = {{{0, 0, -1}, {1, 2, -4}, 1}}},

      {.name = "facetted_cone_continued",
       .text = "cylinder($fn = 9, h = 2, r1 = 5, r2 = 4); translate([0, 0, 2]) cylinder($fn = 9, h "
               "= 6, r1 = 4, r2 = 1);",
       .equal = "cylinder($fn = 9, h = 8, r1 = 5, r2 = 1);",
       .owners = {{1, 1, below(2)}, {1, 2, above(2)}}},

      {.name = "halfspaces_on_faces",
       .text = R"(
           difference() {
             intersection() { cube(9); halfspace(n = [0, 0, 2], d = 18); }
             halfspace(n = [1, 0, 0], d = 0);
             halfspace(n = [0, -1, 0], d = -9);
           })",
       .equal = "cube(9);"},

      {.name = "halfspaces_first",
       .text = R"(
           intersection() {
             halfspace(n = [0, 0, 1], d = 9);
             halfspace(n = [-2, 0, 0], d = 0);
             cube(9);
           })",
       .equal = "cube(9);",
       .owners = {{1, 1, above(9)},
                  {1, 2, [](Vec3 p) { return p.x < 0; }},
                  {1, 3, [](Vec3 p) { return p.x > 9 || p.y < 0 || p.y > 9 || p.z < 0; }}}},

      {.name = "box_on_the_ground",
       .text = "halfspace(n = [0, 0, 1], d = 0); translate([-2, -3, 0]) cube([4, 6, 5]);",
       .equal = "halfspace(n = [0, 0, 1], d = 0); translate([-2, -3, -4]) cube([4, 6, 9]);",
       .looks = {{{8, -9, 12}, {0, 0, 0}}, {{-7, 9, 9}, {0, 0, 0}}, {{0, 0, 2}, {1, 2, -1}, 1}},
       .only_looks = true},

      {.name = "pit_in_the_ground",
       .text = R"(
           difference() {
             halfspace(n = [0, 0, 1], d = 0);
             translate([-2, -3, -5]) cube([4, 6, 5]);
             translate([-2, 3, -3]) cube([4, 2, 3]);
           })",
       .equal = R"(
           difference() {
             halfspace(n = [0, 0, 1], d = 0);
             translate([-2, -3, -5]) cube([4, 6, 9]);
             translate([-2, 2, -3]) cube([4, 3, 6]);
           })",
       .owners = {{3, 3, [](Vec3 p) { return p.y > 3; }}},
       .looks = {{{4, -9, 12}, {0, 0, 0}}, {{-3, 9, 9}, {0, 0, 0}}, {{0, 0, -2}, {1, 2, -4}, 1}},
       .only_looks = true},
  };
}

}  // namespace whittle
