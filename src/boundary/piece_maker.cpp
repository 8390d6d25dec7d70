#include "boundary/piece_maker.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace whittle {

PointCache::Entry& PointCache::find(const std::array<uint32_t, 3>& planes) {
  uint64_t hash = 0;
  for (const uint32_t plane : planes)
    hash = (hash ^ plane) * 0x9e3779b97f4a7c15, hash ^= hash >> 32;
  const size_t mask = entries_.size() - 1;
  size_t at = hash & mask;
  while (entries_[at].when == now_ && entries_[at].planes != planes) at = (at + 1) & mask;
  return entries_[at];
}

uint32_t& PointCache::number(std::array<uint32_t, 3> planes) {
  std::sort(planes.begin(), planes.end());
  Entry* entry = &find(planes);
  if (entry->when == now_) return entry->number;
  if (2 * ++count_ > entries_.size()) {
    const std::vector<Entry> before =
        std::exchange(entries_, std::vector<Entry>(2 * entries_.size()));
    for (const Entry& old : before)
      if (old.when == now_) find(old.planes) = old;
    entry = &find(planes);
  }
  *entry = {now_, planes, kNone};
  return entry->number;
}

/// A plane's part over a rectangle square to an axis to which the plane is not parallel. Runs
/// counter-clockwise seen from the plane's positive side.
PieceMaker::Polygon PieceMaker::rectangle(uint32_t plane, int axis, const CellSides& sides) {
  const size_t u = size_t(axis + 1) % 3, v = size_t(axis + 2) % 3;
  const std::array<uint32_t, 4> around = {sides.lo[v], sides.hi[u], sides.hi[v], sides.lo[u]};
  Polygon polygon;
  const bool is_turned = geometry_.plane(plane).n[size_t(axis)] < 0;
  for (size_t i = 0; i < 4; ++i) {
    const size_t at = is_turned ? 3 - i : i, before = (at + 3) % 4;
    const uint32_t point = uint32_t(points_.size());
    points_.push_back(geometry_.about(plane, around[before], around[at]));
    polygon.push_back({point, is_turned ? around[before] : around[at]});
  }
  return polygon;
}

void PieceMaker::look(const Polygon& polygon, uint32_t by, bool& has_below, bool& has_above) {
  signs_.clear();
  has_below = has_above = false;
  for (const Corner& corner : polygon) {
    const PlaneSide side = geometry_.side(points_[corner.point], by);
    signs_.push_back(side);
    has_below = has_below || side < 0;
    has_above = has_above || side > 0;
  }
}

void PieceMaker::cut(const Polygon& polygon, uint32_t plane, uint32_t by, PlaneSide keep,
                     Polygon& part) {
  part.clear();
  for (size_t i = 0; i < polygon.size(); ++i) {
    const int here = signs_[i] * keep, after = signs_[(i + 1) % polygon.size()] * keep;
    const Corner& corner = polygon[i];
    if (here >= 0) part.push_back({corner.point, here == 0 && after < 0 ? by : corner.edge_plane});
    if (here * after >= 0) continue;
    const uint32_t point = uint32_t(points_.size());
    points_.push_back(geometry_.about(plane, corner.edge_plane, by));
    part.push_back({point, here > 0 ? by : corner.edge_plane});
  }
}

void PieceMaker::clip(Polygon& polygon, uint32_t by, PlaneSide keep, uint32_t plane) {
  if (polygon.empty()) return;
  bool has_below, has_above;
  look(polygon, by, has_below, has_above);
  const bool has_kept = keep < 0 ? has_below : has_above,
             has_rest = keep < 0 ? has_above : has_below;
  if (!has_kept) polygon.clear();
  if (!has_kept || !has_rest) return;
  Polygon part;
  cut(polygon, plane, by, keep, part);
  polygon = std::move(part);
}

OwnerFunction::Answer PieceMaker::owner(std::span<const PlaneSide> sides) const {
  const OwnerFunction::Answer low = below_owner_.at(sides);
  if (low.is_asking) return low;
  const OwnerFunction::Answer high = above_owner_.at(sides);
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
  uint32_t first = function_below.owner(scene_, own);
  if (const uint32_t other = function_above.owner(scene_, own);
      first == kSharedOwner || (other != kSharedOwner && other < first))
    first = other;
  const bool has_paints = paints_.are_several(plane);
  if (has_paints) {
    below_owner_.set(below, scene_, half_spaces_, local_, own);
    above_owner_.set(above, scene_, half_spaces_, local_, own);
  }
  const size_t first_edge = out.edges.size(), first_piece = out.count,
               first_owner = out.owners.size();
  open_.clear();
  open_.push_back({std::move(polygon), std::vector<PlaneSide>(local_.all().size(), 0)});
  while (!open_.empty()) {
    Open part = std::move(open_.back());
    open_.pop_back();
    while (true) {
      // The plane itself has each of the two on one side.
      part.sides[own] = -1;
      const LeafFunction::Answer low = function_below.at(part.sides, part.below_from);
      part.sides[own] = 1;
      const LeafFunction::Answer high = function_above.at(part.sides, part.above_from);
      uint32_t asks = low.value ? high.asks : low.asks;
      if (low.value && high.value) {
        if (*low.value == *high.value) break;
        const OwnerFunction::Answer its =
            has_paints ? owner(part.sides) : OwnerFunction::Answer{first};
        if (!its.is_asking) {
          const uint32_t id = its.id == kSharedOwner ? first : its.id;
          const uint32_t painted = has_paints ? paints_.painted(plane, id) : plane;
          const Pieces::Owner owned{sheet_of(painted, *high.value), id};
          emit(part.polygon, owned.sheet, out);
          if (out.owners.size() == first_owner || out.owners.back() != owned)
            out.owners.push_back(owned);
          break;
        }
        asks = its.asks;
      }
      const uint32_t by = local_.all()[asks];
      bool has_below, has_above;
      look(part.polygon, by, has_below, has_above);
      if (has_below && has_above) {
        Open other{{}, part.sides, part.below_from, part.above_from};
        cut(part.polygon, plane, by, 1, other.polygon);
        other.sides[asks] = 1;
        Polygon rest;
        cut(part.polygon, plane, by, -1, rest);
        part.polygon = std::move(rest);
        open_.push_back(std::move(other));
      }
      part.sides[asks] = has_below ? -1 : 1;
    }
  }
  if (out.count > first_piece + 1) cancel(first_edge, out);
}

void PieceMaker::emit(const Polygon& polygon, Sheet sheet, Pieces& out) {
  const bool is_turned = sheet & 1;
  numbers_.clear();
  for (const Corner& corner : polygon) {
    const std::array<uint32_t, 3>& planes = points_[corner.point].planes;
    uint32_t& number = emitted_.number(planes);
    if (number == PointCache::kNone) {
      number = uint32_t(out.points.size());
      out.points.push_back(geometry_.meet(planes[0], planes[1], planes[2]));
    }
    numbers_.push_back(number);
  }
  for (size_t i = 0; i < polygon.size(); ++i) {
    const uint32_t from = numbers_[i], to = numbers_[(i + 1) % polygon.size()];
    out.edges.push_back(
        {sheet, polygon[i].edge_plane, is_turned ? to : from, is_turned ? from : to});
  }
  ++out.count;
}

/// Leaves out the edges from `first` on of which there are two that run opposite ways.
void PieceMaker::cancel(size_t first, Pieces& out) {
  const auto key = [](const Pieces::Edge& edge) {
    const auto [low, high] = std::minmax(edge.from, edge.to);
    return std::tuple(low, high, edge.sheet);
  };
  const auto begin = out.edges.begin() + std::ptrdiff_t(first);
  std::sort(begin, out.edges.end(),
            [&](const Pieces::Edge& a, const Pieces::Edge& b) { return key(a) < key(b); });
  auto kept = begin;
  for (auto edge = begin; edge != out.edges.end(); ++edge) {
    if (kept != begin && key(*(kept - 1)) == key(*edge) && (kept - 1)->from == edge->to)
      --kept;
    else
      *kept++ = *edge;
  }
  out.edges.erase(kept, out.edges.end());
}

void PieceMaker::within(CellLink leaf, const CellSides& cell, Pieces& out) {
  local_.clear();
  emitted_.clear();
  below_.set(leaf, half_spaces_, local_);
  const std::vector<uint32_t> planes(local_.all().begin(), local_.all().end());
  for (const uint32_t plane : planes) {
    const auto is_side = [&](const std::array<uint32_t, 3>& sides) {
      return std::find(sides.begin(), sides.end(), plane) != sides.end();
    };
    if (is_side(cell.lo) || is_side(cell.hi)) continue;
    points_.clear();
    const int axis = largest_axis(geometry_.plane(plane));
    Polygon polygon = rectangle(plane, axis, cell);
    clip(polygon, cell.lo[size_t(axis)], 1, plane);
    clip(polygon, cell.hi[size_t(axis)], -1, plane);
    if (!polygon.empty()) fill(std::move(polygon), plane, leaf, leaf, out);
  }
}

void PieceMaker::between(CellLink below, CellLink above, int axis, const CellSides& sides,
                         Pieces& out) {
  local_.clear();
  emitted_.clear();
  below_.set(below, half_spaces_, local_);
  above_.set(above, half_spaces_, local_);
  points_.clear();
  const uint32_t plane = sides.lo[size_t(axis)];
  fill(rectangle(plane, axis, sides), plane, below, above, out);
}

}  // namespace whittle
