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
  if (reaches_.empty() || reaches_.back() != primitive) reaches_.push_back(primitive);
  const auto reach = uint32_t(reaches_.size() - 1);
  if (literal >> 1 == written_.size()) {
    written_.push_back({reach, kOne});
    return literal;
  }
  Written& known = written_[literal >> 1];
  if (known.extent == kOne) {
    known.extent = uint32_t(extents_.size());
    extents_.push_back(extent_of(reaches_[known.reach]));
  }
  Extent& extent = extents_[known.extent];
  extent = united(extent, extent_of(primitive));
  if (primitive.tolerance > reaches_[known.reach].tolerance) known.reach = reach;
  return literal;
}

FaceMerger::Merged FaceMerger::merge(const Outlines& outlines) {
  Merged merged;
  HalfSpaceTable table = table_for(region_, tolerance_);
  table.reserve(written_.size());
  merged.literals.reserve(written_.size());
  const std::vector<HalfSpace> half_spaces =
      std::exchange(table_, table_for(region_, tolerance_)).take();
  for (uint32_t i = 0; i < written_.size(); ++i) {
    Reach all = reaches_[written_[i].reach];
    const Extent extent =
        written_[i].extent == kOne ? extent_of(all) : extents_[written_[i].extent];
    all.tolerance = joint_tolerance(all.tolerance, extent.width, together_);
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
