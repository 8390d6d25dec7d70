// What the statements of .csg mean: from a name and its arguments to shapes, maps and colours.
//
// The facts (names, orders, defaults, what wins over what, what a wrong type gives) are OpenSCAD's,
// found by running it; where they are odd, a test states them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/affine.h"
#include "io/csg_values.h"
#include "io/warnings.h"
#include "model/facets.h"
#include "model/model.h"

namespace whittle {

enum class Meaning : uint8_t {
  kUnion,
  kDifference,
  kIntersection,
  kMultmatrix,
  kTranslate,
  kRotate,
  kScale,
  kMirror,
  kColor,
  kCube,
  kSphere,
  kCylinder,
  kPolyhedron,
  kHalfspace,
  kUnsupportedGroup,  ///< not supported; it has children, and their union stands for it
  kUnsupportedLeaf,   ///< not supported, and without children: nothing stands for it
  kLanguage,          ///< part of OpenSCAD's language that only OpenSCAD can evaluate
};

/// A statement and its parameters.
struct StatementType {
  static constexpr size_t kMostParameters = 8;

  std::string_view name;
  Meaning meaning = Meaning::kUnsupportedGroup;
  uint8_t positional = 0;        ///< so many of the parameters may be given without their names
  bool checks_arguments = true;  ///< false: any argument may be meant, none is looked at
  bool passes_fragments = true;  ///< $fn, $fa, $fs among the arguments hold for the children too
  std::array<std::string_view, kMostParameters> parameters{};
};

/// The type of a statement; for a name that is not known, a kUnsupportedGroup without a name.
const StatementType& find_statement(std::string_view name);

inline bool is_primitive(Meaning meaning) {
  return meaning >= Meaning::kCube && meaning <= Meaning::kHalfspace;
}
/// True if OpenSCAD does not look at the children of such a statement.
inline bool is_leaf(Meaning meaning) {
  return is_primitive(meaning) || meaning == Meaning::kUnsupportedLeaf;
}

/// $fn, $fa, $fs as far as they are given; what is not given is inherited.
struct GivenFragments {
  std::optional<double> fn, fa, fs;

  bool is_complete() const { return fn && fa && fs; }
  /// This, and where something is not given here, `outer`.
  GivenFragments within(const GivenFragments& outer) const;
  /// This, and where something is not given, OpenSCAD's defaults.
  FragmentSettings settings() const;
  /// Takes the value of $fn, $fa or $fs. False if `name` is none of them.
  bool set(std::string_view name, const Value& value);
};

/// A statement as written, its arguments sorted by parameter.
struct Statement {
  const StatementType* type = nullptr;
  SourceLocation where;
  std::array<const Value*, StatementType::kMostParameters> arguments{};  ///< null: not given
  GivenFragments fragments;
};

/// Sorts arguments by parameter, as OpenSCAD does: what has no name goes to the first parameter
/// without a value; of several values for one name the last one counts. Warns about what fits no
/// parameter. The result refers to `arguments`.
Statement bind_arguments(const StatementType& type, SourceLocation where,
                         const CsgArguments& arguments, Warnings& warnings);

// The meanings, each for a statement of that kind. Arguments of a wrong type leave the default and
// give a warning. Facets are not yet chosen.

Cube make_cube(const Statement& statement, Warnings& warnings);
Sphere make_sphere(const Statement& statement, Warnings& warnings);
Cylinder make_cylinder(const Statement& statement, Warnings& warnings);
Halfspace make_halfspace(const Statement& statement, Warnings& warnings);

/// Points and faces, without planes. Faces of fewer than three corners are left out. A point or a
/// face that is none sets `mistake`, in words, and the result is then of no use.
Polyhedron make_polyhedron(const Statement& statement, std::string& mistake);

/// kMultmatrix, kTranslate, kRotate, kScale or kMirror.
Affine make_transform(const Statement& statement, Warnings& warnings);

/// Components above 1 are 1, negative ones are unset (-1).
Rgba make_color(const Statement& statement, Warnings& warnings);

/// A vector of exactly three numbers.
std::optional<Vec3> as_vec3(const Value& value);

}  // namespace whittle
