// Models with a pattern: they stress what random ones do not, faces that share planes.
#include "generate/models.h"

namespace whittle {

void generate_plate(CsgText& out, int holes_a_side, Chance) {
  constexpr double kPitch = 4;
  const double side = kPitch * holes_a_side;
  out.comment("");
  out.open("difference()");
  out.line("cube(" + vector({side, side, kPitch}) + ");");
  for (int row = 0; row < holes_a_side; ++row) {
    for (int column = 0; column < holes_a_side; ++column) {
      const Vec3 at{kPitch * (column + 0.5), kPitch * (row + 0.5), -1};
      out.line("translate(" + vector(at) + ") cylinder(h = " + number(kPitch + 2) + ", r = 1.4);");
    }
  }
  out.close();
}

void generate_menger(CsgText& out, int level, Chance) {
  // The side is 3^level, so every coordinate is an integer and faces that should meet do.
  int side = 1;
  for (int i = 0; i < level; ++i) side *= 3;
  out.comment("");
  out.open("difference()");
  out.line("cube(" + number(side) + ");");
  for (int cells = 1; cells < side; cells *= 3) {
    const int hole = side / (3 * cells);
    out.comment("Holes " + std::to_string(hole) + " wide, along z, x and y.");
    for (int a = 0; a < cells; ++a) {
      for (int b = 0; b < cells; ++b) {
        // A cell whose ternary digits are both 1 somewhere lies in a larger hole.
        bool is_gone = false;
        for (int p = a, q = b; p > 0 && q > 0; p /= 3, q /= 3) is_gone |= p % 3 == 1 && q % 3 == 1;
        if (is_gone) continue;
        const double u = (3 * a + 1) * hole, v = (3 * b + 1) * hole;
        const double width = hole, through = side + 2;
        out.line("translate(" + vector({u, v, -1}) + ") cube(" + vector({width, width, through}) +
                 ");");
        out.line("translate(" + vector({-1, u, v}) + ") cube(" + vector({through, width, width}) +
                 ");");
        out.line("translate(" + vector({u, -1, v}) + ") cube(" + vector({width, through, width}) +
                 ");");
      }
    }
  }
  out.close();
}

void generate_lattice(CsgText& out, int cells_a_side, Chance) {
  constexpr double kPitch = 10;
  constexpr const char* kBall = " sphere(r = 2.2);";
  constexpr const char* kStrut = " cylinder(h = 10, r = 1.2);";
  out.comment("");
  out.open("union()");
  for (int z = 0; z <= cells_a_side; ++z) {
    for (int y = 0; y <= cells_a_side; ++y) {
      for (int x = 0; x <= cells_a_side; ++x) {
        const std::string at =
            "translate(" + vector(Vec3{double(x), double(y), double(z)} * kPitch) + ")";
        out.line(at + kBall);
        if (x < cells_a_side) out.line(at + " rotate([0, 90, 0])" + kStrut);
        if (y < cells_a_side) out.line(at + " rotate([-90, 0, 0])" + kStrut);
        if (z < cells_a_side) out.line(at + kStrut);
      }
    }
  }
  out.close();
}

}  // namespace whittle
