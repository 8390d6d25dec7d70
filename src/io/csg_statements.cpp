#include "io/csg_statements.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "io/color_names.h"

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
    {"translate", kTranslate, 1, true, true, {"v"}},
    {"rotate", kRotate, 2, true, true, {"a", "v"}},
    {"scale", kScale, 1, true, true, {"v"}},
    {"mirror", kMirror, 1, true, true, {"v"}},
    {"square", kUnsupportedLeaf, 0, false, true, {}},
    {"circle", kUnsupportedLeaf, 0, false, true, {}},
    {"polygon", kUnsupportedLeaf, 0, false, true, {}},
    {"text", kUnsupportedLeaf, 0, false, true, {}},
    {"import", kUnsupportedLeaf, 0, false, true, {}},
    {"surface", kUnsupportedLeaf, 0, false, true, {}},
    {"linear_extrude", kUnsupportedGroup, 0, false, true, {}},
    {"hull", kUnsupportedGroup, 0, false, true, {}},
    {"rotate_extrude", kUnsupportedGroup, 0, false, true, {}},
    {"offset", kUnsupportedGroup, 0, false, true, {}},
    {"resize", kUnsupportedGroup, 0, false, true, {}},
    {"projection", kUnsupportedGroup, 0, false, true, {}},
    {"minkowski", kUnsupportedGroup, 0, false, true, {}},
    {"roof", kUnsupportedGroup, 0, false, true, {}},
    {"fill", kUnsupportedGroup, 0, false, true, {}},
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

constexpr StatementType kUnknownType{{}, kUnsupportedGroup, 0, false, true, {}};

const Value* argument(const Statement& statement, size_t index) {
  return statement.arguments[index];
}

void warn(const Statement& statement, std::string_view problem, Warnings& warnings) {
  const std::string message = fmt::format("{}: {}", statement.type->name, problem);
  warnings.add(message, statement.where, message);
}

bool is_number(const Value* value) {
  return value && value->kind == Value::Kind::kNumber;
}
bool is_vector(const Value* value) {
  return value && value->kind == Value::Kind::kVector;
}

/// Up to `capacity` numbers of a vector; how many there are, or -1 if it holds anything else.
int numbers(const Value* value, double* out, int capacity) {
  if (!is_vector(value)) return -1;
  int count = 0;
  for (const Value* e = value->begin(); e != value->end(); e += e->extent, ++count) {
    if (!is_number(e) || count == capacity) return -1;
    out[count] = e->number;
  }
  return count;
}

/// Three numbers, or two and then `z`.
std::optional<Vec3> vec3_or_vec2(const Value* value, double z) {
  double e[3] = {0, 0, z};
  return numbers(value, e, 3) >= 2 ? std::optional(Vec3{e[0], e[1], e[2]}) : std::nullopt;
}

/// A number that is given; undef is as good as nothing.
std::optional<double> read_number(const Statement& statement, size_t index, Warnings& warnings) {
  const Value* const value = argument(statement, index);
  if (!value || value->kind == Value::Kind::kUndef) return std::nullopt;
  if (is_number(value)) return value->number;
  warn(statement,
       fmt::format("{} is not a number; it is ignored", statement.type->parameters[index]),
       warnings);
  return std::nullopt;
}

void read_center(const Statement& statement, size_t index, bool& center, Warnings& warnings) {
  const Value* const value = argument(statement, index);
  if (!value || value->kind == Value::Kind::kUndef) return;
  if (value->kind == Value::Kind::kBool) {
    center = value->number != 0;
  } else {
    warn(statement, "center is neither true nor false; it is ignored", warnings);
  }
}

/// The radius by radius or diameter; the diameter wins.
std::optional<double> radius(const Statement& statement, size_t radius_index, size_t diameter_index,
                             Warnings& warnings) {
  const std::optional<double> r = read_number(statement, radius_index, warnings);
  const std::optional<double> d = read_number(statement, diameter_index, warnings);
  if (r && d) warn(statement, "a radius is ignored because the diameter is given too", warnings);
  return d ? *d / 2 : r;
}

Affine multmatrix(const Statement& statement, Warnings& warnings) {
  double m[4][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  const Value* const rows = argument(statement, 0);
  if (!is_vector(rows)) {
    warn(statement, "the matrix is not a vector of vectors; nothing is moved", warnings);
    return {};
  }
  int i = 0;
  bool understood = true;
  for (const Value* row = rows->begin(); row != rows->end() && i < 4; row += row->extent, ++i) {
    understood &= is_vector(row);
    if (!is_vector(row)) continue;
    int j = 0;
    for (const Value* e = row->begin(); e != row->end() && j < 4; e += e->extent, ++j) {
      understood &= is_number(e);
      if (is_number(e)) m[i][j] = e->number;
    }
  }
  if (!understood) {
    warn(statement, "not all of the matrix is four rows of four numbers; the rest is ignored",
         warnings);
  }
  if (m[3][3] != 1) {
    for (auto& row : m) {
      for (double& e : row) e /= m[3][3];
    }
  }
  return {.row = {{m[0][0], m[0][1], m[0][2]},
                  {m[1][0], m[1][1], m[1][2]},
                  {m[2][0], m[2][1], m[2][2]}},
          .translation = {m[0][3], m[1][3], m[2][3]}};
}

/// Turns by `degrees` about `axis`, which need not be a unit vector; no axis, no turn.
Affine rotation(double degrees, Vec3 axis) {
  const Vec3 u = normalize(axis);
  if (u == Vec3{}) return {};
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const double c = std::isfinite(degrees) ? cos_degrees(degrees) : kNaN;
  const double s = std::isfinite(degrees) ? sin_degrees(degrees) : kNaN;
  // Rodrigues: R = c I + s [u]x + (1 - c) u u^T
  const double t = 1 - c;
  return {.row = {{c + t * u.x * u.x, t * u.x * u.y - s * u.z, t * u.x * u.z + s * u.y},
                  {t * u.x * u.y + s * u.z, c + t * u.y * u.y, t * u.y * u.z - s * u.x},
                  {t * u.x * u.z - s * u.y, t * u.y * u.z + s * u.x, c + t * u.z * u.z}},
          .translation = {}};
}

Affine rotate(const Statement& statement, Warnings& warnings) {
  const Value* const a = argument(statement, 0);
  const Value* const v = argument(statement, 1);
  if (is_vector(a)) {
    double angle[3] = {0, 0, 0};
    int i = 0;
    bool understood = true;
    for (const Value* e = a->begin(); e != a->end(); e += e->extent, ++i) {
      if (i < 3 && is_number(e)) {
        angle[i] = e->number;
      } else {
        understood = false;
      }
    }
    if (!understood) warn(statement, "not all angles are understood", warnings);
    if (v) warn(statement, "the axis is ignored because there are three angles", warnings);
    return rotation(angle[2], {0, 0, 1}) * rotation(angle[1], {0, 1, 0}) *
           rotation(angle[0], {1, 0, 0});
  }
  if (!is_number(a)) {
    warn(statement, "the angle is not a number; nothing is turned", warnings);
    return {};
  }
  if (!v) return rotation(a->number, {0, 0, 1});
  const std::optional<Vec3> axis = vec3_or_vec2(v, 0);
  if (!axis) warn(statement, "the axis is not a vector of numbers; it is read as z", warnings);
  return rotation(a->number, axis.value_or(Vec3{0, 0, 1}));
}

Affine mirror(const Statement& statement, Warnings& warnings) {
  const std::optional<Vec3> n = vec3_or_vec2(argument(statement, 0), 0);
  if (!n) warn(statement, "the normal is not a vector of numbers; it is read as x", warnings);
  const Vec3 u = normalize(n.value_or(Vec3{1, 0, 0}));
  Affine map;
  for (int i = 0; i < 3; ++i) map.row[i] -= u * (2 * u[i]);
  return map;
}

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

Cube make_cube(const Statement& statement, Warnings& warnings) {
  Cube cube;
  if (const Value* const size = argument(statement, 0)) {
    if (is_number(size)) {
      cube.size = {size->number, size->number, size->number};
    } else if (const std::optional<Vec3> xyz = as_vec3(*size)) {
      cube.size = *xyz;
    } else {
      warn(statement, "the size is neither a number nor three; it is read as 1", warnings);
    }
  }
  read_center(statement, 1, cube.center, warnings);
  return cube;
}

Sphere make_sphere(const Statement& statement, Warnings& warnings) {
  Sphere sphere;
  sphere.r = radius(statement, 0, 1, warnings).value_or(sphere.r);
  return sphere;
}

Cylinder make_cylinder(const Statement& statement, Warnings& warnings) {
  Cylinder cylinder;
  cylinder.h = read_number(statement, 0, warnings).value_or(cylinder.h);
  const std::optional<double> r = radius(statement, 4, 5, warnings);
  const std::optional<double> r1 = radius(statement, 1, 6, warnings);
  const std::optional<double> r2 = radius(statement, 2, 7, warnings);
  if (r && (r1 || r2)) warn(statement, "more radii are given than can be meant", warnings);
  cylinder.r1 = r1 ? *r1 : r.value_or(cylinder.r1);
  cylinder.r2 = r2 ? *r2 : r.value_or(cylinder.r2);
  read_center(statement, 3, cylinder.center, warnings);
  return cylinder;
}

Halfspace make_halfspace(const Statement& statement, Warnings& warnings) {
  Halfspace halfspace;
  if (const Value* const n = argument(statement, 0)) {
    if (const std::optional<Vec3> xyz = as_vec3(*n)) {
      halfspace.n = *xyz;
    } else {
      warn(statement, "n is not a vector of three numbers; it is read as [0, 0, 1]", warnings);
    }
  }
  if (const Value* const d = argument(statement, 1)) {
    if (is_number(d)) {
      halfspace.d = d->number;
    } else {
      warn(statement, "d is not a number; it is read as 0", warnings);
    }
  }
  return halfspace;
}

Polyhedron make_polyhedron(const Statement& statement, std::string& mistake) {
  Polyhedron polyhedron;
  if (const Value* const points = argument(statement, 0); is_vector(points)) {
    for (const Value* p = points->begin(); p != points->end(); p += p->extent) {
      const std::optional<Vec3> point = vec3_or_vec2(p, 0);
      if (!point) {
        mistake =
            fmt::format("points[{}] is not a vector of three numbers", polyhedron.points.size());
        return {};
      }
      polyhedron.points.push_back(*point);
    }
  }
  // Very old dumps say triangles.
  const Value* const faces = argument(statement, argument(statement, 1) ? 1 : 3);
  if (!is_vector(faces)) return polyhedron;
  size_t number = 0;
  for (const Value* f = faces->begin(); f != faces->end(); f += f->extent, ++number) {
    if (!is_vector(f)) {
      mistake = fmt::format("faces[{}] is not a vector", number);
      return {};
    }
    std::vector<uint32_t> face;
    face.reserve(f->extent - 1);
    for (const Value* corner = f->begin(); corner != f->end(); corner += corner->extent) {
      // The comparisons are false for NaN.
      if (!is_number(corner) || !(corner->number >= 0) ||
          !(corner->number < static_cast<double>(polyhedron.points.size()))) {
        mistake = fmt::format(
            "faces[{}] names {}; there are {} points, counted from 0", number,
            is_number(corner) ? fmt::format("point {}", corner->number) : "what is not a number",
            polyhedron.points.size());
        return {};
      }
      face.push_back(static_cast<uint32_t>(corner->number));
    }
    if (face.size() >= 3) polyhedron.faces.push_back(std::move(face));
  }
  return polyhedron;
}

Affine make_transform(const Statement& statement, Warnings& warnings) {
  const Value* const v = argument(statement, 0);
  switch (statement.type->meaning) {
    case kTranslate: {
      const std::optional<Vec3> t = vec3_or_vec2(v, 0);
      if (!t) warn(statement, "not a vector of three numbers; nothing is moved", warnings);
      return translation(t.value_or(Vec3{}));
    }
    case kScale: {
      if (is_number(v)) return scaling({v->number, v->number, v->number});
      const std::optional<Vec3> s = vec3_or_vec2(v, 1);
      if (!s) warn(statement, "neither a number nor three; nothing is scaled", warnings);
      return scaling(s.value_or(Vec3{1, 1, 1}));
    }
    case kRotate:
      return rotate(statement, warnings);
    case kMirror:
      return mirror(statement, warnings);
    default:
      return multmatrix(statement, warnings);
  }
}

Rgba make_color(const Statement& statement, Warnings& warnings) {
  Rgba color;
  if (const Value* const c = argument(statement, 0); is_vector(c)) {
    float rgba[4] = {1, 1, 1, 1};
    int i = 0;
    bool are_known = true, are_within = true;
    for (const Value* e = c->begin(); e != c->end() && i < 4; e += e->extent, ++i) {
      const bool is_known = is_number(e) && std::isfinite(e->number);
      rgba[i] = is_known ? static_cast<float>(e->number) : 0;
      are_known &= is_known;
      if (rgba[i] > 1 || (rgba[i] < 0 && rgba[i] != -1)) {
        are_within = false;
        rgba[i] = rgba[i] > 1 ? 1.0f : -1.0f;
      }
    }
    if (!are_known) warn(statement, "a component is not a number; it is read as 0", warnings);
    if (!are_within) warn(statement, "a component is not between 0 and 1", warnings);
    color = {rgba[0], rgba[1], rgba[2], rgba[3]};
  } else if (c && c->kind == Value::Kind::kString) {
    if (const std::optional<Rgba> named = parse_color(c->text)) {
      color = *named;
    } else {
      const std::string kind = "color: the name is not known; nothing is coloured";
      warnings.add(
          kind, statement.where,
          fmt::format("color: the name {} is not known; nothing is coloured", quote(c->text)));
    }
  } else if (c && c->kind != Value::Kind::kUndef) {
    warn(statement, "c is neither a name nor a vector; nothing is coloured", warnings);
  }
  if (const std::optional<double> alpha = read_number(statement, 1, warnings)) {
    color.a = std::isfinite(*alpha) && *alpha >= 0 ? static_cast<float>(std::fmin(*alpha, 1)) : -1;
  }
  return color;
}

std::optional<Vec3> as_vec3(const Value& value) {
  double e[3];
  return numbers(&value, e, 3) == 3 ? std::optional(Vec3{e[0], e[1], e[2]}) : std::nullopt;
}

}  // namespace whittle
