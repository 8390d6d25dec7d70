// What every shape must say of itself.
//
// A shape is a struct of numbers with the members below, in a file of its own in this folder. A
// struct that lacks one of them does not compile as a Shape. Code elsewhere does not ask which
// shape it has. Sizes are in model units, coordinates are the shape's own, and `map` leads from
// them to where it stands. Except for is_empty() and facet_count(), the shape must not be empty and
// the map not singular.
#pragma once

#include <cmath>
#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/affine.h"
#include "base/box.h"
#include "base/plane.h"
#include "shape/extent.h"
#include "shape/triangle_mesh.h"
#include "shape/wall.h"

namespace whittle {

/// What has one that is none of these is empty.
inline bool is_size(double x) {
  return x > 0 && std::isfinite(x);
}

/// A shape that may be curved: `facets` is 0 if it is, else the number of sides (3 or more) of the
/// circle that it is made of instead; and that circle's largest radius, which decides how many.
template <class S>
concept Curved = requires(S& shape, const S& read) {
  { shape.facets } -> std::same_as<int&>;
  { read.widest_radius() } -> std::same_as<double>;
  { read.wall() } -> std::same_as<std::optional<Wall>>;
};

/// A shape that never is.
template <class S>
concept FlatFaced = requires(const S& shape) {
  { shape.wall() } -> std::same_as<std::nullopt_t>;
};

template <class S>
concept CompleteShape = requires(const S& shape, const Affine& map, std::span<const Vec3> outline,
                                 std::span<const Plane> planes) {
  requires Curved<S> || FlatFaced<S>;
  /// For people and scripts: OpenSCAD's word, where it has one.
  { S::kName } -> std::convertible_to<std::string_view>;
  /// Its faces lie where a few numbers say, and not where the digits of corners leave them.
  { S::kIsExact } -> std::convertible_to<bool>;
  /// It is the empty set, as with a size that is not positive or not finite.
  { shape.is_empty() } -> std::same_as<bool>;
  /// How many facets it takes of those that a file may have. Those that are always there, and
  /// few, do not count.
  { shape.facet_count() } -> std::same_as<uint64_t>;
  /// Its flat faces as planes with outward normals.
  { shape.facet_planes() } -> std::same_as<std::vector<Plane>>;
  /// How many those are.
  { shape.plane_count() } -> std::same_as<size_t>;
  /// Points that stand for its surface: the corners of a flat one, points on the wall of a
  /// curved one; none if it is unbounded.
  { shape.outline() } -> std::same_as<std::vector<Vec3>>;
  /// The box of every facet of a flat one, in the order of facet_planes().
  { shape.facet_boxes() } -> std::same_as<std::vector<Box>>;
  /// What it is the inside of; null: it is the conjunction of its wall and planes.
  { shape.boundary() } -> std::same_as<const TriangleMesh*>;
  /// Its exact box. A half-space whose plane is square to an axis has half of everything, any
  /// other has everything.
  { shape.box(map) } -> std::same_as<Box>;
  /// A box around it, cheap rather than tight; of what is unbounded the points of its surface
  /// that are nearest to the origin.
  { shape.finite_box(map) } -> std::same_as<Box>;
  /// Its outline() and facet_planes() are at hand. That of a true ball may be left out.
  { shape.extent(outline, planes, map) } -> std::same_as<Extent>;
};

}  // namespace whittle
