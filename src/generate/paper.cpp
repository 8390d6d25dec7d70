// The models of the paper's Figures 12 and 13. Their texts were never published; these follow the
// captions and pictures, with sizes chosen so that about half of the body is cut away at any N.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "generate/models.h"

namespace whittle {
namespace {

// A body that loses the share s to cutters thrown at random keeps exp(-N v / V): N v = kCutVolume
// V.
constexpr double kCutVolume = 0.7;  // -ln(1 - 0.5)

constexpr double kBodyRadius = 50, kBodyHeight = 50;
constexpr double kBodyVolume = std::numbers::pi * kBodyRadius * kBodyRadius * kBodyHeight;

/// By Newton's method, which rounds alike everywhere; std::cbrt need not. Precondition: x > 0.
double cube_root(double x) {
  double root = x > 1 ? x : 1;
  for (int i = 0; i < 200; ++i) root = (2 * root + x / (root * root)) / 3;
  return root;
}

/// A point of the body, uniform.
Vec3 point_in_body(Chance& chance) {
  double x, y;
  do {
    x = chance.between(-1, 1), y = chance.between(-1, 1);
  } while (x * x + y * y > 1);
  return {x * kBodyRadius, y * kBodyRadius, chance.between(0, kBodyHeight)};
}

/// `rotate(...)` to some direction. The tilt is not quite uniform over the sphere (it favours the
/// poles); uniform would take an arc cosine, which does not round alike everywhere.
std::string any_direction(Chance& chance) {
  const double tilt = chance.between(0, 180), turn = chance.between(0, 360);
  return "rotate(" + vector({0, tilt, turn}) + ")";
}

std::string body() {
  return "cylinder(h = " + number(kBodyHeight) + ", r = " + number(kBodyRadius) + ");";
}

}  // namespace

void generate_cheese(CsgText& out, int spheres, Chance chance) {
  // Radii are `scale` times 0.5 to 1.1; the mean of u^3 over that range is 0.584.
  const double mean_volume = 4 * std::numbers::pi / 3 * 0.584;
  const double scale = cube_root(kCutVolume * kBodyVolume / (mean_volume * spheres));
  out.comment("");
  out.open("color([1, 0.83, 0.4, 1]) difference()");
  out.line(body());
  for (int i = 0; i < spheres; ++i) {
    const Vec3 p = point_in_body(chance);
    const double r = scale * chance.between(0.5, 1.1);
    out.line("translate(" + vector(p) + ") sphere(r = " + number(r) + ");");
  }
  out.close();
}

void generate_cyl(CsgText& out, int cylinders, Chance chance) {
  // Drills of length 70, of which about three quarters lie in the body; u^2 has mean 0.84.
  constexpr double kLength = 70, kShareInside = 0.75;
  const double scale = std::sqrt(kCutVolume * kBodyVolume /
                                 (cylinders * std::numbers::pi * 0.84 * kLength * kShareInside));
  out.comment("");
  out.open("difference()");
  out.line(body());
  for (int i = 0; i < cylinders; ++i) {
    const Vec3 p = point_in_body(chance);
    const std::string turn = any_direction(chance);
    const double r = scale * chance.between(0.6, 1.2);
    out.line("translate(" + vector(p) + ") " + turn + " cylinder(h = " + number(kLength) +
             ", r = " + number(r) + ", center = true);");
  }
  out.close();
}

void generate_cone(CsgText& out, int cones, Chance chance) {
  // Three times as high as wide at the base; the volume is pi r^3.
  constexpr double kHeight = 3;
  const double mean_volume = std::numbers::pi * 0.584;
  const double scale = cube_root(kCutVolume * kBodyVolume / (mean_volume * cones));
  out.comment("");
  out.open("difference()");
  out.line(body());
  for (int i = 0; i < cones; ++i) {
    const Vec3 p = point_in_body(chance);
    const std::string turn = any_direction(chance);
    const double r = scale * chance.between(0.5, 1.1);
    out.line("translate(" + vector(p) + ") " + turn + " cylinder(h = " + number(kHeight * r) +
             ", r1 = " + number(r) + ", r2 = 0, center = true);");
  }
  out.close();
}

void generate_tube(CsgText& out, int holes, Chance) {
  // The paper has 30 rods x 10 holes, 30 x 20 (which it calls TUBE500), 50 x 20. Other sizes keep
  // about the first one's shape; where the holes do not share out evenly some rods have one more.
  constexpr double kTubeRadius = 40, kTubeHeight = 100;
  int rods = int(std::max(1L, std::lround(std::sqrt(3.0 * holes))));
  if (holes == 500 || holes == 600) rods = 30, holes = 600;
  if (holes == 1000) rods = 50;
  const int most_holes_a_rod = (holes + rods - 1) / rods;

  const double spacing = 2 * std::numbers::pi * kTubeRadius / rods;
  const double rod_radius = std::min(0.6 * spacing, kTubeRadius);
  // Small enough that neither the neighbouring rod nor the next hole is met.
  const double hole_radius = 0.36 * std::min(spacing, kTubeHeight / most_holes_a_rod);
  out.comment(std::to_string(rods) + " rods side by side on a circle, " + std::to_string(holes) +
              " holes in all.");
  out.comment("");
  out.open("union()");
  for (int rod = 0; rod < rods; ++rod) {
    const int count = int(int64_t(holes) * (rod + 1) / rods - int64_t(holes) * rod / rods);
    out.open("rotate(" + vector({0, 0, 360.0 * rod / rods}) + ") translate(" +
             vector({kTubeRadius, 0, 0}) + ") difference()");
    out.line("cylinder(h = " + number(kTubeHeight) + ", r = " + number(rod_radius) + ");");
    for (int hole = 0; hole < count; ++hole) {
      const double z = (hole + (rod % 2 ? 0.25 : 0.75)) * kTubeHeight / count;
      out.line("translate(" + vector({0, 0, z}) + ") rotate([0, 90, 0]) cylinder(h = " +
               number(2 * rod_radius + 2) + ", r = " + number(hole_radius) + ", center = true);");
    }
    out.close();
  }
  out.close();
}

void generate_widget(CsgText& out, int, Chance) {
  out.comment("");
  out.open("difference()");
  out.line("sphere(r = 10);");
  out.line("cylinder(h = 22, r = 5, center = true);");
  out.line("rotate([90, 0, 0]) cylinder(h = 22, r = 5, center = true);");
  out.line("rotate([0, 90, 0]) cylinder(h = 22, r = 5, center = true);");
  out.close();
}

void generate_r9(CsgText& out, int, Chance) {
  out.comment("");
  out.comment("The eye, its neck and its shank, with a spherical seat and a blind hole.");
  out.open("difference()");
  out.open("union()");
  out.open("intersection()");
  out.line("rotate([90, 0, 0]) cylinder(h = 14, r = 20, center = true);");
  out.line("sphere(r = 20.5);");
  out.close();
  out.line("translate([15, 0, 0]) rotate([0, 90, 0]) cylinder(h = 11, r1 = 6.5, r2 = 8.5);");
  out.line("translate([26, 0, 0]) rotate([0, 90, 0]) cylinder(h = 32, r = 8.5);");
  out.close();
  out.line("sphere(r = 13.6);");
  out.line("translate([34, 0, 0]) rotate([0, 90, 0]) cylinder(h = 25, r = 5);");
  out.close();
  out.comment("");
  out.comment("The ball in the seat, cut flat on both sides and bored.");
  out.open("difference()");
  out.open("intersection()");
  out.line("sphere(r = 13);");
  out.line("cube([30, 20, 30], center = true);");
  out.close();
  out.line("rotate([90, 0, 0]) cylinder(h = 22, r = 6.5, center = true);");
  out.close();
}

}  // namespace whittle
