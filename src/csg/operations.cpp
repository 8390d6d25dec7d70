#include "csg/operations.h"

#include <cmath>

#include "csg/arguments.h"

namespace whittle {
namespace {

/// A number for both axes, or one each.
Vec2 read_scale(const Statement& statement, size_t index, Warnings& warnings) {
  const Value* const value = defined_argument(statement, index);
  if (!value) return {1, 1};
  Vec2 scale{1, 1};
  if (is_number(value)) {
    scale = {value->number, value->number};
  } else if (const std::optional<Vec2> xy = as_vec2(*value)) {
    scale = *xy;
  } else {
    warn(statement, "scale is neither a number nor two; it is ignored", warnings);
  }
  if (!is_finite(scale)) {
    warn(statement, "scale is not finite; it is ignored", warnings);
    return {1, 1};
  }
  // As OpenSCAD does it: the top ends in a point or an edge.
  return {std::fmax(scale.x, 0), std::fmax(scale.y, 0)};
}

LinearExtrude linear_extrude(const Statement& statement, Warnings& warnings) {
  LinearExtrude how;
  const std::optional<double> height = read_number(statement, 0, warnings);
  how.height = height.value_or(how.height);
  if (const Value* const v = defined_argument(statement, 1)) {
    const std::optional<Vec3> vector = as_vec3(*v);
    const double norm = vector ? length(*vector) : 0;
    if (norm > 0 && std::isfinite(norm)) {
      how.direction = *vector / norm;
      how.height = height.value_or(norm);
    } else {
      warn(statement, "v is not a vector of three numbers; it is ignored", warnings);
    }
  }
  how.scale = read_scale(statement, 2, warnings);
  read_bool(statement, 3, how.center, warnings);
  how.twist_degrees = read_number(statement, 4, warnings).value_or(0);
  if (!std::isfinite(how.twist_degrees)) {
    warn(statement, "twist is not finite; it is ignored", warnings);
    how.twist_degrees = 0;
  }
  how.slices = read_number(statement, 5, warnings);
  how.segments = read_number(statement, 6, warnings);
  warn_if_not_finite(statement, {how.height}, warnings);
  return how;
}

RotateExtrude rotate_extrude(const Statement& statement, Warnings& warnings) {
  RotateExtrude how;
  const std::optional<double> angle = read_number(statement, 0, warnings);
  if (angle && *angle > -360 && *angle < 360) {
    how.angle_degrees = *angle;
    // Full turns start at -x where no start is given: so did all that did not print one.
    how.start_degrees = 0;
  }
  const std::optional<double> start = read_number(statement, 1, warnings);
  if (start && std::isfinite(*start)) how.start_degrees = std::fmod(*start, 360);
  return how;
}

Offset offset(const Statement& statement, Warnings& warnings) {
  Offset how;
  const std::optional<double> r = read_number(statement, 0, warnings);
  const std::optional<double> delta = read_number(statement, 1, warnings);
  bool chamfer = false;
  read_bool(statement, 2, chamfer, warnings);
  // The radius wins, as in OpenSCAD.
  if (r) {
    how.delta = *r;
  } else if (delta) {
    how.delta = *delta;
    how.round = false;
    how.chamfer = chamfer;
  }
  warn_if_not_finite(statement, {how.delta}, warnings);
  return how;
}

/// A truth as dumps have it, which print 0 and 1.
bool is_true(const Value& value) {
  return (value.kind == Value::Kind::kBool || value.kind == Value::Kind::kNumber) &&
         value.number != 0;
}

Resize resize(const Statement& statement, Warnings& warnings) {
  Resize how;
  if (const Value* const size = defined_argument(statement, 0)) {
    bool understood = is_vector(size);
    int axis = 0;
    for (const Value* e = size->begin(); is_vector(size) && e != size->end();
         e = e->end(), ++axis) {
      const bool is_size = axis < 3 && is_number(e) && std::isfinite(e->number);
      understood &= is_size;
      if (is_size) how.size[axis] = e->number;
    }
    if (!understood) {
      warn(statement, "not all of newsize is a vector of three numbers; the rest is ignored",
           warnings);
    }
  }
  if (const Value* const automatic = defined_argument(statement, 1)) {
    if (is_vector(automatic)) {
      size_t axis = 0;
      for (const Value* e = automatic->begin(); e != automatic->end() && axis < 3;
           e = e->end(), ++axis) {
        how.automatic[axis] = is_true(*e);
      }
    } else {
      how.automatic.fill(is_true(*automatic));
    }
  }
  return how;
}

}  // namespace

Operation make_operation(const Statement& statement, Warnings& warnings) {
  switch (statement.type->meaning) {
    case Meaning::kLinearExtrude:
      return linear_extrude(statement, warnings);
    case Meaning::kRotateExtrude:
      return rotate_extrude(statement, warnings);
    case Meaning::kOffset:
      return offset(statement, warnings);
    case Meaning::kResize:
      return resize(statement, warnings);
    case Meaning::kProjection: {
      Projection how;
      read_bool(statement, 0, how.cut, warnings);
      return how;
    }
    case Meaning::kHull:
      return Hull{};
    case Meaning::kMinkowski:
      return Minkowski{};
    case Meaning::kFill:
      return Fill{};
    default:
      return Roof{};
  }
}

std::optional<Import> extruded_file(const Statement& statement, Warnings& warnings) {
  const bool is_linear = statement.type->meaning == Meaning::kLinearExtrude;
  if (!is_linear && statement.type->meaning != Meaning::kRotateExtrude) return std::nullopt;
  const size_t file = is_linear ? 8 : 3;
  Import import;
  import.file = read_string(statement, file, warnings).value_or("");
  if (import.file.empty()) return std::nullopt;
  import.layer = read_string(statement, file + 1, warnings);
  if (const Value* const origin = defined_argument(statement, file + 2)) {
    const std::optional<Vec2> xy = as_vec2(*origin);
    if (xy && is_finite(*xy)) import.origin = *xy;
  }
  if (!is_linear) {
    const std::optional<double> scale = read_number(statement, file + 3, warnings);
    if (scale && *scale > 0 && std::isfinite(*scale)) import.scale = *scale;
  }
  return import;
}

}  // namespace whittle
