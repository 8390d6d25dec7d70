#include "boundary/face_maker.h"

#include <algorithm>
#include <utility>

#include "boundary/face_context.h"
#include "subdivide/formula_size.h"
#include "subdivide/subdivide.h"

namespace whittle {
namespace {

/// Faces that so few half-spaces reach are cut by these; the rest are cut in two first.
constexpr uint32_t kFewHalfSpaces = 24;
/// Where a face has more parts than this that something reaches, many faces do: cells look at all
/// of them together. After so many of them in a group the rest is not tried.
constexpr size_t kMostParts = 64, kMostCrowded = 40;
/// What the parts of a face read of formulas before no more are made, and longer formulas cut it.
constexpr size_t kMostRead = size_t(1) << 24;

bool has_boundary(const Scene& scene, std::span<const Token> formula) {
  return !scene.boundaries.empty() && count_boundaries(scene, formula) > 0;
}

}  // namespace

FaceMaker::FaceMaker(const Scene& scene, const UnitBoxes& boxes, const ExactGeometry& geometry,
                     std::span<const PlacedHalfSpace> half_spaces, const Paints& paints,
                     const CuttingPlanes& cuts, double per_unit, FacePlan* plan)
    : scene_(scene),
      half_spaces_(half_spaces),
      cuts_(cuts),
      per_unit_(per_unit),
      plan_(plan),
      pieces_(scene, geometry, half_spaces, paints),
      simplifier_(scene, boxes, max_component(scene.region.size()) * kCellMargin),
      analysis_(scene) {}

void FaceMaker::make(const UnitGroup& group, Pieces& out) {
  leaves_ = Arena();
  crowded_ = 0;
  for (uint32_t i = group.first; i < group.last; ++i) body(plan_->units[i], group.formula, out);
}

Truth FaceMaker::simplify(const Formula& context, const Box& box, Formula& out) {
  return simplifier_.simplify(context, box, expand_of(expanded_size(scene_, context)), out);
}

void FaceMaker::body(uint32_t number, std::span<const Token> formula, Pieces& out) {
  const Unit& unit = scene_.units[number];
  if (!context_of(scene_, formula, number, context_, is_negated_)) return;
  const Box around = intersect(unit.outer, scene_.region);
  if (around.is_empty()) return;
  const Truth truth = simplify(context_, around, simpler_);
  if (truth == Truth::kFalse) return;
  std::swap(context_, simpler_);
  pieces_.begin_body();
  if (unit.first_box == Unit::kNoBoxes) {
    for (uint32_t k = 0; k < unit.face_count; ++k)
      face(unit, k, context_, truth == Truth::kTrue, out);
    return;
  }
  boxes_.set(std::span(scene_.face_boxes).subspan(unit.first_box, unit.face_count));
  const Affine local_from_own = inverse(scene_.box_frames[unit.box_frame]);
  size_t patches = 0;
  const auto add_patch = [&](FaceBoxes::Node node, bool is_boundary) -> Formula& {
    if (patches == patches_.size()) patches_.emplace_back();
    patches_[patches].node = node;
    patches_[patches].is_boundary = is_boundary;
    return patches_[patches++].context;
  };
  std::swap(add_patch(boxes_.root(), truth == Truth::kTrue), context_);
  while (patches > 0) {
    const Patch& top = patches_[--patches];
    const FaceBoxes::Node node = top.node;
    const bool is_boundary = top.is_boundary;
    if (node.level == 0) {
      face(unit, node.index, top.context, is_boundary, out);
      continue;
    }
    std::swap(context_, patches_[patches].context);
    for (uint32_t i = boxes_.first_below(node); i < boxes_.last_below(node); ++i) {
      const FaceBoxes::Node below{node.level - 1, i};
      if (is_boundary) {
        add_patch(below, true);
        continue;
      }
      const Box box = intersect(transform(local_from_own, boxes_.box(below)), around);
      if (box.is_empty()) continue;
      const Truth its_truth = simplify(context_, box, simpler_);
      if (its_truth == Truth::kFalse) continue;
      std::swap(add_patch(below, its_truth == Truth::kTrue), simpler_);
    }
  }
}

/// The half-spaces of a body that bound one of its faces.
void FaceMaker::list_around(const Unit& unit, uint32_t face) {
  around_.clear();
  const uint32_t plane = half_spaces_[scene_.faces[unit.first_face + face].literal >> 1].plane;
  const auto add = [&](uint32_t k) {
    const Literal literal = scene_.faces[unit.first_face + k].literal;
    const PlacedHalfSpace& placed = half_spaces_[literal >> 1];
    if (placed.plane == plane) return;
    around_.push_back({placed.plane, PlaneSide(literal & 1 ? -placed.inside : placed.inside)});
  };
  if (unit.first_box != Unit::kNoBoxes) {
    // What is not near has no edge in common with it.
    boxes_.neighbours(face, near_);
    for (const uint32_t k : near_) add(k);
    return;
  }
  for (uint32_t k = 0; k < unit.face_count; ++k)
    if (k != face) add(k);
}

void FaceMaker::face(const Unit& unit, uint32_t number, const Formula& context, bool is_boundary,
                     Pieces& out) {
  const Literal literal = scene_.faces[unit.first_face + number].literal;
  const PlacedHalfSpace& placed = half_spaces_[literal >> 1];
  if (plan_->is_whole[placed.plane] == 0) return;
  const bool may_leave = plan_->is_whole[placed.plane] == FacePlan::kSingle;
  if (may_leave && !is_boundary && crowded_ > kMostCrowded) {
    plan_->is_whole[placed.plane] = 0;
    return;
  }
  list_around(unit, number);
  const PieceMaker::Polygon polygon = pieces_.begin_face(placed.plane, around_, cuts_.region());
  if (polygon.count == 0) return;
  solid_side_ = bool(literal & 1) != is_negated_ ? PlaneSide(-placed.inside) : placed.inside;
  ++pairs_;
  if (is_boundary) {
    add(polygon, placed.plane, CellLink(CellKind::kFull, nullptr), unit.id);
  } else {
    parts_.clear();
    parts_.push_back({polygon, context});
    if (!cut(placed.plane, unit.id, may_leave)) {
      plan_->is_whole[placed.plane] = 0;
      return;
    }
  }
  pieces_.end_face(out);
}

/// Puts two parts in the place of one that has `simpler_` for its context. False if it cannot be
/// cut.
bool FaceMaker::halve(PieceMaker::Polygon polygon, uint32_t plane, const Box& box) {
  // Well inside of the box, which is larger than the part by what doubles do not know of it.
  constexpr double kInside = 1e-3;
  const int axis = split_axis(box.size(), SplitRule::kLongest, 0);
  const double inside = kInside * box.size()[axis];
  const auto at = cuts_.between(axis, box.lo[axis] + inside, box.hi[axis] - inside);
  if (!at) return false;
  const auto [below, above] = pieces_.halves(polygon, plane, at->plane);
  if (below.count == 0 || above.count == 0) return false;
  parts_.push_back({above, simpler_});
  parts_.push_back({below, simpler_});
  return true;
}

/// Adds those parts of a face, beginning with all of it, that are boundary. False if that is not
/// known.
bool FaceMaker::cut(uint32_t plane, uint32_t owner, bool may_leave) {
  size_t read = 0, seen = 0;
  while (!parts_.empty()) {
    Part part = std::move(parts_.back());
    parts_.pop_back();
    Box box = pieces_.box_of(part.polygon);
    box = intersect({box.lo / per_unit_, box.hi / per_unit_}, scene_.region);
    if (box.is_empty()) continue;
    const Truth truth = simplify(part.context, box, simpler_);
    if (truth == Truth::kFalse) continue;
    if (truth == Truth::kTrue) {
      add(part.polygon, plane, CellLink(CellKind::kFull, nullptr), owner);
      continue;
    }
    if (has_boundary(scene_, simpler_)) return false;
    read += part.context.size();
    if (++seen == kMostParts && ++crowded_ > kMostCrowded && may_leave) return false;
    if (expanded_size(scene_, simpler_) > kFewHalfSpaces && read <= kMostRead &&
        !has_few_half_spaces(scene_, simpler_) && halve(part.polygon, plane, box))
      continue;
    if (has_units(simpler_)) {
      const Truth all = simplifier_.simplify(simpler_, box, Expand::kAll, part.context);
      if (all == Truth::kFalse) continue;
      if (all == Truth::kTrue) part.context.assign(1, Token::make(TokenKind::kAnd, 1));
    } else {
      std::swap(part.context, simpler_);
    }
    analysis_.analyse(part.context);
    pairs_ += analysis_.size();
    CellLink link(analysis_.constant_value() ? CellKind::kFull : CellKind::kEmpty, nullptr);
    if (analysis_.size() > 0) link = analysis_.write(leaves_);
    add(part.polygon, plane, link, owner);
  }
  return true;
}

void FaceMaker::add(PieceMaker::Polygon polygon, uint32_t plane, CellLink context, uint32_t owner) {
  const CellLink empty(CellKind::kEmpty, nullptr);
  if (solid_side_ < 0)
    pieces_.add_part(polygon, plane, context, empty, owner);
  else
    pieces_.add_part(polygon, plane, empty, context, owner);
}

}  // namespace whittle
