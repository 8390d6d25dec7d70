// The shapes that primitives are made of. What each of them says of itself: complete_shape.h.
#pragma once

#include <array>
#include <type_traits>
#include <variant>

#include "shape/complete_shape.h"
#include "shape/cube.h"
#include "shape/cylinder.h"
#include "shape/halfspace.h"
#include "shape/mesh.h"
#include "shape/polyhedron.h"
#include "shape/sphere.h"

namespace whittle {

template <CompleteShape S>
using Complete = S;  ///< so the compiler names the shape and what it lacks
template <class... S>
using OneOf = std::variant<Complete<S>...>;

using Shape = OneOf<Cube, Sphere, Cylinder, Polyhedron, Halfspace, Mesh>;

/// By Shape::index().
inline constexpr auto kShapeNames = []<class... S>(std::type_identity<std::variant<S...>>) {
  return std::array{S::kName...};
}(std::type_identity<Shape>{});

// What a shape says of itself, whichever it is. Preconditions: complete_shape.h.

bool is_empty(const Shape& shape);
bool is_exact(const Shape& shape);
uint64_t facet_count(const Shape& shape);
std::optional<Wall> wall(const Shape& shape);
std::vector<Plane> facet_planes(const Shape& shape);
size_t plane_count(const Shape& shape);
std::vector<Vec3> outline(const Shape& shape);
std::vector<Box> facet_boxes(const Shape& shape);
const TriangleMesh* boundary(const Shape& shape);
Box shape_box(const Shape& shape, const Affine& map);
Box finite_box(const Shape& shape, const Affine& map);
Extent extent(const Shape& shape, std::span<const Vec3> outline, std::span<const Plane> planes,
              const Affine& map);

/// The same with its own outline and planes.
Extent extent(const Shape& shape, const Affine& map);

/// True if $fn, $fa and $fs say something about it.
bool may_be_curved(const Shape& shape);

/// True if the shape has only flat faces.
inline bool is_flat(const Shape& shape) {
  return !wall(shape);
}

}  // namespace whittle
