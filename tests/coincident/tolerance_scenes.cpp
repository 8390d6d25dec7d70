// Around the tolerance. The models here are about 10 long, so it is 2e-5: films and gaps are either
// a fifth of it, and then are not there, or twenty times as much, and then are. Nearly equal curved
// surfaces stay two, and still no speckle shows.
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "coincident/scenes.h"

namespace whittle {
namespace {

constexpr double kTolerance = 2e-5;

/// An ellipsoid with its axes along the coordinates'.
struct Ellipsoid {
  Vec3 center, radii;

  /// Where the ray is inside, as two distances; not a number if it is nowhere.
  std::array<double, 2> inside(const Ray& ray) const {
    const Vec3 o = divided(ray.origin - center), d = divided(ray.direction);
    // From the point nearest to the centre, where the numbers are of the ellipsoid's own size.
    const double middle = -dot(o, d) / dot(d, d);
    const Vec3 nearest = o + d * middle;
    const double half = std::sqrt((1 - dot(nearest, nearest)) / dot(d, d));
    return {middle - half, middle + half};
  }
  Vec3 normal(Vec3 p) const { return normalize(divided(divided(p - center))); }
  Vec3 divided(Vec3 v) const { return {v.x / radii.x, v.y / radii.y, v.z / radii.z}; }
};

Hit hit_at(const Ray& ray, double t, uint32_t id, const Ellipsoid& e, bool outward = true) {
  const Vec3 n = e.normal(ray.origin + ray.direction * t) * (outward ? 1.0 : -1.0);
  return {float(t), id, {float(n.x), float(n.y), float(n.z)}};
}

/// The union of two ellipsoids around one another's centres, the first one's surface as id 1.
RayFormula either(Ellipsoid a, Ellipsoid b) {
  return [=](const Ray& ray) -> std::optional<Hit> {
    const auto [a0, a1] = a.inside(ray);
    const auto [b0, b1] = b.inside(ray);
    const bool hits_a = a1 > ray.t_min, hits_b = b1 > ray.t_min;
    if (!hits_a && !hits_b) return Hit{};
    if (!hits_b) return hit_at(ray, a0, 1, a);
    if (!hits_a) return hit_at(ray, b0, 2, b);
    const bool from_outside = std::min(a0, b0) > ray.t_min;
    const double ta = from_outside ? a0 : a1, tb = from_outside ? b0 : b1;
    const Vec3 na = a.normal(ray.origin + ray.direction * ta),
               nb = b.normal(ray.origin + ray.direction * tb);
    // Where they cross, either may be seen, and their normals may be told apart.
    if (std::fabs((ta - tb) * dot(na, ray.direction)) < 2 * kTolerance &&
        length(cross(na, nb)) > 5e-4)
      return std::nullopt;
    return from_outside == (ta < tb) ? hit_at(ray, ta, 1, a) : hit_at(ray, tb, 2, b);
  };
}

/// The first without the second, nearly equal one, from outside: a crescent.
RayFormula crescent(Ellipsoid a, Ellipsoid b) {
  return [=](const Ray& ray) -> std::optional<Hit> {
    const auto [a0, a1] = a.inside(ray);
    const auto [b0, b1] = b.inside(ray);
    if (std::isnan(a0)) return Hit{};
    if (std::isnan(b0)) return hit_at(ray, a0, 1, a);
    const auto across = [&](double t, double other) {
      return (other - t) * std::fabs(dot(a.normal(ray.origin + ray.direction * t), ray.direction));
    };
    // How much of A is left before B, and behind it.
    const double before = across(a0, b0), behind = -across(a1, b1);
    if (before > 2 * kTolerance) return hit_at(ray, a0, 1, a);
    if (before > 0) return std::nullopt;
    if (behind > 2 * kTolerance) return hit_at(ray, b1, 2, b, false);
    if (behind > 0) return std::nullopt;
    return Hit{};
  };
}

/// Pairs of curved surfaces that differ by a share d of their radius.
void add_nearly_equal(std::vector<CoincidentScene>& scenes, const char* name, double d) {
  const auto named = [&](const char* what) { return fmt::format("{}_{}", what, name); };
  const double r = 5 * (1 + d);
  // With the smallest d, turning would grow the bounds, and so the tolerance, beyond d.
  const bool turns = d > 1e-5;
  scenes.push_back({.name = named("spheres_that_differ_by"),
                    .text = fmt::format("sphere(r = 5); sphere(r = {:.9g});", r),
                    .equal = fmt::format("sphere(r = {:.9g});", r),
                    .owners = {{1, 2}},
                    .turns = turns});
  scenes.push_back(
      {.name = named("cylinders_that_differ_by"),
       .text = fmt::format("cylinder(h = 10, r = 5); cylinder(h = 10, r = {:.9g});", r),
       .equal = fmt::format("cylinder(h = 10, r = {:.9g});", r),
       .owners = {{1, 1, [](Vec3 p) { return p.z < 0 || p.z > 10; }},
                  {1, 2, [](Vec3 p) { return radius(p) > 4.99; }}},
       .turns = turns});
  scenes.push_back(
      {.name = named("cones_that_differ_by"),
       .text = fmt::format(
           "cylinder(h = 8, r1 = {:.9g}, r2 = {:.9g}); cylinder(h = 8, r1 = 5, r2 = 2);", r,
           2 + 5 * d),
       .equal = fmt::format("cylinder(h = 8, r1 = {:.9g}, r2 = {:.9g});", r, 2 + 5 * d),
       .turns = turns});
  scenes.push_back({.name = named("bores_that_differ_by"),
                    .text = fmt::format(R"(
                        difference() {{
                          cube([10, 10, 8]);
                          translate([5, 5, 4]) cylinder(h = 4, r = 4.5);
                          translate([5, 5, 0]) cylinder(h = 8, r = {:.9g});
                        }})",
                                        4.5 * (1 + d)),
                    .equal = fmt::format("difference() {{ cube([10, 10, 8]); translate([5, 5, -1]) "
                                         "cylinder(h = 10, r = {:.9g}); }}",
                                         4.5 * (1 + d)),
                    .owners = {{2, 3}},
                    .looks = {{{4, 6, 20}, {5, 5, 4}}, {{5, 4, 4}, {8, 7, 4}, 1}},
                    .turns = turns});
  const std::string shell = fmt::format("difference() {{ sphere(r = {:.9g}); sphere(r = 5); }}", r);
  scenes.push_back({.name = named("shell_from_outside"),
                    .text = shell,
                    .equal = fmt::format("sphere(r = {:.9g});", r),
                    .looks = {{{9, -12, 8}, {0, 0, 0}}, {{-5, 2, -5}, {0, 0, 0}}},
                    .only_looks = true,
                    .turns = turns});
  scenes.push_back({.name = named("shell_from_inside"),
                    .text = shell,
                    .equal = "difference() { cube(20, center = true); sphere(r = 5); }",
                    .looks = {{{0, 0, 0}, {1, 2, 3}, 1}, {{3, -2, 2}, {5, 1, -1}, 1}},
                    .only_looks = true,
                    .turns = turns});
  const Ellipsoid ball{{}, {5, 5, 5}}, egg{{}, Vec3{1 + d, 1, 1 - d} * 5.0};
  // Where the two are hardly farther apart than the tolerance, either may own the point.
  const auto egg_is_out_by = [=](Vec3 p) { return 1 / length(egg.divided(normalize(p))) - 5; };
  scenes.push_back({.name = named("egg_through_ball"),
                    .text = fmt::format("sphere(r = 5); scale([{:.9g}, 1, {:.9g}]) sphere(r = 5);",
                                        1 + d, 1 - d),
                    .equal = "",
                    .owners = {{1, 1, [=](Vec3 p) { return egg_is_out_by(p) < 3 * kTolerance; }},
                               {1, 2, [=](Vec3 p) { return egg_is_out_by(p) > -3 * kTolerance; }},
                               {2, 1, [=](Vec3 p) { return egg_is_out_by(p) < 3 * kTolerance; }},
                               {2, 2, [=](Vec3 p) { return egg_is_out_by(p) > -3 * kTolerance; }}},
                    .formula = either(ball, egg),
                    .turns = turns});
  scenes.push_back(
      {.name = named("crescent_of"),
       .text = fmt::format("difference() {{ sphere(r = 5); translate([{:.9g}, 0, 0]) sphere(r = "
                           "5); }}",
                           5 * d),
       .equal = "",
       .looks = {{{20, -12, 8}, {0, 0, 0}}, {{-20, 2, -5}, {0, 0, 0}}, {{1, 20, 1}, {0, 0, 0}}},
       .only_looks = true,
       .formula = crescent(ball, {{5 * d, 0, 0}, {5, 5, 5}}),
       .turns = turns});
}

/// Two hundred strips, each higher than the one before by 0.4 of the tolerance: neighbours may be
/// one surface, but the row is a ramp and must not become a step.
CoincidentScene ramp() {
  CoincidentScene scene{.name = "ramp_of_steps_below_the_tolerance",
                        .text = "",
                        .equal = R"(
           polyhedron(points = [[0, 0, 0], [10, 0, 0], [10, 0, 5.0016], [0, 0, 5],
                                [0, 10, 0], [10, 10, 0], [10, 10, 5.0016], [0, 10, 5]],
                      faces = [[3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5],
                               [2, 3, 7, 6], [3, 0, 4, 7]]);)",
                        // From where the risers, each below a pixel's thousandth, are not seen.
                        .looks = {{{16, 3, 20}, {5, 5, 5}}, {{13, 8, 9}, {5, 5, 5}}},
                        .only_looks = true,
                        .turns = false};
  for (uint32_t i = 0; i < 200; ++i) {
    const double x0 = i * 0.05;
    scene.text += fmt::format("translate([{:.9g}, 0, 0]) cube([0.05, 10, {:.9g}]);\n", x0,
                              5 + i * 0.4 * kTolerance);
    scene.owners.push_back({1, i + 1, [=](Vec3 p) { return p.x >= x0 && p.x <= x0 + 0.05; }});
  }
  return scene;
}

}  // namespace

std::vector<CoincidentScene> tolerance_scenes() {
  std::vector<CoincidentScene> scenes = {
      {.name = "film_too_thin",
       .text = R"(
           difference() {
             cube(10);
             translate([2, 2, -1]) cube([6, 6, 6]);
             translate([2, 2, 5.000004]) cube([6, 6, 6]);
           })",
       .equal = "difference() { cube(10); translate([2, 2, -1]) cube([6, 6, 12]); }",
       .owners = {{2, 2, [](Vec3 p) { return p.z < 5; }}, {2, 3, [](Vec3 p) { return p.z > 5; }}},
       .looks = {{{5, 5, 24}, {5.3, 5.2, 5}}, {{3, 3, 6}, {8, 8, 5}, 1}},
       .turns = false},

      {.name = "film_from_above",
       .text = R"(
           difference() {
             cube(10);
             translate([2, 2, -1]) cube([6, 6, 6]);
             translate([2, 2, 5.0004]) cube([6, 6, 6]);
           })",
       .equal = "difference() { cube(10); translate([2, 2, 5.0004]) cube([6, 6, 6]); }",
       .owners = {{2, 3}},
       .looks = {{{5, 5, 24}, {5.3, 5.2, 5}}, {{3, 3, 6}, {8, 8, 5}, 1}},
       .only_looks = true},

      {.name = "film_from_below",
       .text = R"(
           difference() {
             cube(10);
             translate([2, 2, -1]) cube([6, 6, 6]);
             translate([2, 2, 5.0004]) cube([6, 6, 6]);
           })",
       .equal = "difference() { cube(10); translate([2, 2, -1]) cube([6, 6, 6]); }",
       .looks = {{{5, 5, -14}, {5.3, 5.2, 5}}, {{3, 3, 4}, {8, 8, 5}, 1}},
       .only_looks = true},

      {.name = "gap_too_thin",
       .text = "cube(5); translate([5.000004, 0, 0]) cube(5);",
       .equal = "cube([10.000004, 5, 5]);",
       .owners = {{1, 1, [](Vec3 p) { return p.x < 5; }}, {1, 2, [](Vec3 p) { return p.x > 5; }}},
       .looks = {{{2, 3, 2}, {9, 2, 3}, 1}},
       .turns = false},

      {.name = "gap_from_inside",
       .text = "cube(5); translate([5.0004, 0, 0]) cube(5);",
       .equal = "cube(5);",
       .looks = {{{2, 3, 2}, {9, 2, 3}, 1}, {{4, 1, 4}, {6, 3, 3}, 1}},
       .only_looks = true},

      {.name = "gap_around_a_core_too_thin",
       .text = R"(
           difference() { cylinder(h = 8, r = 5); cylinder(h = 8, r = 3.000004); }
           cylinder(h = 8, r = 3);)",
       .equal = "cylinder(h = 8, r = 5);",
       .owners = {{1, 1, [](Vec3 p) { return radius(p) > 3; }},
                  {1, 3, [](Vec3 p) { return radius(p) < 3; }}},
       .looks = {{{1, 0, 4}, {5, 1, 4}, 1}},
       .turns = false},

      {.name = "gap_around_a_core_from_inside",
       .text = R"(
           difference() { cylinder(h = 8, r = 5); cylinder(h = 8, r = 3.0004); }
           cylinder(h = 8, r = 3);)",
       .equal = "cylinder(h = 8, r = 3);",
       .owners = {{1, 3}},
       .looks = {{{1, 0, 4}, {5, 1, 4}, 1}, {{-2, 1, 1}, {5, 1, 4}, 1}},
       .only_looks = true},

      {.name = "spherical_film_too_thin",
       .text = "difference() { sphere(r = 5); sphere(r = 4.999996); }",
       .equal = kNothing,
       .looks = {{{1, 0, 4}, {5, 1, 4}, 1}},
       .turns = false},

      // What was written on one plane stays on one, whatever some of it lies on: the block's bottom
      // would lie on the stranger's, the thin drill's own tolerance forbids it.
      {.name = "stranger_beside_a_thin_drill",
       .text = R"(
           translate([12, 0, 1]) cube(1);
           difference() {
             translate([0, 0, 1.00002]) cube([10, 10, 2]);
             translate([5, 5, 1.00002]) cylinder(h = 2, r = 0.005);
           })",
       .equal = R"(
           translate([12, 0, 1]) cube(1);
           difference() {
             translate([0, 0, 1.00002]) cube([10, 10, 2]);
             translate([5, 5, 0]) cylinder(h = 4, r = 0.005);
           })",
       .looks = {{{5, 5, 10}, {5, 5, 0}, 0.002}, {{5, 5, -6}, {5, 5, 1}, 0.002}},
       .only_looks = true,
       .turns = false},

      // Over the drill the stranger's slanted bottom is within the tolerance, over the block not.
      {.name = "slanted_stranger",
       .text = R"(
           translate([5, 5, 1]) multmatrix([[1, 0, 5e-6, 0], [0, 1, 0, 0], [-5e-6, 0, 1, 0]])
             translate([2, 0, 0]) cube([2, 2, 1]);
           difference() {
             translate([0, 0, 1]) cube([10, 10, 2]);
             translate([5, 5, 1]) cylinder(h = 2, r = 0.01);
           })",
       .equal = R"(
           difference() {
             translate([0, 0, 1]) cube([10, 10, 2]);
             translate([5, 5, 0]) cylinder(h = 4, r = 0.01);
           })",
       .owners = {{1, 2}, {2, 3}},
       .looks = {{{5, 5, 10}, {5, 5, 0}, 0.004}, {{5, 5, -6}, {5, 5, 1}, 0.004}},
       .only_looks = true,
       .turns = false},

      // The drill's bottom is the thin stranger's, which the block's cannot be by the stranger's
      // own tolerance; but by the drill's.
      {.name = "thin_stranger",
       .text = R"(
           translate([0.5, 0.5, 1.00001]) cube([1, 1, 0.002]);
           difference() {
             translate([0, 0, 1]) cube([10, 10, 2]);
             translate([5, 5, 1.00001]) cylinder(h = 9, r = 3);
           })",
       .equal = R"(
           difference() {
             translate([0, 0, 1]) cube([10, 10, 2]);
             translate([5, 5, 0]) cylinder(h = 9, r = 3);
           })",
       .owners = {{1, 2}, {2, 3}},
       .looks = {{{5, 5, 10}, {5, 5, 0}}, {{12, 11, 9}, {5, 5, 1}}, {{5, 5, -6}, {5, 5, 1}, 0.4}},
       .only_looks = true,
       .turns = false},

      // A wall that is too near for the thin disc and not for the cylinder: no film closes the
      // slot.
      {.name = "stranger_beside_a_thin_disc",
       .text = R"(
           translate([0, 0, 20]) cylinder(h = 1, r = 5.00001);
           difference() { cylinder(h = 10, r = 5); translate([0, 0, 4]) cylinder(h = 0.005, r = 5); })",
       .equal = R"(
           translate([0, 0, 20]) cylinder(h = 1, r = 5.00001);
           cylinder(h = 4, r = 5.00001);
           translate([0, 0, 4.005]) cylinder(h = 5.995, r = 5.00001);)",
       .owners = {{2, 2, below(3.9999)},
                  {2, 2, above(3.9999)},
                  {2, 3, above(3.9999)},
                  {3, 2, above(4.0051)},
                  {3, 2, below(4.0051)},
                  {3, 3, below(4.0051)}},
       .looks = {{{30, 0, 4.0025}, {0, 0, 4.0025}, 0.0002}, {{30, 5, 12}, {0, 0, 5}}},
       .only_looks = true,
       .turns = false},

      ramp(),
  };
  add_nearly_equal(scenes, "1e_5", 1e-5);
  add_nearly_equal(scenes, "1e_4", 1e-4);
  add_nearly_equal(scenes, "1e_3", 1e-3);
  return scenes;
}

}  // namespace whittle
