// Scenes in which faces lie on one another, each with its right answer, known without any rule for
// coincidence: another model of the same solid in which no faces coincide, or a formula.
//
// A scene reads as: `text` must look like `equal`, and where `equal` shows its primitive number
// `face`, the scene shows its own number `owner` (docs/conventions.md, tie rules).
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "trace/frame.h"

namespace whittle {

/// Where some of the surface lies, as a test on its points.
using Where = std::function<bool(Vec3)>;

inline Where below(double z) {
  return [=](Vec3 p) { return p.z < z; };
}
inline Where above(double z) {
  return [=](Vec3 p) { return p.z > z; };
}

/// From the z axis.
inline double radius(Vec3 p) {
  return std::hypot(p.x, p.y);
}

/// An `equal` of which nothing is seen.
inline constexpr const char* kNothing = "group();";

struct Owner {
  uint32_t face = 0;   ///< id in the equivalent model
  uint32_t owner = 0;  ///< id in the scene
  Where where = {};    ///< empty: everywhere
};

/// What a ray must see; nothing where the answer hangs on less than the tolerance.
using RayFormula = std::function<std::optional<Hit>(const Ray&)>;

/// A look at the scene in perspective.
struct Look {
  Vec3 eye, target;
  double half_height = 0.5;  ///< tan(fov / 2)
};

struct CoincidentScene {
  std::string name;   ///< unique, lower_case
  std::string text;   ///< .csg, with coinciding faces
  std::string equal;  ///< .csg of the same solid, without
  /// An id of `equal` that is not listed must be seen as itself. Listed, it must be seen as one of
  /// the owners that are given for the place.
  std::vector<Owner> owners = {};
  /// Besides the two views of cameras_for from outside. Without any, its third view is taken too,
  /// from inside.
  std::vector<Look> looks = {};
  bool only_looks = false;  ///< without the views of cameras_for
  RayFormula formula = {};  ///< instead of `equal`, if that is empty; ids are the scene's
  /// False: what is coincident here is finer than six digits, so the scene cannot be turned.
  bool turns = true;
};

/// How tests name it.
inline void PrintTo(const CoincidentScene& scene, std::ostream* out) {
  *out << scene.name;
}

// The chapters of the suite, a file each.
std::vector<CoincidentScene> flush_scenes();      ///< pockets, bores and slots
std::vector<CoincidentScene> abutting_scenes();   ///< parts side by side, and inside one another
std::vector<CoincidentScene> body_scenes();       ///< extrusions, revolutions, hulls, meshes
std::vector<CoincidentScene> curved_scenes();     ///< curved walls that are shared
std::vector<CoincidentScene> facet_scenes();      ///< polyhedra, tessellated curves, half-spaces
std::vector<CoincidentScene> algebra_scenes();    ///< laws of sets
std::vector<CoincidentScene> tolerance_scenes();  ///< films and gaps, nearly equal curves
std::vector<CoincidentScene> menger_scenes();     ///< the sponge

/// The side of the smallest cells of the sponge of a level, so that it is 9 or 81 long.
inline int sponge_cell(int level) {
  return level == 2 ? 1 : 3;
}

}  // namespace whittle
