#include "lower/merge.h"

#include <utility>

namespace whittle {

namespace {

HalfSpaceTable table_for(const Box& region, double tolerance) {
  return {max_component(region.size()) / 2, tolerance};
}

}  // namespace

FaceMerger::FaceMerger(const Box& region, double tolerance, double together)
    : region_(region),
      tolerance_(std::max(tolerance, together)),
      together_(together),
      table_(table_for(region, equal_tolerance(tolerance_, together))) {}

Literal FaceMerger::add(const HalfSpace& face, const Reach& primitive, const Outline& outline) {
  Reach fine = primitive;
  fine.tolerance = equal_tolerance(primitive.tolerance, together_);
  if (face.is_plane()) {
    // Equal planes are equal everywhere, not only where one of the primitives is.
    fine.center = region_.center();
    fine.radius = 0.5 * region_.diagonal();
  }
  const Literal literal = table_.add(face, fine, outline);
  const Extent extent = {primitive.center, primitive.radius, primitive.width};
  if (literal >> 1 == written_.size()) {
    written_.push_back({primitive, extent});
  } else {
    Written& known = written_[literal >> 1];
    known.extent = united(known.extent, extent);
    if (primitive.tolerance > known.reach.tolerance) known.reach = primitive;
  }
  return literal;
}

FaceMerger::Merged FaceMerger::merge(const Outlines& outlines) {
  Merged merged;
  HalfSpaceTable table = table_for(region_, tolerance_);
  merged.literals.reserve(written_.size());
  const std::vector<HalfSpace> half_spaces =
      std::exchange(table_, table_for(region_, tolerance_)).take();
  for (uint32_t i = 0; i < written_.size(); ++i) {
    const auto& [primitive, extent] = written_[i];
    Reach all = primitive;
    all.tolerance = joint_tolerance(primitive.tolerance, extent.width, together_);
    if (half_spaces[i].is_plane()) {
      all.center = extent.center;
      all.radius = extent.radius;
    }
    merged.literals.push_back(table.add(half_spaces[i], all, outlines(i)));
  }
  merged.half_spaces = table.take();
  return merged;
}

}  // namespace whittle
