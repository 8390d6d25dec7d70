#include "csg/leaves.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "csg/arguments.h"

namespace whittle {
namespace {

/// Quotes that dumps of hand-written files carry over.
std::string without_escaped_quotes(std::string_view raw) {
  std::string text;
  for (size_t i = 0; i < raw.size(); ++i) {
    if (raw[i] == '\\' && i + 1 < raw.size() && raw[i + 1] == '"') continue;
    text += raw[i];
  }
  return text;
}

/// Indices below `points`; others are left out, which `understood` then tells.
std::vector<uint32_t> make_path(const Value& value, size_t points, bool& understood) {
  std::vector<uint32_t> path;
  path.reserve(value.size);
  for (const Value* e = value.begin(); e != value.end(); e = e->end()) {
    // The comparisons are false for NaN.
    if (is_number(e) && e->number >= 0 && e->number < static_cast<double>(points)) {
      path.push_back(static_cast<uint32_t>(e->number));
    } else {
      understood = false;
    }
  }
  return path;
}

}  // namespace

Square make_square(const Statement& statement, Warnings& warnings) {
  Square square;
  if (const Value* const size = defined_argument(statement, 0)) {
    if (is_number(size)) {
      square.size = {size->number, size->number};
    } else if (const std::optional<Vec2> xy = as_vec2(*size)) {
      square.size = *xy;
    } else {
      warn(statement, "the size is neither a number nor two; it is read as 1", warnings);
    }
  }
  read_bool(statement, 1, square.center, warnings);
  warn_if_not_finite(statement, {square.size.x, square.size.y}, warnings);
  return square;
}

Circle make_circle(const Statement& statement, Warnings& warnings) {
  Circle circle;
  circle.r = radius(statement, 0, 1, warnings).value_or(circle.r);
  warn_if_not_finite(statement, {circle.r}, warnings);
  return circle;
}

Polygon make_polygon(const Statement& statement, Warnings& warnings) {
  Polygon polygon;
  bool understood = true;
  if (const Value* const points = defined_argument(statement, 0); is_vector(points)) {
    for (const Value* p = points->begin(); p != points->end(); p = p->end()) {
      const std::optional<Vec2> point = as_vec2(*p);
      if (!point || !is_finite(*point)) {
        // OpenSCAD shows nothing of such a polygon.
        warn(statement,
             fmt::format("points[{}] is not a vector of two finite numbers; the polygon is empty",
                         polygon.points.size()),
             warnings);
        return {};
      }
      polygon.points.push_back(*point);
    }
  } else if (points) {
    warn(statement, "points is not a vector; the polygon is empty", warnings);
  }
  const Value* const paths = defined_argument(statement, 1);
  if (paths && !is_vector(paths)) {
    warn(statement, "paths is not a vector; it is ignored", warnings);
  } else if (paths && paths->size > 0) {
    polygon.paths.emplace();
    for (const Value* p = paths->begin(); p != paths->end(); p = p->end()) {
      understood &= is_vector(p);
      if (!is_vector(p)) continue;
      polygon.paths->push_back(make_path(*p, polygon.points.size(), understood));
    }
  }
  if (!understood) {
    warn(statement, "not all of paths is vectors of the numbers of points; the rest is ignored",
         warnings);
  }
  return polygon;
}

Text make_text(const Statement& statement, bool is_dumped, Warnings& warnings) {
  Text text;
  if (const Value* const raw = defined_argument(statement, 0);
      is_dumped && raw && raw->kind == Value::Kind::kString) {
    text.text = without_escaped_quotes(raw->text());
  } else {
    text.text = read_string(statement, 0, warnings).value_or("");
  }
  text.size = read_number(statement, 1, warnings).value_or(text.size);
  const auto read = [&](size_t index) {
    return read_string(statement, index, warnings).value_or("");
  };
  text.font = read(2);
  text.direction = read(3);
  text.language = read(4);
  text.script = read(5);
  text.halign = read(6);
  text.valign = read(7);
  text.spacing = read_number(statement, 8, warnings).value_or(text.spacing);
  warn_if_not_finite(statement, {text.size, text.spacing}, warnings);
  return text;
}

Import make_import(const Statement& statement, Warnings& warnings) {
  // Very old files say filename and layername.
  const auto given = [&](size_t index, size_t old) {
    return defined_argument(statement, index) ? index : old;
  };
  Import import;
  import.file = read_string(statement, given(0, 9), warnings).value_or("");
  import.layer = read_string(statement, given(1, 10), warnings);
  if (const Value* const origin = defined_argument(statement, 3)) {
    const std::optional<Vec2> xy = as_vec2(*origin);
    if (!xy || !is_finite(*xy)) {
      warn(statement, "origin is not a vector of two numbers; it is ignored", warnings);
    } else {
      import.origin = *xy;
    }
  }
  import.scale = read_number(statement, 4, warnings).value_or(import.scale);
  // What OpenSCAD does with a scale that is none.
  if (!(import.scale > 0) || !std::isfinite(import.scale)) import.scale = 1;
  read_bool(statement, 5, import.center, warnings);
  import.dpi = read_number(statement, 6, warnings).value_or(import.dpi);
  if (!(import.dpi >= 0.001) || !std::isfinite(import.dpi)) import.dpi = 72;
  import.id = read_string(statement, 7, warnings);
  return import;
}

HeightMap make_height_map(const Statement& statement, Warnings& warnings) {
  HeightMap map;
  map.file = read_string(statement, 0, warnings).value_or("");
  read_bool(statement, 1, map.center, warnings);
  read_bool(statement, 3, map.invert, warnings);
  return map;
}

}  // namespace whittle
