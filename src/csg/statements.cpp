#include "csg/statements.h"

#include <fmt/format.h>

#include "csg/arguments.h"

namespace whittle {
namespace {

using enum Meaning;

// The order of parameters is the order of the arguments, and that in which the functions below
// take them. The most frequent names first: they are looked for one after the other.
constexpr StatementType kTypes[] = {
    {"group", kUnion, 0, true, false, {}},
    {"multmatrix", kMultmatrix, 1, true, true, {"m"}},
    {"cylinder", kCylinder, 4, true, true, {"h", "r1", "r2", "center", "r", "d", "d1", "d2"}},
    {"cube", kCube, 2, true, true, {"size", "center"}},
    {"difference", kDifference, 0, true, false, {}},
    {"union", kUnion, 0, true, false, {}},
    {"color", kColor, 2, true, true, {"c", "alpha"}},
    {"sphere", kSphere, 1, true, true, {"r", "d"}},
    {"render", kUnion, 1, true, true, {"convexity"}},
    {"intersection", kIntersection, 0, true, false, {}},
    {"polyhedron", kPolyhedron, 3, true, true, {"points", "faces", "convexity", "triangles"}},
    {"halfspace", kHalfspace, 2, true, true, {"n", "d"}},
    {"circle", kCircle, 1, true, true, {"r", "d"}},
    {"linear_extrude",
     kLinearExtrude,
     7,
     true,
     true,
     {"height", "v", "scale", "center", "twist", "slices", "segments", "convexity", "file", "layer",
      "origin", "timestamp"}},
    {"square", kSquare, 2, true, true, {"size", "center"}},
    {"polygon", kPolygon, 3, true, true, {"points", "paths", "convexity"}},
    {"hull", kHull, 0, true, true, {}},
    {"rotate_extrude",
     kRotateExtrude,
     2,
     true,
     true,
     {"angle", "start", "convexity", "file", "layer", "origin", "scale", "timestamp"}},
    {"offset", kOffset, 1, true, true, {"r", "delta", "chamfer"}},
    {"text",
     kText,
     3,
     true,
     true,
     {"text", "size", "font", "direction", "language", "script", "halign", "valign", "spacing"}},
    {"resize", kResize, 2, true, true, {"newsize", "auto", "convexity"}},
    {"minkowski", kMinkowski, 1, true, true, {"convexity"}},
    {"import",
     kImport,
     5,
     true,
     true,
     {"file", "layer", "convexity", "origin", "scale", "center", "dpi", "id", "timestamp",
      "filename", "layername"}},
    {"surface", kSurface, 3, true, true, {"file", "center", "convexity", "invert", "timestamp"}},
    {"projection", kProjection, 1, true, true, {"cut", "convexity"}},
    {"fill", kFill, 0, true, true, {}},
    {"roof", kRoof, 1, true, true, {"method", "convexity"}},
    {"translate", kTranslate, 1, true, true, {"v"}},
    {"rotate", kRotate, 2, true, true, {"a", "v"}},
    {"scale", kScale, 1, true, true, {"v"}},
    {"mirror", kMirror, 1, true, true, {"v"}},
    {"for", kLanguage, 0, false, true, {}},
    {"intersection_for", kLanguage, 0, false, true, {}},
    {"if", kLanguage, 0, false, true, {}},
    {"else", kLanguage, 0, false, true, {}},
    {"let", kLanguage, 0, false, true, {}},
    {"assign", kLanguage, 0, false, true, {}},
    {"module", kLanguage, 0, false, true, {}},
    {"function", kLanguage, 0, false, true, {}},
    {"children", kLanguage, 0, false, true, {}},
    {"use", kLanguage, 0, false, true, {}},
    {"include", kLanguage, 0, false, true, {}},
    {"echo", kLanguage, 0, false, true, {}},
    {"assert", kLanguage, 0, false, true, {}},
};

constexpr StatementType kUnknownType{{}, kUnknown, 0, false, true, {}};

}  // namespace

const StatementType& find_statement(std::string_view name) {
  for (const StatementType& type : kTypes) {
    if (type.name == name) return type;
  }
  return kUnknownType;
}

GivenFragments GivenFragments::within(const GivenFragments& outer) const {
  return {fn ? fn : outer.fn, fa ? fa : outer.fa, fs ? fs : outer.fs};
}

FragmentSettings GivenFragments::settings() const {
  const FragmentSettings defaults;
  return {fn.value_or(defaults.fn), fa.value_or(defaults.fa), fs.value_or(defaults.fs)};
}

bool GivenFragments::set(std::string_view name, const Value& value) {
  std::optional<double>* const which = name == "$fn"   ? &fn
                                       : name == "$fa" ? &fa
                                       : name == "$fs" ? &fs
                                                       : nullptr;
  if (which && is_number(&value)) *which = value.number;
  return which != nullptr;
}

Statement bind_arguments(const StatementType& type, SourceLocation where,
                         const CsgArguments& arguments, Warnings& warnings) {
  Statement statement{&type, where, {}, {}};
  size_t position = 0;
  bool warned = false;
  for (const Argument& argument : arguments.list) {
    const Value& value = arguments.values[argument.value];
    if (argument.name.starts_with('$')) {
      if (statement.fragments.set(argument.name, value) && !is_number(&value)) {
        warn(statement, fmt::format("{} is not a number; it is ignored", argument.name), warnings);
      }
      continue;
    }
    if (!type.checks_arguments) continue;
    size_t index = 0;
    if (argument.name.empty()) {
      while (position < type.positional && statement.arguments[position]) ++position;
      index = position;
      if (position >= type.positional) {
        if (!warned) warn(statement, "more arguments than it has parameters", warnings);
        warned = true;
        continue;
      }
    } else {
      while (index < type.parameters.size() && type.parameters[index] != argument.name) ++index;
      if (index == type.parameters.size()) {
        warnings.add(fmt::format("{}: an argument is not known; it is ignored", type.name),
                     argument.where,
                     fmt::format("{}: the argument {} is not known; it is ignored", type.name,
                                 quote(argument.name)));
        continue;
      }
      if (statement.arguments[index]) {
        warn(statement,
             fmt::format("{} is given more than once; the last one counts", argument.name),
             warnings);
      }
    }
    statement.arguments[index] = &value;
  }
  return statement;
}

}  // namespace whittle
