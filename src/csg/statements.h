// The statements of .csg: their names, and their arguments sorted by parameter.
//
// The facts (names, orders, defaults, what wins over what, what a wrong type gives) are OpenSCAD's,
// found by running it; where they are odd, a test states them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "csg/values.h"
#include "model/warnings.h"
#include "shape/fragments.h"

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
  kSquare,
  kCircle,
  kPolygon,
  kText,
  kImport,
  kSurface,
  kLinearExtrude,
  kRotateExtrude,
  kOffset,
  kResize,
  kProjection,
  kHull,
  kMinkowski,
  kFill,
  kRoof,
  kUnknown,   ///< no statement of OpenSCAD's; the union of its children stands for it
  kLanguage,  ///< part of OpenSCAD's language that only OpenSCAD can evaluate
};

/// A statement and its parameters.
struct StatementType {
  static constexpr size_t kMostParameters = 12;

  std::string_view name;
  Meaning meaning = Meaning::kUnknown;
  uint8_t positional = 0;        ///< so many of the parameters may be given without their names
  bool checks_arguments = true;  ///< false: any argument may be meant, none is looked at
  bool passes_fragments = true;  ///< $fn, $fa, $fs among the arguments hold for the children too
  std::array<std::string_view, kMostParameters> parameters{};
};

/// The type of a statement; for a name that is not known, a kUnknown without a name.
const StatementType& find_statement(std::string_view name);

/// True if the statement stands for a shape, so that it has an id: primitives, the leaves of a
/// document, and its operations.
inline bool has_id(Meaning meaning) {
  return meaning >= Meaning::kCube && meaning <= Meaning::kRoof;
}
/// True if OpenSCAD does not look at the children of such a statement.
inline bool is_childless(Meaning meaning) {
  return meaning >= Meaning::kCube && meaning <= Meaning::kSurface;
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

/// What stands before a statement.
struct StatementModifiers {
  bool background = false, highlight = false, root = false, disabled = false;
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

}  // namespace whittle
