#include "support/zoo.h"

#include <cmath>

#include <fmt/format.h>

namespace whittle {

namespace {

constexpr Vec3 kX{1, 0, 0}, kY{0, 1, 0}, kZ{0, 0, 1};

KnownRay miss(Vec3 eye, Vec3 direction) {
  return {eye, direction, 0, kInfinity, {}};
}

std::string moved(const char* x, const char* y, const char* z, const std::string& what) {
  return fmt::format(
      "multmatrix([[1, 0, 0, {}], [0, 1, 0, {}], [0, 0, 1, {}], [0, 0, 0, 1]]) {{ {} }}", x, y, z,
      what);
}

const char* const kSmooth = "$fn = 0, $fa = 12, $fs = 2";

std::string sphere(const char* r) {
  return fmt::format("sphere({}, r = {});", kSmooth, r);
}
std::string cylinder(const char* h, const char* r1, const char* r2) {
  return fmt::format("cylinder({}, h = {}, r1 = {}, r2 = {}, center = false);", kSmooth, h, r1, r2);
}
std::string cube(const char* size) {
  return fmt::format("cube(size = {}, center = false);", size);
}
const char* const kCube10 = "cube(size = [10, 10, 10], center = false);";

void add_primitives(std::vector<ZooScene>& zoo) {
  const double root_half = std::sqrt(0.5), root_3_4 = std::sqrt(0.75);
  zoo.push_back({"sphere",
                 sphere("5"),
                 {{{0, -20, 0}, kY, 1, 15, -kY},
                  {{3, -20, 0}, kY, 1, 16, {3, -4, 0}},
                  {{0, 0, 0}, kX, 1, 5, kX},
                  {{1, 1, 1}, kZ, 1, std::sqrt(23.0) - 1, {1, 1, std::sqrt(23.0)}},
                  miss({0, -20, 5.001}, kY)}});
  zoo.push_back({"cube",
                 kCube10,
                 {{{5, -10, 5}, kY, 1, 10, -kY},
                  {{5, 5, 5}, kY, 1, 5, kY},
                  {{5, 5, 30}, -kZ, 1, 20, kZ},
                  {{-1, 5, 5.5}, {1, 0, 1}, 1, std::sqrt(2.0), -kX},
                  miss({5, -10, 10.001}, kY)}});
  zoo.push_back({"cylinder",
                 cylinder("10", "3", "3"),
                 {{{-20, 0, 5}, kX, 1, 17, -kX},
                  {{1, 2, 30}, -kZ, 1, 20, kZ},
                  {{0, 0, 5}, -kZ, 1, 5, -kZ},
                  {{0, 0, 30}, -kZ, 1, 20, kZ},
                  miss({-20, 0, 10.001}, kX),
                  miss({-20, 3.001, 5}, kX)}});
  // Slope -1/2: the side's normal is (cos, sin, 1/2).
  zoo.push_back({"cone",
                 cylinder("10", "5", "0"),
                 {{{-20, 0, 5}, kX, 1, 17.5, {-1, 0, 0.5}},
                  {{1, 0, 30}, -kZ, 1, 22, {1, 0, 0.5}},
                  {{1, 0, -30}, kZ, 1, 30, -kZ},
                  {{0, 0, -7}, kZ, 1, 7, -kZ},
                  miss({-20, 0, 12}, kX),
                  miss({-20, 0, -1}, kX)}});
  // Rays inside the solid and along its generators; the other nappe begins above z = 10.
  zoo.push_back({"cone_from_inside",
                 cylinder("10", "5", "0"),
                 {{{0, 0, 1}, {0.5, 0, 1}, 1, 4.5 * std::sqrt(1.25), {1, 0, 0.5}},
                  {{0, 0, 1}, {-0.5, 0, 1}, 1, 4.5 * std::sqrt(1.25), {-1, 0, 0.5}},
                  {{-1, 0, 1}, {0.5, 0, -1}, 1, std::sqrt(1.25), -kZ},
                  miss({0, 0, 11}, {0.3, 0, 1})}});
  zoo.push_back({"frustum",
                 cylinder("4", "1", "3"),
                 {{{-20, 0, 2}, kX, 1, 18, {-1, 0, -0.5}},
                  {{2, 0, -10}, kZ, 1, 12, {1, 0, -0.5}},
                  {{2, 0, 10}, -kZ, 1, 6, kZ}}});
  zoo.push_back({"ellipsoid",
                 "multmatrix([[3, 0, 0, 0], [0, 2, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) { " +
                     sphere("1") + " }",
                 {{{-20, 0, 0}, kX, 1, 17, -kX},
                  {{0, -20, 0}, kY, 1, 18, -kY},
                  // At x = 3 / 2 the height is sqrt(3) / 2; the gradient is (x / 9, y / 4, z).
                  {{1.5, 0, 10}, -kZ, 1, 10 - root_3_4, {1.5 / 9, 0, root_3_4}}}});
  // x' = x + y / 2: the side x = 0 becomes the plane x' = y / 2.
  zoo.push_back({"sheared_cube",
                 "multmatrix([[1, 0.5, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) { " +
                     std::string(kCube10) + " }",
                 {{{-10, 4, 5}, kX, 1, 12, {-1, 0.5, 0}},
                  {{30, 4, 5}, -kX, 1, 18, {1, -0.5, 0}},
                  {{6, -10, 5}, kY, 1, 10, -kY},
                  miss({5.5, -10, 5}, {0.5, 1, 0})}});
  zoo.push_back({"mirrored_cone",
                 "multmatrix([[-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, 2], [0, 0, 0, 1]]) { " +
                     cylinder("10", "5", "0") + " }",
                 {{{-20, 0, -3}, kX, 1, 17.5, {-1, 0, -0.5}},
                  {{1, 0, 30}, -kZ, 1, 28, kZ},
                  {{1, 0, -30}, kZ, 1, 24, {1, 0, -0.5}}}});
  // Two rings at 45 degrees and no poles: a square box with one band.
  zoo.push_back({"facetted_sphere",
                 "sphere($fn = 4, $fa = 12, $fs = 2, r = 1);",
                 {{{0.1, 0.1, 10}, -kZ, 1, 10 - root_half, kZ},
                  {{0.25, -10, 0}, kY, 1, 10 - root_half + 0.25, {1, -1, 0}},
                  miss({0.72, 0, 10}, -kZ)}});
  zoo.push_back({"facetted_cylinder",
                 "cylinder($fn = 6, $fa = 12, $fs = 2, h = 2, r1 = 4, r2 = 4, center = true);",
                 {{{0, -10, 0}, kY, 1, 10 - 4 * root_3_4, -kY},
                  {{1, -10, 0.5}, kY, 1, 10 - 4 * root_3_4, -kY},
                  {{1, 1, 10}, -kZ, 1, 9, kZ}}});
  zoo.push_back({"facetted_pyramid",
                 "cylinder($fn = 4, $fa = 12, $fs = 2, h = 2, r1 = 2, r2 = 0, center = false);",
                 {{{0.5, 0.5, 10}, -kZ, 1, 9, {1, 1, 1}}, {{0.5, 0.5, -10}, kZ, 1, 10, -kZ}}});
  zoo.push_back({"octahedron",
                 "polyhedron(points = [[2, 0, 0], [0, 2, 0], [-2, 0, 0], [0, -2, 0], [0, 0, 2], "
                 "[0, 0, -2]], faces = [[0, 4, 1], [1, 4, 2], [2, 4, 3], [3, 4, 0], [1, 5, 0], "
                 "[2, 5, 1], [3, 5, 2], [0, 5, 3]], convexity = 1);",
                 {{{0.5, 0.5, 10}, -kZ, 1, 9, {1, 1, 1}},
                  {{0.5, -0.5, -10}, kZ, 1, 9, {1, -1, -1}},
                  miss({1.2, 0.9, 10}, -kZ)}});
}

void add_halfspaces(std::vector<ZooScene>& zoo) {
  zoo.push_back({"halfspace",
                 "halfspace(n = [0, 0, 2], d = 6);",
                 {{{7, 8, 10}, -kZ, 1, 7, kZ},
                  {{7, 8, -10}, kZ, 1, 13, kZ},
                  {{0, 0, 10}, {0.6, 0, -0.8}, 1, 8.75, kZ},
                  miss({0, 0, 10}, kX)}});
  zoo.push_back({"halfspace_wedge",
                 "intersection() { halfspace(n = [1, 0, 1], d = 0); halfspace(n = [-1, 0, 1], d = "
                 "0); sphere($fn = 0, $fa = 12, $fs = 2, r = 10); }",
                 {{{2, 0, 20}, -kZ, 1, 22, {1, 0, 1}},
                  {{-2, 0, 20}, -kZ, 2, 22, {-1, 0, 1}},
                  {{0, 0, -20}, kZ, 3, 10, -kZ}}});
  zoo.push_back({"halfspace_minus_sphere",
                 "difference() { halfspace(n = [0, 0, 1], d = 0); " + sphere("4") + " }",
                 {{{0, 0, 20}, -kZ, 2, 24, kZ}, {{5, 0, 20}, -kZ, 1, 20, kZ}}});
}

void add_operators(std::vector<ZooScene>& zoo) {
  zoo.push_back(
      {"lens",
       "intersection() { " + moved("-3", "0", "0", sphere("5")) +
           moved("3", "0", "0", sphere("5")) + " }",
       {{{-20, 0, 0}, kX, 2, 18, -kX}, {{20, 0, 0}, -kX, 1, 18, kX}, miss({0, -20, 4.01}, kY)}});
  zoo.push_back({"drilled_cube",
                 "difference() { " + std::string(kCube10) +
                     moved("5", "5", "-1", cylinder("12", "3", "3")) + " }",
                 {{{5, -10, 5}, kY, 1, 10, -kY},
                  // The wall of the hole: outward is towards its axis.
                  {{5, 5, 20}, {1, 0, -4}, 2, 3 * std::sqrt(17.0), -kX},
                  miss({5, 5, 20}, -kZ),
                  // An eye inside the drill is in empty space.
                  {{5, 5, 5}, kX, 2, 3, -kX},
                  miss({5, 5, 5}, kZ)}});
  zoo.push_back(
      {"difference_of_difference",
       "difference() { " + sphere("9") + " difference() { " + sphere("6") + sphere("3") + " } }",
       {{{0, 0, 0}, kX, 3, 3, kX},
        {{4, 0, 0}, kX, 2, 2, -kX},
        {{4, 0, 0}, -kX, 3, 1, kX},
        {{20, 0, 0}, -kX, 1, 11, kX}}});
  zoo.push_back({"colours_and_groups",
                 "color([1, 0, 0, 1]) { group() { color([0, 1, 0, 1]) { " + sphere("2") +
                     " } render(convexity = 1) { " + moved("5", "0", "0", sphere("2")) + " } } }",
                 {{{0, -9, 0}, kY, 1, 7, -kY}, {{5, -9, 0}, kY, 2, 7, -kY}}});
  zoo.push_back({"empty_minuend",
                 "difference() { group(); " + std::string(kCube10) + " }",
                 {miss({5, 5, 20}, -kZ)}});
  zoo.push_back({"empty_factor",
                 "intersection() { " + std::string(kCube10) + sphere("0") + " }",
                 {miss({5, 5, 20}, -kZ)}});
  zoo.push_back({"background_minuend",
                 "difference() { %" + sphere("20") + kCube10 + cube("[5, 5, 20]") + " }",
                 {{{7, 7, 20}, -kZ, 2, 10, kZ}, miss({2, 2, 20}, -kZ)}});
  std::string deep = cube("[1, 1, 1]");
  for (int i = 0; i < 500; ++i) deep = (i % 2 ? "difference() { " : "union() { ") + deep + " }";
  zoo.push_back({"deep", deep, {{{0.5, 0.5, 5}, -kZ, 1, 4, kZ}}});
  std::string many;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      many += moved(std::to_string(3 * i).c_str(), std::to_string(3 * j).c_str(), "0", sphere("2"));
  zoo.push_back(
      {"many_spheres", many, {{{0, 0, 9}, -kZ, 1, 7, kZ}, {{15, 15, 9}, -kZ, 36, 7, kZ}}});
}

void add_coincident(std::vector<ZooScene>& zoo) {
  zoo.push_back(
      {"flush_pocket",
       "difference() { " + std::string(kCube10) + moved("2", "2", "5", cube("[6, 6, 5]")) + " }",
       {{{5, 5, 20}, -kZ, 2, 15, kZ},
        {{1, 5, 20}, -kZ, 1, 10, kZ},
        {{3, 5, 14}, {-1, 0, -6}, 2, std::sqrt(37.0), kX},
        {{5, 5, 7}, kX, 2, 3, -kX}}});
  zoo.push_back(
      {"shared_face",
       "union() { " + std::string(kCube10) + moved("10", "0", "0", kCube10) + " }",
       {{{-5, 5, 5}, kX, 1, 5, -kX}, {{5, 5, 5}, kX, 2, 15, kX}, {{25, 5, 5}, -kX, 2, 5, kX}}});
  zoo.push_back({"same_face_twice",
                 "union() { " + std::string(kCube10) + cube("[5, 5, 10]") + " } " + kCube10,
                 {{{2, 2, 20}, -kZ, 1, 10, kZ}, {{7, 7, 20}, -kZ, 1, 10, kZ}}});
  zoo.push_back({"cutter_on_top",
                 "difference() { " + std::string(kCube10) + moved("0", "0", "10", kCube10) + " }",
                 {{{5, 5, 30}, -kZ, 1, 20, kZ}, {{5, 5, 5}, kZ, 1, 5, kZ}}});
  zoo.push_back(
      {"cutters_sharing_a_wall",
       "difference() { " + std::string(kCube10) + moved("2", "2", "-1", cube("[3, 6, 12]")) +
           moved("5", "2", "-1", cube("[3, 6, 12]")) + " }",
       {{{3, 5, 5}, kX, 3, 5, -kX}, {{7, 5, 5}, -kX, 2, 5, kX}, {{5.5, 3, 5}, -kY, 3, 1, kY}}});
  zoo.push_back({"minus_itself",
                 "difference() { " + std::string(kCube10) + kCube10 + " }",
                 {miss({5, 5, 30}, -kZ), miss({5, 5, 5}, kX)}});
  zoo.push_back({"touching_only",
                 "intersection() { " + std::string(kCube10) + moved("10", "0", "0", kCube10) + " }",
                 {miss({-5, 5, 5}, kX)}});
  // The tolerance is 2e-5: thinner than that is nothing, thicker is something.
  zoo.push_back(
      {"thin_film_gone",
       "difference() { " + std::string(kCube10) + moved("0", "0", "-0.00001", kCube10) + " }",
       {miss({5, 5, 30}, -kZ), miss({5, 5, -30}, kZ)}});
  zoo.push_back(
      {"thin_film_stays",
       "difference() { " + std::string(kCube10) + moved("0", "0", "-0.001", kCube10) + " }",
       {{{5, 5, 30}, -kZ, 1, 20, kZ}, {{5, 5, -30}, kZ, 2, 39.999, -kZ}}});
  // A third of 10 in six digits leaves gaps of 1e-5 between what should touch.
  zoo.push_back({"six_digit_walls",
                 "union() { " + cube("[3.33333, 3.33333, 3.33333]") +
                     moved("3.33333", "0", "0", cube("[3.33333, 3.33333, 3.33333]")) +
                     moved("6.66667", "0", "0", cube("[3.33333, 3.33333, 3.33333]")) + " }",
                 {{{-5, 1, 1}, kX, 1, 5, -kX}, {{1, 1, 1}, kX, 3, 9, kX}}});
}

void add_sizes(std::vector<ZooScene>& zoo) {
  zoo.push_back({"planet_and_pebble",
                 sphere("1000") + moved("0", "0", "1001", sphere("0.5")),
                 {{{0, 0, 1010}, -kZ, 2, 8.5, kZ}, {{0, -3000, 0}, kY, 1, 2000, -kY}}});
  zoo.push_back({"long_thin_cylinder",
                 cylinder("1000", "0.01", "0.01"),
                 {{{-5, 0, 999}, kX, 1, 4.99, -kX}, {{0, -5, 1}, kY, 1, 4.99, -kY}}});
  zoo.push_back({"far_from_the_origin",
                 moved("10000", "10000", "0",
                       "difference() { " + std::string(kCube10) +
                           moved("5", "5", "-1", cylinder("12", "1", "1")) + " }"),
                 {{{10002, 10002, 20}, -kZ, 1, 10, kZ},
                  {{10005, 10005, 5}, kX, 2, 1, -kX},
                  miss({10005, 10005, 20}, -kZ)}});
}

}  // namespace

std::vector<ZooScene> zoo() {
  std::vector<ZooScene> scenes;
  add_primitives(scenes);
  add_halfspaces(scenes);
  add_operators(scenes);
  add_coincident(scenes);
  add_sizes(scenes);
  return scenes;
}

}  // namespace whittle
