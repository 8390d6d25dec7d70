#include "csg/solids.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "csg/arguments.h"

namespace whittle {

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
  warn_if_not_finite(statement, {cube.size.x, cube.size.y, cube.size.z}, warnings);
  read_bool(statement, 1, cube.center, warnings);
  return cube;
}

Sphere make_sphere(const Statement& statement, Warnings& warnings) {
  Sphere sphere;
  sphere.r = radius(statement, 0, 1, warnings).value_or(sphere.r);
  warn_if_not_finite(statement, {sphere.r}, warnings);
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
  read_bool(statement, 3, cylinder.center, warnings);
  warn_if_not_finite(statement, {cylinder.h, cylinder.r1, cylinder.r2}, warnings);
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
    for (const Value* p = points->begin(); p != points->end(); p = p->end()) {
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
  for (const Value* f = faces->begin(); f != faces->end(); f = f->end(), ++number) {
    if (!is_vector(f)) {
      mistake = fmt::format("faces[{}] is not a vector", number);
      return {};
    }
    std::vector<uint32_t> face;
    face.reserve(f->size);
    for (const Value* corner = f->begin(); corner != f->end(); corner = corner->end()) {
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

}  // namespace whittle
