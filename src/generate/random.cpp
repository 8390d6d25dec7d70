// Random trees: every operation, every primitive and every kind of transform, at any size.
//
// A subtree is made about the origin of its own frame, as large as it is told; the operation above
// places it. Sizes and places are chosen so that most operations do something that can be seen.
#include <algorithm>
#include <vector>

#include "generate/models.h"

namespace whittle {
namespace {

/// Half of the multiples of 15 degrees, where faces may coincide, half of any angle.
double angle(Chance& chance) {
  return chance.happens(0.5) ? 15 * chance.integer(-12, 12) : chance.between(-180, 180);
}

Vec3 offset(Chance& chance, double reach) {
  return {chance.between(-reach, reach), chance.between(-reach, reach),
          chance.between(-reach, reach)};
}

// In what follows every draw stands in a declaration of its own or in braces: the order in which
// the operands of + are evaluated is the compiler's choice, and would be the text's.

/// A transform about the subtree's own origin, or nothing; ends in a space if it is one.
std::string transform(Chance& chance) {
  switch (chance.integer(0, 7)) {
    case 0:
    case 1:
      return "rotate(" + vector({angle(chance), angle(chance), angle(chance)}) + ") ";
    case 2:
      return "scale(" +
             vector(
                 {chance.between(0.6, 1.5), chance.between(0.6, 1.5), chance.between(0.6, 1.5)}) +
             ") ";
    case 3:
      return "mirror(" + vector({1, double(chance.integer(-1, 1)), double(chance.integer(-1, 1))}) +
             ") ";
    case 4: {
      const Vec3 shear = offset(chance, 0.5);
      return "multmatrix([[1, " + number(shear.x) + ", " + number(shear.y) + ", 0], [0, 1, " +
             number(shear.z) + ", 0], [0, 0, 1, 0], [0, 0, 0, 1]]) ";
    }
    case 5: {
      const Vec3 rgb{chance.unit(), chance.unit(), chance.unit()};
      return "color([" + number(rgb.x) + ", " + number(rgb.y) + ", " + number(rgb.z) + ", 1]) ";
    }
    default:
      return "";
  }
}

/// `, $fn = n` for some curves; the others are true curves.
std::string facets(Chance& chance) {
  return chance.happens(0.3) ? ", $fn = " + std::to_string(chance.integer(3, 12)) : "";
}

std::string polyhedron(Chance& chance, double size) {
  const std::string a = number(size * chance.between(0.5, 1)), b = number(size),
                    c = number(size * chance.between(0.5, 1));
  if (chance.happens(0.5)) {
    return "polyhedron(points = [[" + a + ", 0, 0], [-" + a + ", 0, 0], [0, " + b + ", 0], [0, -" +
           b + ", 0], [0, 0, " + c + "], [0, 0, -" + c +
           "]], faces = [[4, 2, 0], [4, 1, 2], [4, 3, 1], [4, 0, 3], [5, 0, 2], [5, 2, 1], "
           "[5, 1, 3], [5, 3, 0]]);";
  }
  // A wedge: a ramp that rises along x.
  return "polyhedron(points = [[-" + a + ", -" + b + ", -" + c + "], [" + a + ", -" + b + ", -" +
         c + "], [" + a + ", " + b + ", -" + c + "], [-" + a + ", " + b + ", -" + c + "], [" + a +
         ", -" + b + ", " + c + "], [" + a + ", " + b + ", " + c +
         "]], faces = [[0, 1, 2, 3], [0, 4, 1], [1, 4, 5, 2], [2, 5, 3], [0, 3, 5, 4]]);";
}

std::string primitive(Chance& chance, double size) {
  const int kind = chance.integer(0, 8);
  if (kind >= 7) return polyhedron(chance, size);
  const std::string center = chance.happens(0.7) ? ", center = true" : "";
  if (kind < 2) {
    return "cube(" +
           vector(Vec3{chance.between(0.8, 2), chance.between(0.8, 2), chance.between(0.8, 2)} *
                  size) +
           center + ");";
  }
  const double r = size * chance.between(0.4, 1);
  const std::string fn = facets(chance);
  if (kind < 4) return "sphere(r = " + number(r) + fn + ");";
  const double h = size * chance.between(0.8, 2.4);
  if (kind < 6) {
    return "cylinder(h = " + number(h) + ", r = " + number(r) + center + fn + ");";
  }
  const double r2 = chance.happens(0.5) ? 0 : size * chance.between(0.1, 0.9);
  return "cylinder(h = " + number(h) + ", r1 = " + number(r) + ", r2 = " + number(r2) + center +
         fn + ");";
}

/// What is still to be written: the end of a block, or a subtree.
struct Task {
  bool close = false;
  int primitives = 0;
  double size = 0;  ///< half the extent, model units
  Vec3 place{};
};

}  // namespace

void generate_random(CsgText& out, int primitives, Chance chance) {
  constexpr double kWhole = 50, kSmallest = 4;
  out.comment("");
  std::vector<Task> tasks{{.primitives = primitives, .size = kWhole}};
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    if (task.close) {
      out.close();
      continue;
    }
    const bool is_root = task.size == kWhole;
    const std::string place = task.place == Vec3{} ? "" : "translate(" + vector(task.place) + ") ";
    const std::string head = place + (is_root ? "" : transform(chance));
    if (task.primitives == 1) {
      out.line(head + primitive(chance, task.size));
      continue;
    }

    // The root unites, or the whole could easily be empty.
    const double kind = is_root ? 0 : chance.unit();
    const bool unites = kind < 0.45, subtracts = !unites && kind < 0.8;
    out.open(head + (unites ? "union()" : subtracts ? "difference()" : "intersection()"));
    tasks.push_back({.close = true});

    const int children = chance.integer(2, std::min(task.primitives, 5));
    int left = task.primitives;
    for (int i = 0; i < children; ++i) {
      const int others = children - 1 - i;
      // The last to be pushed is the first to be written: what a difference cuts.
      const bool is_first = others == 0;
      const int share =
          is_first
              ? left
              : std::min(left - others, chance.integer(1, std::max(1, 2 * left / (others + 1))));
      left -= share;
      double size = 0.75, reach = 0.6;
      if (subtracts) size = is_first ? 1 : 0.6, reach = is_first ? 0 : 0.7;
      if (!unites && !subtracts) size = 0.95, reach = 0.25;
      tasks.push_back({.primitives = share,
                       .size = std::max(kSmallest, task.size * size),
                       .place = offset(chance, task.size * reach)});
    }
  }
}

}  // namespace whittle
