#include "csg/maps.h"

#include <fmt/format.h>

#include "base/rotation.h"
#include "csg/arguments.h"
#include "csg/color_names.h"

namespace whittle {
namespace {

Affine multmatrix(const Statement& statement, Warnings& warnings) {
  double m[4][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  const Value* const rows = argument(statement, 0);
  if (!is_vector(rows)) {
    warn(statement, "the matrix is not a vector of vectors; nothing is moved", warnings);
    return {};
  }
  int i = 0;
  bool understood = true;
  for (const Value* row = rows->begin(); row != rows->end() && i < 4; row = row->end(), ++i) {
    understood &= is_vector(row);
    if (!is_vector(row)) continue;
    int j = 0;
    for (const Value* e = row->begin(); e != row->end() && j < 4; e = e->end(), ++j) {
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

Affine rotate(const Statement& statement, Warnings& warnings) {
  const Value* const a = argument(statement, 0);
  const Value* const v = argument(statement, 1);
  if (is_vector(a)) {
    double angle[3] = {0, 0, 0};
    int i = 0;
    bool understood = true;
    for (const Value* e = a->begin(); e != a->end(); e = e->end(), ++i) {
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

Affine make_transform(const Statement& statement, Warnings& warnings) {
  const Value* const v = argument(statement, 0);
  switch (statement.type->meaning) {
    case Meaning::kTranslate: {
      const std::optional<Vec3> t = vec3_or_vec2(v, 0);
      if (!t) warn(statement, "not a vector of three numbers; nothing is moved", warnings);
      return translation(t.value_or(Vec3{}));
    }
    case Meaning::kScale: {
      if (is_number(v)) return scaling({v->number, v->number, v->number});
      const std::optional<Vec3> s = vec3_or_vec2(v, 1);
      if (!s) warn(statement, "neither a number nor three; nothing is scaled", warnings);
      return scaling(s.value_or(Vec3{1, 1, 1}));
    }
    case Meaning::kRotate:
      return rotate(statement, warnings);
    case Meaning::kMirror:
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
    for (const Value* e = c->begin(); e != c->end() && i < 4; e = e->end(), ++i) {
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
    if (const std::optional<Rgba> named = parse_color(c->text())) {
      color = *named;
    } else {
      const std::string kind = "color: the name is not known; nothing is coloured";
      warnings.add(
          kind, statement.where,
          fmt::format("color: the name {} is not known; nothing is coloured", quote(c->text())));
    }
  } else if (c && c->kind != Value::Kind::kUndef) {
    warn(statement, "c is neither a name nor a vector; nothing is coloured", warnings);
  }
  if (const std::optional<double> alpha = read_number(statement, 1, warnings)) {
    color.a = std::isfinite(*alpha) && *alpha >= 0 ? static_cast<float>(std::fmin(*alpha, 1)) : -1;
  }
  return color;
}

}  // namespace whittle
