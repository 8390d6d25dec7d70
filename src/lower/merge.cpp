#include "lower/merge.h"

#include <algorithm>

namespace whittle {

FaceMerger::FaceMerger(const Box& region, double tolerance, double together)
    : region_(region),
      tolerance_(std::max(tolerance, together)),
      together_(together),
      table_(max_component(region.size()) / 2, tolerance_) {}

Literal FaceMerger::add(const HalfSpace& face, const Reach& primitive, const Outline& outline) {
  Reach equal = primitive;
  equal.tolerance = equal_tolerance(primitive.tolerance, together_);
  if (face.is_plane()) {
    // Equal planes are equal everywhere, not only where one of the primitives is.
    equal.center = region_.center();
    equal.radius = 0.5 * region_.diagonal();
  }
  const Literal literal = table_.add(face, primitive, equal, outline);
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

FaceMerger::Merged FaceMerger::merge(const Outlines& outlines) const {
  Merged merged;
  merged.literals.reserve(written_.size());
  merged.moved.assign(written_.size(), 0);
  // Only those that may lie on others are looked at.
  HalfSpaceTable table(max_component(region_.size()) / 2, tolerance_);
  std::vector<uint32_t> written_as;  // of those in the table
  for (uint32_t i = 0; i < written_.size(); ++i) {
    merged.literals.push_back(2 * i);
    if (!table_.is_crowded(i)) continue;
    const HalfSpace& half_space = table_[i];
    Reach all = reaches_[written_[i].reach];
    const Extent extent =
        written_[i].extent == kOne ? extent_of(all) : extents_[written_[i].extent];
    all.tolerance = joint_tolerance(all.tolerance, extent.width, together_);
    if (half_space.is_plane()) {
      all.center = extent.center;
      all.radius = extent.radius;
    }
    const Literal literal = table.add(half_space, all, outlines(i));
    if (literal >> 1 == written_as.size()) written_as.push_back(i);
    merged.literals[i] = 2 * written_as[literal >> 1] + (literal & 1);
    if (written_as[literal >> 1] != i) merged.moved[i] = float(all.tolerance);
  }
  return merged;
}

}  // namespace whittle
