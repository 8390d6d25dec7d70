#include "boundary/piece_maker.h"

#include <algorithm>
#include <tuple>

namespace whittle {

PointNames::Entry& PointNames::find(const std::array<uint32_t, 3>& planes) {
  uint64_t hash = 0;
  for (const uint32_t plane : planes)
    hash = (hash ^ plane) * 0x9e3779b97f4a7c15, hash ^= hash >> 32;
  const size_t mask = entries_.size() - 1;
  size_t at = hash & mask;
  while (entries_[at].when == now_ && names_[entries_[at].name].planes != planes)
    at = (at + 1) & mask;
  return entries_[at];
}

uint32_t PointNames::add(const std::array<uint32_t, 3>& planes) {
  std::array<uint32_t, 3> sorted = planes;
  std::sort(sorted.begin(), sorted.end());
  Entry* entry = &find(sorted);
  if (entry->when == now_) return entry->name;
  const auto name = uint32_t(names_.size());
  if (2 * (names_.size() + 1) > entries_.size()) {
    entries_.assign(2 * entries_.size(), {});
    for (uint32_t i = 0; i < names_.size(); ++i) find(names_[i].planes) = {now_, i};
    entry = &find(sorted);
  }
  *entry = {now_, name};
  names_.push_back({sorted, kNone});
  return name;
}

/// A plane's part over a rectangle square to an axis to which the plane is not parallel. Runs
/// counter-clockwise seen from the plane's positive side.
PieceMaker::Polygon PieceMaker::rectangle(uint32_t plane, int axis, const CellSides& sides) {
  const size_t u = size_t(axis + 1) % 3, v = size_t(axis + 2) % 3;
  const std::array<uint32_t, 4> around = {sides.lo[v], sides.hi[u], sides.hi[v], sides.lo[u]};
  const Polygon polygon{uint32_t(corners_.size()), 4};
  const bool is_turned = geometry_.plane(plane).n[size_t(axis)] < 0;
  for (size_t i = 0; i < 4; ++i) {
    const size_t at = is_turned ? 3 - i : i, before = (at + 3) % 4;
    corners_.push_back({uint32_t(points_.size()), is_turned ? around[before] : around[at]});
    points_.push_back(geometry_.about(plane, around[before], around[at]));
  }
  return polygon;
}

PieceMaker::Polygon PieceMaker::part_in(uint32_t plane, const CellSides& box) {
  points_.clear();
  corners_.clear();
  const int axis = largest_axis(geometry_.plane(plane));
  Polygon polygon = rectangle(plane, axis, box);
  polygon = clip(polygon, plane, box.lo[size_t(axis)], 1);
  if (polygon.count > 0) polygon = clip(polygon, plane, box.hi[size_t(axis)], -1);
  return polygon;
}

void PieceMaker::look(Polygon polygon, uint32_t by, bool& has_below, bool& has_above) {
  signs_.clear();
  has_below = has_above = false;
  for (uint32_t i = 0; i < polygon.count; ++i) {
    const PlaneSide side = geometry_.side(points_[corners_[polygon.first + i].point], by);
    signs_.push_back(side);
    has_below = has_below || side < 0;
    has_above = has_above || side > 0;
  }
}

PieceMaker::Polygon PieceMaker::cut(Polygon polygon, uint32_t plane, uint32_t by, PlaneSide keep) {
  const auto first = uint32_t(corners_.size());
  for (uint32_t i = 0; i < polygon.count; ++i) {
    const uint32_t next = i + 1 < polygon.count ? i + 1 : 0;
    const int here = signs_[i] * keep, after = signs_[next] * keep;
    const Corner corner = corners_[polygon.first + i];
    if (here >= 0)
      corners_.push_back({corner.point, here == 0 && after < 0 ? by : corner.edge_plane});
    if (here * after >= 0) continue;
    corners_.push_back({uint32_t(points_.size()), here > 0 ? by : corner.edge_plane});
    points_.push_back(geometry_.about(plane, corner.edge_plane, by));
  }
  return {first, uint32_t(corners_.size()) - first};
}

PieceMaker::Polygon PieceMaker::clip(Polygon polygon, uint32_t plane, uint32_t by, PlaneSide keep) {
  bool has_below, has_above;
  look(polygon, by, has_below, has_above);
  const bool has_kept = keep < 0 ? has_below : has_above,
             has_rest = keep < 0 ? has_above : has_below;
  if (!has_kept) return {};
  return has_rest ? cut(polygon, plane, by, keep) : polygon;
}

void PieceMaker::learn(Open& part, uint32_t local_plane, PlaneSide side, const LeafFunction& below,
                       const LeafFunction& above) {
  sides_[local_plane] = side;
  known_.push_back(local_plane);
  below.learn(part.below, local_plane, side);
  above.learn(part.above, local_plane, side);
}

/// Splits a polygon where the functions ask for it, and emits what is solid on one side alone.
void PieceMaker::split(Polygon polygon, uint32_t plane, uint32_t own, const LeafFunction& below,
                       const LeafFunction& above) {
  sides_.assign(local_.all().size(), 0);
  known_.clear();
  open_.clear();
  Open part{polygon, below.start(), above.start()};
  // The plane itself has each of the two on one side.
  below.learn(part.below, own, -1);
  above.learn(part.above, own, 1);
  while (true) {
    sides_[own] = -1;
    const LeafFunction::Answer low = below.at(part.below, sides_);
    sides_[own] = 1;
    const LeafFunction::Answer high = above.at(part.above, sides_);
    uint32_t asks = low.value ? high.asks : low.asks;
    const bool is_boundary = low.value && high.value && *low.value != *high.value;
    OwnerFunction::Answer its{first_owner_};
    if (is_boundary && has_paints_) {
      its = owner();
      asks = its.asks;
    }
    if (low.value && high.value && !its.is_asking) {
      if (is_boundary) {
        const uint32_t id = its.id == kSharedOwner ? first_owner_ : its.id;
        const uint32_t painted = keeps_paints_ ? paints_.painted(plane, id) : plane;
        emit(part.polygon, {sheet_of(painted, *high.value), id});
      }
      if (open_.empty()) return;
      part = open_.back();
      open_.pop_back();
      for (; known_.size() > part.known; known_.pop_back()) sides_[known_.back()] = 0;
      learn(part, part.asked, 1, below, above);
      continue;
    }
    const uint32_t by = local_.all()[asks];
    bool has_below, has_above;
    look(part.polygon, by, has_below, has_above);
    if (has_below && has_above) {
      open_.push_back(
          {cut(part.polygon, plane, by, 1), part.below, part.above, uint32_t(known_.size()), asks});
      part.polygon = cut(part.polygon, plane, by, -1);
    }
    learn(part, asks, has_below ? -1 : 1, below, above);
  }
}

/// The same where the function on both sides is one conjunction or one disjunction: the plane's
/// side decides where all others leave it to that.
void PieceMaker::clip_group(Polygon polygon, uint32_t plane, uint32_t own,
                            const LeafFunction& group) {
  const bool is_conjunction = group.kind() == CellKind::kConjunction;
  PlaneSide own_side = 0;
  for (const LeafFunction::Literal& literal : group.literals()) {
    // Where the literal leaves it to the others.
    const PlaneSide side =
        literal.negated == is_conjunction ? PlaneSide(-literal.inside) : literal.inside;
    if (literal.local == own) {
      if (own_side == -side) return;
      own_side = side;
    } else {
      polygon = clip(polygon, plane, local_.all()[literal.local], side);
      if (polygon.count == 0) return;
    }
  }
  emit(polygon, {sheet_of(plane, (own_side > 0) == is_conjunction), first_owner_});
}

OwnerFunction::Answer PieceMaker::owner() const {
  const OwnerFunction::Answer low = below_owner_.at(sides_);
  if (low.is_asking) return low;
  const OwnerFunction::Answer high = above_owner_.at(sides_);
  if (high.is_asking || low.id == kSharedOwner) return high;
  return high.id != kSharedOwner && high.id < low.id ? high : low;
}

/// `below` and `above` are what below_ and above_ are of.
void PieceMaker::fill(Polygon polygon, uint32_t plane, CellLink below, CellLink above,
                      Pieces& out) {
  const bool is_one_cell = below.bits() == above.bits();
  const LeafFunction& function_below = below_;
  const LeafFunction& function_above = is_one_cell ? below_ : above_;
  const uint32_t own = local_.add(plane);
  first_owner_ = function_below.owner(scene_, own);
  if (!is_one_cell) {
    const uint32_t other = function_above.owner(scene_, own);
    if (first_owner_ == kSharedOwner || (other != kSharedOwner && other < first_owner_))
      first_owner_ = other;
  }
  has_paints_ = keeps_paints_ = paints_.are_several(plane);
  if (has_paints_) {
    below_owner_.set(below, scene_, half_spaces_, local_, own);
    above_owner_.set(above, scene_, half_spaces_, local_, own);
  }
  begin_plane();
  const bool is_group =
      below.kind() == CellKind::kConjunction || below.kind() == CellKind::kDisjunction;
  if (is_one_cell && is_group && !has_paints_)
    clip_group(polygon, plane, own, function_below);
  else
    split(polygon, plane, own, function_below, function_above);
  end_plane(out);
}

void PieceMaker::begin_plane() {
  edges_.clear();
  owned_.clear();
  pieces_ = 0;
}

void PieceMaker::end_plane(Pieces& out) {
  if (pieces_ > 1) cancel();
  if (edges_.empty()) return;
  for (const Pieces::Owner& owned : owned_) {
    const auto is_on = [&](const Pieces::Edge& edge) { return edge.sheet == owned.sheet; };
    if (std::any_of(edges_.begin(), edges_.end(), is_on)) out.owners.push_back(owned);
  }
  release(out);
}

void PieceMaker::emit(Polygon polygon, Pieces::Owner owned) {
  const Sheet sheet = owned.sheet;
  const bool is_turned = sheet & 1;
  numbers_.clear();
  for (uint32_t i = 0; i < polygon.count; ++i)
    numbers_.push_back(names_.add(points_[corners_[polygon.first + i].point].planes));
  for (uint32_t i = 0; i < polygon.count; ++i) {
    const uint32_t from = numbers_[i], to = numbers_[i + 1 < polygon.count ? i + 1 : 0];
    edges_.push_back({sheet, corners_[polygon.first + i].edge_plane, is_turned ? to : from,
                      is_turned ? from : to});
  }
  ++pieces_;
  if (std::find(owned_.begin(), owned_.end(), owned) == owned_.end()) owned_.push_back(owned);
}

/// Leaves out the edges of which there are two that run opposite ways.
void PieceMaker::cancel() {
  const auto key = [](const Pieces::Edge& edge) {
    const auto [low, high] = std::minmax(edge.from, edge.to);
    return std::tuple(low, high, edge.sheet);
  };
  std::sort(edges_.begin(), edges_.end(),
            [&](const Pieces::Edge& a, const Pieces::Edge& b) { return key(a) < key(b); });
  auto kept = edges_.begin();
  for (const Pieces::Edge& edge : edges_) {
    if (kept != edges_.begin() && key(*(kept - 1)) == key(edge) && (kept - 1)->from == edge.to)
      --kept;
    else
      *kept++ = edge;
  }
  edges_.erase(kept, edges_.end());
}

/// Only what is left needs its points exactly.
void PieceMaker::release(Pieces& out) {
  const auto number = [&](uint32_t name) {
    PointNames::Name& named = names_[name];
    if (named.number == PointNames::kNone) {
      named.number = uint32_t(out.points.size());
      out.points.push_back(geometry_.meet(named.planes[0], named.planes[1], named.planes[2]));
    }
    return named.number;
  };
  for (const Pieces::Edge& edge : edges_)
    out.edges.push_back({edge.sheet, edge.plane, number(edge.from), number(edge.to)});
  out.count += pieces_;
}

void PieceMaker::within(CellLink leaf, const CellSides& cell, Pieces& out) {
  local_.clear();
  names_.clear();
  below_.set(leaf, half_spaces_, local_);
  const std::vector<uint32_t> planes(local_.all().begin(), local_.all().end());
  for (const uint32_t plane : planes) {
    const auto is_side = [&](const std::array<uint32_t, 3>& sides) {
      return std::find(sides.begin(), sides.end(), plane) != sides.end();
    };
    if (is_side(cell.lo) || is_side(cell.hi)) continue;
    if (plane < left_out_.size() && left_out_[plane] != 0) continue;
    const Polygon polygon = part_in(plane, cell);
    if (polygon.count > 0) fill(polygon, plane, leaf, leaf, out);
  }
}

void PieceMaker::between(CellLink below, CellLink above, int axis, const CellSides& sides,
                         Pieces& out) {
  local_.clear();
  names_.clear();
  below_.set(below, half_spaces_, local_);
  above_.set(above, half_spaces_, local_);
  points_.clear();
  corners_.clear();
  const uint32_t plane = sides.lo[size_t(axis)];
  fill(rectangle(plane, axis, sides), plane, below, above, out);
}

PieceMaker::Polygon PieceMaker::begin_face(uint32_t plane, std::span<const HalfPlane> around,
                                           const CellSides& region) {
  begin_plane();
  Polygon polygon = part_in(plane, region);
  for (size_t i = 0; i < around.size() && polygon.count > 0; ++i)
    polygon = clip(polygon, plane, around[i].plane, around[i].side);
  return polygon;
}

Box PieceMaker::box_of(Polygon polygon) const {
  Box box;
  for (uint32_t i = 0; i < polygon.count; ++i) {
    const ApproximatePoint& point = points_[corners_[polygon.first + i].point];
    const Vec3 error{point.error, point.error, point.error};
    box.include(point.y - error);
    box.include(point.y + error);
  }
  return box;
}

std::array<PieceMaker::Polygon, 2> PieceMaker::halves(Polygon polygon, uint32_t plane,
                                                      uint32_t by) {
  bool has_below, has_above;
  look(polygon, by, has_below, has_above);
  if (!has_above) return {polygon, Polygon{}};
  if (!has_below) return {Polygon{}, polygon};
  const Polygon below = cut(polygon, plane, by, -1);
  return {below, cut(polygon, plane, by, 1)};
}

void PieceMaker::add_part(Polygon polygon, uint32_t plane, CellLink below, CellLink above,
                          uint32_t owner) {
  local_.clear();
  below_.set(below, half_spaces_, local_);
  above_.set(above, half_spaces_, local_);
  first_owner_ = owner;
  has_paints_ = false;
  keeps_paints_ = paints_.are_several(plane);
  split(polygon, plane, local_.add(plane), below_, above_);
}

}  // namespace whittle
