#include "shape/shape.h"

#include "base/result.h"

namespace whittle {

bool is_empty(const Shape& shape) {
  return std::visit([](const auto& s) { return s.is_empty(); }, shape);
}

bool is_exact(const Shape& shape) {
  return std::visit([](const auto& s) { return s.kIsExact; }, shape);
}

bool may_be_curved(const Shape& shape) {
  return std::visit([]<class S>(const S&) { return Curved<S>; }, shape);
}

uint64_t facet_count(const Shape& shape) {
  return std::visit([](const auto& s) { return s.facet_count(); }, shape);
}

std::optional<Wall> wall(const Shape& shape) {
  return std::visit([](const auto& s) -> std::optional<Wall> { return s.wall(); }, shape);
}

std::vector<Plane> facet_planes(const Shape& shape) {
  WHITTLE_CHECK(!is_empty(shape));
  return std::visit([](const auto& s) { return s.facet_planes(); }, shape);
}

size_t plane_count(const Shape& shape) {
  return std::visit([](const auto& s) { return s.plane_count(); }, shape);
}

std::vector<Vec3> outline(const Shape& shape) {
  WHITTLE_CHECK(!is_empty(shape));
  return std::visit([](const auto& s) { return s.outline(); }, shape);
}

std::vector<Box> facet_boxes(const Shape& shape) {
  return std::visit([](const auto& s) { return s.facet_boxes(); }, shape);
}

const TriangleMesh* boundary(const Shape& shape) {
  return std::visit([](const auto& s) { return s.boundary(); }, shape);
}

Box shape_box(const Shape& shape, const Affine& map) {
  return std::visit([&](const auto& s) { return s.box(map); }, shape);
}

Box finite_box(const Shape& shape, const Affine& map) {
  return std::visit([&](const auto& s) { return s.finite_box(map); }, shape);
}

Extent extent(const Shape& shape, std::span<const Vec3> outline, std::span<const Plane> planes,
              const Affine& map) {
  return std::visit([&](const auto& s) { return s.extent(outline, planes, map); }, shape);
}

Extent extent(const Shape& shape, const Affine& map) {
  return extent(shape, outline(shape), facet_planes(shape), map);
}

}  // namespace whittle
