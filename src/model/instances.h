// What the tree says about each of its primitives: where it stands and how it looks.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/box.h"
#include "model/model.h"

namespace whittle {

/// A primitive that takes part in the solid.
struct Instance {
  uint32_t node = 0;       ///< its node in the model
  uint32_t primitive = 0;  ///< index into Model::primitives
  bool empty = false;      ///< degenerate shape, or a singular or non-finite transform above it
  Affine world_from_object;
};

/// A stretch of the nodes, for walks that go through a model side by side.
struct InstanceRange {
  uint32_t begin = 0, end = 0;  ///< nodes
  uint32_t first = 0;           ///< how many instances stand before it
  uint32_t count = 0;           ///< how many it has
  std::vector<uint32_t> above;  ///< the transforms around its first node, from the outside in
};

/// Cuts the nodes into ranges of about so many. Where they are nested very deeply there is no cut,
/// so that ranges together never take more than the model.
std::vector<InstanceRange> instance_ranges(const Model& model, size_t nodes_each);

/// Goes through the primitives of the solid in file order; those under `%` are left out. The model
/// must outlive it.
class InstanceWalk {
 public:
  explicit InstanceWalk(const Model& model) : model_(model), end_(uint32_t(model.nodes.size())) {}
  /// Through one range alone.
  InstanceWalk(const Model& model, const InstanceRange& range);

  /// The next one; null after the last. What it points to changes with the next call.
  const Instance* next();
  /// The same, but it is not looked at whether it is empty.
  const Instance* next_place();

 private:
  struct Scope {
    uint32_t end;
    Affine world_from_parent;
  };
  const Model& model_;
  std::vector<Scope> scopes_;
  uint32_t at_ = 0;  ///< a node
  uint32_t end_;     ///< where the walk ends
  Instance instance_;
};

/// All of them.
std::vector<Instance> instances(const Model& model);

/// How the surface of a primitive is painted.
struct Appearance {
  Rgba color;        ///< the outermost valid color() above it; invalid if none
  bool cut = false;  ///< reached through an odd number of subtractions
};

/// The share of what lies behind a surface that it hides, 0 to 1; without a valid colour all of it.
inline float opacity(const Appearance& look) {
  return look.color.is_valid() && look.color.a < 1 ? look.color.a : 1.0f;
}

/// Indexed by primitive id; entry 0 (background) is a default.
std::vector<Appearance> appearances(const Model& model);

/// The id of the primitive that the solid is, if no operator had two operands to combine. Operands
/// without a primitive that is not empty count for difference and intersection, as in OpenSCAD, and
/// not for the others.
std::optional<uint32_t> lone_primitive(const Model& model);

/// Where the solid can be.
struct Bounds {
  Box box;              ///< holds the solid; empty if the solid surely is
  bool bounded = true;  ///< false: half-spaces reach out of every box; `box` then holds the finite
                        ///< primitives and the half-spaces' feet, and is never empty
};

/// Bounds by the tree's own algebra: union of boxes, intersection of boxes, difference = its first
/// operand's box. Exact boxes for every primitive under its transform.
Bounds bounds(const Model& model);
/// The same if these are at hand: box_of(i) is instance_box() of the i-th instance.
Bounds bounds(const Model& model, const std::function<Box(uint32_t)>& box_of);

/// The part of a model's box that is seen: of a drawing what is in its plane.
Box seen_box(const Model& model, Box box);

/// The exact box of one primitive where it stands; empty if it is. A half-space whose plane is
/// square to an axis is half of everything, any other is everything. Their union is OpenSCAD's
/// preview box, as bounds() with every operand in full; for framing.
Box instance_box(const Model& model, const Instance& instance);

/// The length below which two surfaces count as one: kRelativeTolerance times the longest edge of
/// the bounds (docs/decisions/0005-tolerance.md). Texts carry six digits, so nothing finer is
/// meant. Where an unbounded solid's box is one point, its largest coordinate stands for that edge,
/// or 1 at the origin.
double tolerance(const Bounds& bounds);
inline constexpr double kRelativeTolerance = 2e-6;

/// The region in which the solid is looked at: its bounds a little enlarged, or for an unbounded
/// solid a cube about their centre, kUnboundedReach times as long as their longest edge
/// (docs/conventions.md). Empty for empty bounds.
Box view_region(const Bounds& bounds);
inline constexpr double kUnboundedReach = 1000;

/// Crossings of a ray that are closer than this coincide: rounding cannot tell which comes first.
/// So a curved wall that touches a flat one along a line has one owner there (the tie rules of
/// docs/conventions.md). It is about five roundings of numbers as large as the region's size and
/// coordinates (world space); the parts of a model are many times larger. Surfaces closer than this
/// are one (own_tolerance()).
double ray_tolerance(const Box& region);

/// Warnings about transforms that flatten or are not finite, as full messages.
std::vector<std::string> transform_warnings(const Model& model);

}  // namespace whittle
