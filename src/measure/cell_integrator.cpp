#include "measure/cell_integrator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "measure/cut_patch.h"
#include "measure/truth.h"
#include "subdivide/classify.h"

namespace whittle {
namespace {

double volume_of(const Box& box) {
  const Vec3 size = box.size();
  return size.x * size.y * size.z;
}

int longest_axis(Vec3 size) {
  return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

void add_box(const Box& box, Integral& out) {
  out.add(moved(box_moments(box.size() * 0.5), box.center()));
}

/// Half of the box, as nothing is known of it but that `surfaces` may be in there.
void add_unknown(const Box& box, double surfaces, Integral& out) {
  const Vec3 half = box.size() * 0.5;
  Moments moments = box_moments(half);
  for (double& moment : moments) moment /= 2;
  Moments bounds = weighted(volume_of(box) / 2, box.center(), half);
  bounds[kArea] = surfaces * most_area(half);
  out.add(moved(moments, box.center()), bounds);
}

/// Of a part of a box, or of the rest of it.
Moments within(Moments moments, bool complement, Vec3 half) {
  if (!complement) return moments;
  const Moments whole = box_moments(half);
  for (size_t m = 0; m < kArea; ++m) moments[m] = whole[m] - moments[m];
  return moments;
}

}  // namespace

std::vector<PlacedHalfSpace> CellIntegrator::place(const Scene& scene) {
  std::vector<PlacedHalfSpace> half_spaces(scene.half_spaces.size());
  for (uint32_t i = 0; i < half_spaces.size(); ++i) half_spaces[i] = {i, -1};
  return half_spaces;
}

void CellIntegrator::add(CellLink link, const Box& box, double each, uint64_t most, Integral& out) {
  each_ = each, most_ = most;
  if (link.kind() == CellKind::kFull) add_box(box, out);
  if (!is_leaf(link.kind())) return;
  const std::span<const LeafLiteral> literals = link.leaf().literals();
  if (literals.size() > kTableLiterals) return add_program(link, box, out);
  used_.clear();
  for (const LeafLiteral& literal : literals) used_.push_back(literal.literal >> 1);
  add_table({box, full_table(link.leaf().table, uint32_t(used_.size()))}, out);
}

/// Splits until few half-spaces are left in each part.
void CellIntegrator::add_program(CellLink link, const Box& whole, Integral& out) {
  local_.clear();
  function_.set(link, half_spaces_, local_);
  const std::span<const uint32_t> all = local_.all();
  struct Item {
    Box box;
    std::vector<PlaneSide> sides;
  };
  std::vector<Item> items;
  items.push_back({whole, std::vector<PlaneSide>(all.size())});
  while (!items.empty()) {
    Item item = std::move(items.back());
    items.pop_back();
    if (++parts_ > most_) return;
    const CellBox cell(item.box, 0);
    used_.clear();
    std::vector<uint32_t> open;
    for (uint32_t i = 0; i < all.size(); ++i) {
      if (item.sides[i] != 0) continue;
      const Side side = classify(scene_.half_spaces[all[i]], cell);
      if (side == Side::kCrosses) {
        open.push_back(i);
        used_.push_back(all[i]);
      } else {
        item.sides[i] = side == Side::kInside ? -1 : 1;
      }
    }
    LeafFunction::State state = function_.start();
    if (const std::optional<bool> value = function_.at(state, item.sides).value) {
      if (*value) add_box(item.box, out);
      continue;
    }
    if (open.size() <= kTableLiterals) {
      uint64_t table = 0;
      for (uint32_t row = 0; row < 1u << open.size(); ++row) {
        for (size_t i = 0; i < open.size(); ++i) item.sides[open[i]] = row >> i & 1 ? -1 : 1;
        state = function_.start();
        table |= uint64_t(function_.at(state, item.sides).value.value_or(false)) << row;
      }
      add_table({item.box, full_table(table, uint32_t(open.size()))}, out);
      continue;
    }
    if (volume_of(item.box) / 2 <= each_) {
      add_unknown(item.box, double(open.size()), out);
      continue;
    }
    const int axis = longest_axis(item.box.size());
    Item upper = item;
    item.box.hi[axis] = upper.box.lo[axis] = item.box.center()[axis];
    items.push_back(std::move(upper));
    items.push_back(std::move(item));
  }
}

void CellIntegrator::add_table(const Part& whole, Integral& out) {
  stack_.assign(1, whole);
  while (!stack_.empty() && parts_ <= most_) {
    const Part part = stack_.back();
    stack_.pop_back();
    ++parts_;
    look_at(part, out);
  }
}

void CellIntegrator::look_at(Part part, Integral& out) {
  const CellBox cell(part.box, 0);
  std::array<Quadric, kTableLiterals> surfaces;
  std::array<uint32_t, kTableLiterals> numbers{};
  size_t count = 0;
  for (uint32_t i = 0; i < used_.size(); ++i) {
    if (!depends_on(part.table, i)) continue;
    const Side side = classify(scene_.half_spaces[used_[i]], cell);
    if (side == Side::kCrosses)
      numbers[count++] = i;
    else
      part.table = cofactor(part.table, i, side == Side::kInside);
  }
  if (part.table == 0) return;
  if (part.table == ~uint64_t(0)) return add_box(part.box, out);
  // What is left of the literals comes first in a table of its own.
  size_t left = 0;
  uint64_t table = 0;
  for (size_t i = 0; i < count; ++i)
    if (depends_on(part.table, numbers[i])) numbers[left++] = numbers[i];
  for (uint32_t row = 0; row < 1u << left; ++row) {
    uint32_t of_part = 0;
    for (size_t i = 0; i < left; ++i) of_part |= (row >> i & 1) << numbers[i];
    table |= (part.table >> of_part & 1) << row;
  }
  table = full_table(table, uint32_t(left));
  for (size_t i = 0; i < left; ++i)
    surfaces[i] = quadric_about(scene_.half_spaces[used_[numbers[i]]], cell.center);

  const bool is_lone = left == 1 && !scene_.half_spaces[used_[numbers[0]]].is_plane();
  if (is_lone) add_surface(part, surfaces[0], table & 1, out);
  if (!is_lone) add_planes(part, {surfaces.data(), left}, table, out);
}

/// Of one curved surface; or splits the part. `complement`: the solid is where f > 0.
void CellIntegrator::add_surface(const Part& part, const Quadric& f, bool complement,
                                 Integral& out) {
  const Vec3 half = part.box.size() * 0.5, center = part.box.center();
  const Vec3 slope = abs(f.b);
  std::array<int, 3> axes{0, 1, 2};
  std::sort(axes.begin(), axes.end(), [&](int a, int b) { return slope[a] > slope[b]; });
  std::optional<GraphPatch> leaving;
  int leaving_axis = 0, worst_axis = -1;
  for (const int axis : axes) {
    const std::optional<GraphPatch> patch = GraphPatch::make(f, half, axis);
    if (!patch) continue;
    if (!patch->is_within()) {
      if (!leaving) leaving = patch, leaving_axis = axis;
      continue;
    }
    for (const size_t points : {2, 4, 6, 9}) {
      const GraphPatch::Bound bound = patch->bound(gauss_, points);
      worst_axis = bound.worst_axis;
      if (!(bound.volume <= each_)) continue;
      const Moments bounds = patch->bounds(gauss_, bound, center);
      if (!(bounds[kArea] * area_weight_ <= each_)) {
        const int i = (axis + 1) % 3, j = (axis + 2) % 3;
        worst_axis = half[i] >= half[j] ? i : j;
        continue;
      }
      out.add(moved(within(patch->moments(gauss_.rule(points)), complement, half), center), bounds);
      return;
    }
  }
  if (worst_axis >= 0) {
    split(part, worst_axis);
    return;
  }
  if (leaving && add_cut(part, leaving_axis, *leaving, complement, out)) return;
  if (leaving && shrink(part, leaving_axis, *leaving)) return;
  add_planes(part, {&f, 1}, full_table(complement ? 1 : 2, 1), out);
}

/// Of a surface that leaves through an end; or splits the part. False if that is not how it lies.
bool CellIntegrator::add_cut(const Part& part, int axis, const GraphPatch& surface, bool complement,
                             Integral& out) {
  const Vec3 half = part.box.size() * 0.5, center = part.box.center();
  int worst_axis = -1;
  for (const int along : {(axis + 1) % 3, (axis + 2) % 3}) {
    const std::optional<CutPatch> patch = CutPatch::make(surface, along);
    if (!patch) continue;
    for (const size_t points : {4, 6, 9}) {
      const CutPatch::Bound bound = patch->bound(gauss_, points);
      if (!(bound.volume < kInfinity)) break;
      worst_axis = bound.worst_axis;
      if (!(bound.volume <= each_)) continue;
      const Moments bounds = patch->bounds(gauss_, bound, center);
      if (!(bounds[kArea] * area_weight_ <= each_)) {
        worst_axis = longest_axis(half);
        continue;
      }
      out.add(moved(within(patch->moments(gauss_.rule(points)), complement, half), center), bounds);
      return true;
    }
  }
  if (worst_axis >= 0) split(part, worst_axis);
  return worst_axis >= 0;
}

/// Cuts off what is beyond the surface on either side, if that is much.
bool CellIntegrator::shrink(const Part& part, int axis, const GraphPatch& patch) {
  constexpr double kSlack = 0.1, kMuch = 0.7;
  const double middle = part.box.center()[axis];
  const double slack = kSlack * (patch.high() - patch.low());
  const double low = std::max(part.box.lo[axis], middle + patch.low() - slack);
  const double high = std::min(part.box.hi[axis], middle + patch.high() + slack);
  if (!(low < high) || high - low > kMuch * part.box.size()[axis]) return false;
  Part below = part, above = part, rest = part;
  below.box.hi[axis] = rest.box.lo[axis] = low;
  above.box.lo[axis] = rest.box.hi[axis] = high;
  if (below.box.lo[axis] < low) stack_.push_back(below);
  if (above.box.hi[axis] > high) stack_.push_back(above);
  stack_.push_back(rest);
  return true;
}

/// With planes in place of the surfaces, if that is good enough; or splits the part.
void CellIntegrator::add_planes(const Part& part, std::span<const Quadric> surfaces, uint64_t table,
                                Integral& out) {
  const Vec3 half = part.box.size() * 0.5, center = part.box.center();
  std::array<CellPlane, kTableLiterals> planes;
  double bound = 0, slabs = 0;
  for (uint32_t i = 0; i < surfaces.size(); ++i) {
    planes[i] = cell_plane(surfaces[i], half);
    const double slab = slab_volume(planes[i], half);
    slabs += 2 * slab;
    // What is gained on one side of the plane can not be lost on the other.
    bound += is_monotone(table, i) ? slab : 2 * slab;
  }
  const double all = volume_of(part.box);
  bound = std::min(bound, all), slabs = std::min(slabs, all);
  if (!(bound <= each_)) {
    split(part, best_split(surfaces, half));
    return;
  }
  const PlaneCell cell{{planes.data(), surfaces.size()}, table, half};
  const AreaBounds area = surface_area(cell);
  if (!(area.bound * area_weight_ <= each_)) {
    split(part, longest_axis(half));
    return;
  }
  Moments moments = solid_moments(cell);
  Moments bounds = weighted(slabs, center, half);
  moments[kArea] = area.area;
  bounds[kVolume] = bound, bounds[kArea] = area.bound;
  out.add(moved(moments, center), bounds);
}

void CellIntegrator::split(const Part& part, int axis) {
  Part low = part, high = part;
  low.box.hi[axis] = high.box.lo[axis] = part.box.center()[axis];
  stack_.push_back(high);
  stack_.push_back(low);
}

}  // namespace whittle
