#include "subdivide/simplify.h"

#include <algorithm>
#include <array>
#include <bit>

#include "lower/evaluate.h"

namespace whittle {
namespace {

/// A primitive with no more faces than this in a cell is left as it is there.
constexpr size_t kFewFacets = 4;

Truth truth(Side side, bool negated) {
  if (side == Side::kCrosses) return Truth::kVaries;
  return (side == Side::kInside) != negated ? Truth::kTrue : Truth::kFalse;
}

}  // namespace

/// True if a group of this kind, `depth` groups below the top, stands in one of its own kind.
bool Simplifier::joins_group_around(TokenKind kind, size_t depth) const {
  return depth > 0 && open_[depth - 1].kind == kind;
}

Truth Simplifier::unit(Token token, const CellBox& cell, double cell_edge, Expand expand,
                       Formula& out, Kept& kept) {
  const Unit& unit = scene_.units[token.payload()];
  const bool negated = token.negated();
  const Side side = classify_bounds(unit, cell);
  if (side != Side::kCrosses) return truth(side, negated);
  if (!unit.is_conjunction()) return boundary(token, cell, expand, out, kept);
  if (expand == Expand::kNone ||
      (expand == Expand::kLarge && cell_edge > max_component(unit.outer.size()))) {
    out.push_back(token);
    return Truth::kVaries;
  }
  // The complement of a conjunction is the disjunction of complements.
  Open faces{negated ? TokenKind::kOr : TokenKind::kAnd, 0, uint32_t(out.size()), 0, {}};
  out.push_back({});
  const auto face_at = [&](uint32_t k) { return unit.first_face + k; };
  const Truth value = conjunction(face_at, unit.face_count, negated, cell, out);
  if (value != Truth::kVaries) {
    out.resize(faces.header);
    return value;
  }
  faces.operands = uint32_t(out.size()) - faces.header - 1;
  open_.push_back(faces);
  kept = close_group(faces, out);
  open_.pop_back();
  return Truth::kVaries;
}

/// A boundary of which nothing is in the cell is decided there. Else it stays whole, or a formula
/// is made of what is.
Truth Simplifier::boundary(Token token, const CellBox& cell, Expand expand, Formula& out,
                           Kept& kept) {
  const Unit& unit = scene_.units[token.payload()];
  const bool negated = token.negated();
  const ListedTriangles known = near_.next(token.payload());
  if (expand != Expand::kAll) {
    const uint32_t half_spaces = bsp_.count(unit, cell, known);
    if (half_spaces == 0)
      return truth(bsp_.is_inside(unit, cell) ? Side::kInside : Side::kOutside, negated);
    const ListedTriangles listed = bsp_.listed();
    counted_.push_back({token.payload(), half_spaces, uint32_t(listed_.size()),
                        listed ? uint32_t(listed->size()) : NearTriangles::kMany});
    if (listed) listed_.insert(listed_.end(), listed->begin(), listed->end());
    out.push_back(token);
    return Truth::kVaries;
  }
  const std::span<const Token> formula = bsp_.formula(unit, cell, negated, known);
  const Token head = formula[0];
  if (!head.is_group()) {
    out.push_back(head);
    return Truth::kVaries;
  }
  if (head.payload() == 1) return head.kind() == TokenKind::kAnd ? Truth::kTrue : Truth::kFalse;
  const Open group{head.kind(), 0, uint32_t(out.size()), bsp_.operands(), {}};
  out.insert(out.end(), formula.begin(), formula.end());
  open_.push_back(group);
  kept = close_group(group, out);
  open_.pop_back();
  return Truth::kVaries;
}

/// Appends to `out` those faces of one primitive that matter in the cell. What the faces given say
/// inside the cell must be all that the primitive says there.
template <class FaceAt>
Truth Simplifier::conjunction(FaceAt&& face_at, uint32_t count, bool negated, const CellBox& cell,
                              Formula& out) {
  const size_t first = out.size();
  for (uint32_t k = 0; k < count; ++k) {
    const uint32_t face = face_at(k);
    const Side side = classify(scene_, scene_.faces[face].literal, cell);
    if (side == Side::kOutside) {
      out.resize(first);
      return truth(side, negated);
    }
    if (side == Side::kCrosses) out.push_back(Token::make(TokenKind::kFace, face, negated));
  }
  if (out.size() - first > kFewFacets) {
    const Unit& unit = scene_.units[scene_.faces[face_at(0)].unit];
    if (unit.first_box != Unit::kNoBoxes) drop_far_facets(unit, cell, first, out);
  }
  const size_t crossing = out.size() - first;
  if (tight_ && crossing > 1 && crossing <= kFewFacets && !settle_pairs(cell, first, out))
    return truth(Side::kOutside, negated);
  return crossing > 0 ? Truth::kVaries : truth(Side::kInside, negated);
}

/// Looks at the faces of one primitive two by two: a face beyond which nothing of another one is in
/// the cell says nothing there and is dropped. False if two of them have nothing in common in the
/// cell; then `out` ends at `first`.
bool Simplifier::settle_pairs(const CellBox& cell, size_t first, Formula& out) const {
  std::array<Bound, kFewFacets> bounds;
  size_t count = out.size() - first;
  // Nothing is to be found out where all are square to the axes.
  const auto is_square = [&](Token token) {
    const HalfSpace& h = scene_.half_spaces[scene_.faces[token.payload()].literal >> 1];
    return h.is_plane() && (h.f.b.x == 0) + (h.f.b.y == 0) + (h.f.b.z == 0) == 2;
  };
  if (std::all_of(out.end() - std::ptrdiff_t(count), out.end(), is_square)) return true;
  for (size_t i = 0; i < count; ++i)
    bounds[i] = outer_bound(scene_, scene_.faces[out[first + i].payload()].literal, cell);
  for (size_t i = 0; i < count; ++i)
    for (size_t j = 0; j < i; ++j)
      if (are_apart(bounds[i], bounds[j], cell.half, margin_)) {
        out.resize(first);
        return false;
      }
  for (size_t j = count; j-- > 0;) {
    if (!bounds[j].is_plane) continue;
    const Bound beyond{-bounds[j].n, -bounds[j].value, true};
    for (size_t i = 0; i < count; ++i) {
      if (i == j || !are_apart(bounds[i], beyond, cell.half, margin_)) continue;
      out.erase(out.begin() + std::ptrdiff_t(first + j));
      std::copy(bounds.begin() + std::ptrdiff_t(j) + 1, bounds.begin() + std::ptrdiff_t(count),
                bounds.begin() + std::ptrdiff_t(j));
      --count;
      break;
    }
  }
  return true;
}

/// Drops the faces whose facet does not reach the cell. All around a finely facetted body the
/// planes of many facets cross a cell; but if the body has a point in the cell, then its part there
/// is bounded by the facets that reach the cell alone: a segment in the cell from that point to one
/// outside of the body leaves the body through such a facet, and its plane excludes the rest.
void Simplifier::drop_far_facets(const Unit& unit, const CellBox& cell, size_t first,
                                 Formula& out) const {
  const Affine& own_from_local = scene_.box_frames[unit.box_frame];
  const Vec3 center = own_from_local.point(cell.center);
  Vec3 half;
  for (int axis = 0; axis < 3; ++axis) half[axis] = dot(abs(own_from_local.row[axis]), cell.half);
  const Vec3 lo = center - half, hi = center + half;
  const auto is_far = [&](Token token) {
    const Box& box = scene_.face_boxes[unit.first_box + token.payload() - unit.first_face];
    return hi.x < box.lo.x || hi.y < box.lo.y || hi.z < box.lo.z || lo.x > box.hi.x ||
           lo.y > box.hi.y || lo.z > box.hi.z;
  };
  const auto begin = out.begin() + std::ptrdiff_t(first);
  if (std::none_of(begin, out.end(), is_far)) return;
  if (!meets(std::span<const Token>(out).subspan(first), cell)) return;
  out.erase(std::remove_if(begin, out.end(), is_far), out.end());
}

/// Whether the conjunction of these faces surely has a point in the cell: its middle or a corner.
/// No is no proof.
bool Simplifier::meets(std::span<const Token> faces, const CellBox& cell) const {
  const auto holds = [&](Vec3 p) {
    return std::all_of(faces.begin(), faces.end(), [&](Token token) {
      return contains(scene_, scene_.faces[token.payload()].literal, p);
    });
  };
  if (holds(cell.center)) return true;
  for (int i = 0; i < 8; ++i)
    if (holds(cell.center + Vec3{i & 1 ? cell.half.x : -cell.half.x,
                                 i & 2 ? cell.half.y : -cell.half.y,
                                 i & 4 ? cell.half.z : -cell.half.z}))
      return true;
  return false;
}

/// Writes the header of the innermost open group, which has kept at least one operand.
Simplifier::Kept Simplifier::close_group(const Open& group, Formula& out) const {
  const size_t depth = open_.size() - 1;
  const uint32_t length = uint32_t(out.size()) - group.header;
  if (joins_group_around(group.kind, depth)) {
    out[group.header] = Token::make(group.kind, length, true);
    return {group.operands, kNone, 0};
  }
  if (group.operands > 1) {
    out[group.header] = Token::make(group.kind, length);
    return {1, group.header, group.operands};
  }
  // One operand is left, which takes the group's place. If it is a group, it may now stand in one
  // of its own kind.
  out[group.header] = Token::make(group.kind, length, true);
  const Kept& only = group.last;
  if (only.header == kNone || !joins_group_around(out[only.header].kind(), depth)) return only;
  const Token header = out[only.header];
  out[only.header] = Token::make(header.kind(), header.payload(), true);
  return {only.in_group, kNone, 0};
}

Truth Simplifier::simplify(std::span<const Token> in, const Box& cell_box, Expand expand,
                           Formula& out, std::span<const uint32_t> near) {
  const CellBox cell(cell_box, margin_);
  const double cell_edge = max_component(cell_box.size());
  tight_ = expand == Expand::kUnits || expand == Expand::kAll;
  counted_.clear();
  listed_.clear();
  near_ = NearTriangles(near);
  out.clear();
  open_.clear();
  const bool in_batches = boxes_.are_worth_it(in.size());
  UnitBoxes::Batch batch;
  uint32_t batch_first = 0, batch_end = 0;
  uint32_t i = 0;
  while (true) {
    // One operand. Primitives beside the cell are found many at a time, and those that say nothing
    // in their group there are passed over together.
    // Without batches the batch stays empty, and each token is the first of it.
    if (i >= batch_end) {
      batch_first = i;
      if (in_batches) {
        batch_end = std::min(uint32_t(in.size()), i + UnitBoxes::kBatch);
        batch = boxes_.look_at(in.subspan(i, batch_end - i), cell);
      }
    }
    if (!open_.empty()) {
      const Open& group = open_.back();
      const uint32_t keeps = group.kind == TokenKind::kAnd ? batch.negated : ~batch.negated;
      const uint32_t neutral = (batch.beside & keeps) | (batch.within & ~keeps);
      const uint32_t count = uint32_t(std::countr_one(neutral >> (i - batch_first)));
      if (const uint32_t skipped = std::min(count, group.in_end - 1 - i); skipped > 0) {
        i += skipped;
        continue;
      }
    }
    const Token token = in[i];
    Truth value = Truth::kVaries;
    Kept kept;
    if (token.is_pass()) {
      ++i;
      continue;
    }
    if (token.is_group() && token.payload() > 1) {
      open_.push_back({token.kind(), i + token.payload(), uint32_t(out.size()), 0, {}});
      out.push_back(token);
      ++i;
      continue;
    }
    if (token.is_group()) {
      value = token.kind() == TokenKind::kAnd ? Truth::kTrue : Truth::kFalse;
    } else if (const uint32_t bit = 1u << (i - batch_first); (batch.beside & bit) != 0) {
      value = truth(Side::kOutside, token.negated());
    } else if ((batch.within & bit) != 0) {
      value = truth(Side::kInside, token.negated());
    } else if ((batch.balls & bit) != 0) {
      out.push_back(token);
    } else if (token.kind() == TokenKind::kUnit) {
      value = unit(token, cell, cell_edge, expand, out, kept);
    } else if (const Face& face = scene_.faces[token.payload()];
               !scene_.units[face.unit].is_conjunction()) {
      // What a boundary said in a larger cell: each of its planes is a literal by itself.
      const Side side = classify(scene_, face.literal, cell);
      value = truth(side, token.negated());
      kept.operands = value == Truth::kVaries;
      if (value == Truth::kVaries) out.push_back(token);
    } else {
      // The faces of one primitive stand in a row.
      const uint32_t first = i;
      const auto face_at = [&](uint32_t k) { return in[first + k].payload(); };
      const uint32_t unit_number = scene_.faces[token.payload()].unit;
      while (i + 1 < in.size() && in[i + 1].kind() == TokenKind::kFace &&
             scene_.faces[in[i + 1].payload()].unit == unit_number)
        ++i;
      const size_t before = out.size();
      const Side side = classify_bounds(scene_.units[unit_number], cell);
      value = side == Side::kCrosses
                  ? conjunction(face_at, i + 1 - first, token.negated(), cell, out)
                  : truth(side, token.negated());
      kept.operands = uint32_t(out.size() - before);
    }
    ++i;

    // Hand its value to the group around it, and close every group that this ends.
    while (true) {
      if (open_.empty()) return value;
      Open& group = open_.back();
      const Truth absorbing = group.kind == TokenKind::kAnd ? Truth::kFalse : Truth::kTrue;
      if (value == absorbing) {
        out.resize(group.header);
        i = group.in_end;
      } else {
        if (value == Truth::kVaries) {
          group.operands += kept.operands;
          group.last = kept;
        }
        if (i < group.in_end) break;
        if (group.operands == 0) {
          value = absorbing == Truth::kFalse ? Truth::kTrue : Truth::kFalse;
          out.resize(group.header);
        } else {
          value = Truth::kVaries;
          kept = close_group(group, out);
        }
      }
      open_.pop_back();
    }
  }
}

/// Calls visit(what was counted) for the boundaries in the formula written last. They stand in the
/// order in which they were counted.
template <class Visit>
void Simplifier::for_each_counted(std::span<const Token> written, const Visit& visit) const {
  if (counted_.empty()) return;
  auto next = counted_.begin();
  for (const Token token : written) {
    if (!is_boundary(scene_, token)) continue;
    while (next->unit != token.payload()) ++next;
    visit(*next++);
  }
}

Simplifier::Size Simplifier::size_of(std::span<const Token> written) const {
  Size size{expanded_size(scene_, written), false};
  for_each_counted(written, [&](const Counted& counted) {
    if (counted.half_spaces == LocalBsp::kTooMany)
      size.is_crowded = true;
    else
      size.literals -= kManyLiterals - counted.half_spaces;
  });
  return size;
}

void Simplifier::list_near(std::span<const Token> written, std::vector<uint32_t>& near) const {
  near.clear();
  for_each_counted(written, [&](const Counted& counted) {
    ListedTriangles triangles;
    if (counted.number != NearTriangles::kMany)
      triangles = std::span(listed_).subspan(counted.first, counted.number);
    NearTriangles::add(counted.unit, triangles, near);
  });
}

}  // namespace whittle
