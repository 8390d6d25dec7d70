#include "subdivide/box_cut.h"

#include <algorithm>

#include "subdivide/reach.h"
#include "subdivide/simplify.h"

namespace whittle {
namespace {

/// A cut in the middle must be so much better than one beside a box: it may go through what is
/// there, and then both parts have the same to do.
constexpr double kMiddleBetter = 1.25;

/// How far from a box it is cut, so that no surface lies in the cut: of the box, and at least so
/// many margins.
constexpr double kBesideShare = 1e-3, kBesideMargins = 4;

/// Operands fill a cell if along every axis they are that far from their common middle, their own
/// size included: a share of what it is where each is as large as the cell.
constexpr double kFilled = 0.5;

/// So many operands, and no more than twice as many, are asked.
constexpr size_t kAsked = 64;

double half_area(Vec3 size) {
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

}  // namespace

/// As far as some of the operands tell.
bool BoxCutter::is_filled(std::span<const Token> formula, const Box& cell) const {
  const Vec3 middle = cell.center();
  Vec3 sum, sum_of_squares, sum_of_halves;
  double count = 0;
  const size_t step = 1 + formula.size() / kAsked;
  for (size_t i = 0; i < formula.size(); i += step) {
    const Token token = formula[i];
    if (token.is_group()) continue;
    const bool is_face = token.kind() == TokenKind::kFace;
    const Unit& unit = scene_.units[is_face ? scene_.faces[token.payload()].unit : token.payload()];
    const Vec3 lo = max(unit.outer.lo, cell.lo) - middle, hi = min(unit.outer.hi, cell.hi) - middle;
    const double literals = is_face ? 1 : unit.face_count;
    for (int axis = 0; axis < 3; ++axis) {
      const double twice = lo[axis] + hi[axis];
      sum[axis] += literals * twice;
      sum_of_squares[axis] += literals * twice * twice;
      sum_of_halves[axis] += literals * (hi[axis] - lo[axis]);
    }
    count += literals;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const double enough = kFilled * count * (cell.hi[axis] - cell.lo[axis]) - sum_of_halves[axis];
    const double square = count * sum_of_squares[axis] - sum[axis] * sum[axis];
    if (enough > 0 && square < enough * enough) return false;
  }
  return true;
}

/// Fills active_. A literal says something in its own box and in those of all groups around it.
void BoxCutter::find_active(std::span<const Token> formula, const Box& cell) {
  struct Open {
    size_t index;
    TokenKind kind;
    ReachOfGroup reach;
  };
  // From the bottom up: outside of which box a group has the value that settles it.
  reach_.resize(formula.size());
  std::vector<Open> open;
  walk(
      formula,
      [&](const Operand& group) {
        const TokenKind kind = group.token().kind();
        open.push_back({group.index, kind, ReachOfGroup(kind)});
      },
      [&](const Operand& operand) {
        if (!open.empty()) open.back().reach.add(reach_of(scene_, operand.token()));
      },
      [&] {
        const OperandReach reach = open.back().reach.result();
        const bool absorbs = reach.outside == (open.back().kind == TokenKind::kOr);
        reach_[open.back().index] = absorbs ? reach.box : Box::everything();
        open.pop_back();
        if (!open.empty()) open.back().reach.add(reach);
      });

  // And from the top down, what is left of the cell.
  active_.clear();
  std::vector<Box> within{cell};
  walk(
      formula,
      [&](const Operand& group) {
        within.push_back(intersect(within.back(), reach_[group.index]));
      },
      [&](const Operand& operand) {
        const Token token = operand.token();
        const Box box = intersect(within.back(), reach_of(scene_, token).box);
        const uint32_t literals = expanded_size(scene_, {&token, 1});
        // The faces of one primitive stand in a row.
        if (!active_.empty() && active_.back().box == box)
          active_.back().literals += literals;
        else if (!box.is_empty())
          active_.push_back({box, literals});
      },
      [&] { within.pop_back(); });
}

void BoxCutter::sort_bounds(int axis) {
  lows_.clear(), highs_.clear();
  for (const Active& active : active_) {
    lows_.push_back({active.box.lo[axis], double(active.literals)});
    highs_.push_back({active.box.hi[axis], double(active.literals)});
  }
  for (std::vector<Bound>* const bounds : {&lows_, &highs_}) {
    std::ranges::sort(*bounds, {}, &Bound::at);
    double sum = 0;
    for (Bound& bound : *bounds) bound.literals = sum += bound.literals;
  }
}

/// Literals that a ray through the cell will meet, up to a factor: each part is met as often as it
/// has surface. The bounds along the axis must be sorted.
double BoxCutter::cost(const Box& cell, BoxCut cut) const {
  // Of all boxes that begin, or end, before there.
  const auto literals_before = [](const std::vector<Bound>& bounds, double at) {
    const auto end = std::ranges::lower_bound(bounds, at, {}, &Bound::at);
    return end == bounds.begin() ? 0 : std::prev(end)->literals;
  };
  const double all = lows_.empty() ? 0 : lows_.back().literals;
  Vec3 low = cell.size(), high = low;
  low[cut.axis] = cut.at - cell.lo[cut.axis];
  high[cut.axis] = cell.hi[cut.axis] - cut.at;
  return half_area(low) * literals_before(lows_, cut.at + margin_) +
         half_area(high) * (all - literals_before(highs_, cut.at - margin_));
}

std::optional<BoxCut> BoxCutter::cut(std::span<const Token> formula, const Box& cell,
                                     BoxCut middle) {
  if (is_filled(formula, cell)) return std::nullopt;
  find_active(formula, cell);
  sort_bounds(middle.axis);
  double least = kMiddleBetter * cost(cell, middle);
  std::optional<BoxCut> best;
  for (int axis = 0; axis < 3; ++axis) {
    const double beside = kBesideMargins * margin_;
    const auto is_within = [&](double at) {
      return at - cell.lo[axis] > beside && cell.hi[axis] - at > beside;
    };
    const auto has_end_within = [&](const Active& active) {
      return is_within(active.box.lo[axis]) || is_within(active.box.hi[axis]);
    };
    if (std::ranges::none_of(active_, has_end_within)) continue;
    sort_bounds(axis);
    double last = -kInfinity;
    const auto consider = [&](double at) {
      if (!is_within(at) || at == last) return;
      last = at;
      const BoxCut here{axis, at};
      const double its = cost(cell, here);
      if (its < least) least = its, best = here;
    };
    for (const Active& active : active_) {
      const double away = beside + kBesideShare * (active.box.hi[axis] - active.box.lo[axis]);
      consider(active.box.lo[axis] - away);
      consider(active.box.hi[axis] + away);
    }
  }
  return best;
}

}  // namespace whittle
