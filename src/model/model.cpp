#include "model/model.h"

#include <cmath>

#include <fmt/format.h>

namespace whittle {

namespace {

bool is_size(double x) {
  return x > 0 && std::isfinite(x);
}
bool is_radius(double x) {
  return x >= 0 && std::isfinite(x);
}

struct IsEmpty {
  bool operator()(const Cube& s) const {
    return !(is_size(s.size.x) && is_size(s.size.y) && is_size(s.size.z));
  }
  bool operator()(const Sphere& s) const { return !is_size(s.r); }
  bool operator()(const Cylinder& s) const {
    return !(is_size(s.h) && is_radius(s.r1) && is_radius(s.r2) && s.r1 + s.r2 > 0);
  }
  bool operator()(const Polyhedron& s) const { return s.planes.empty(); }
  bool operator()(const Mesh& s) const { return !s.surface || s.surface->triangles.empty(); }
  bool operator()(const Halfspace& s) const {
    return !(is_finite(s.n) && std::isfinite(s.d)) || s.n == Vec3{};
  }
};

}  // namespace

bool is_empty(const Shape& shape) {
  return std::visit(IsEmpty{}, shape);
}

std::string message_at(const std::string& file, SourceLocation where, const std::string& message) {
  return fmt::format("{}:{}:{}: {}", file, where.line, where.column, message);
}

}  // namespace whittle
