#include "subdivide/solid_bounds.h"

#include <algorithm>
#include <array>
#include <optional>
#include <queue>
#include <vector>

#include "base/workers.h"
#include "subdivide/linear_program.h"
#include "subdivide/simplify.h"

namespace whittle {
namespace {

/// Formulas of no more literals than this are looked at as a union of polytopes, if there are no
/// more polytopes than kMostTerms.
constexpr uint32_t kFewLiterals = 32;
constexpr size_t kMostTerms = 64;
/// Formulas that would have no more literals than this get all their primitives expanded.
constexpr uint32_t kExpandAll = 64;
/// Tokens that one search may classify: a number, and some passes over the formula.
constexpr size_t kMostTokens = size_t(1) << 22, kMostPasses = 32;
/// A polytope that cannot hold a ball of this radius, as a share of the accuracy, is nothing: flat
/// leftovers, points where surfaces touch. A tenth of the tolerance, which is what material must be
/// thick: texts of six digits leave such slivers.
constexpr double kNoVolume = 0.1;
/// Half-gradients shorter than this say nothing about where the surface is.
constexpr double kFlatGradient = 1e-6;

struct Farthest {
  double reach = -kInfinity;  ///< along the direction; -infinity: nothing is there
  bool exact = true;
};

/// The search in one direction, +axis or -axis.
class Search {
 public:
  Search(const Scene& scene, int axis, int sign, double accuracy)
      : scene_(scene), axis_(axis), sign_(sign), accuracy_(accuracy), simplifier_(scene, 0) {}

  Farthest run(const Box& start, size_t most_cells) {
    open_child(scene_.formula, start);
    const size_t most_tokens = kMostTokens + kMostPasses * scene_.formula.size();
    for (size_t cells = 0; !open_.empty(); ++cells) {
      // Moved out of a queue that gives const access only; it is popped at once.
      Cell cell = std::move(const_cast<Cell&>(open_.top()));
      open_.pop();
      if (cell.reach <= best_ + accuracy_) break;
      if (cells == most_cells || tokens_ > most_tokens) return {cell.reach, false};
      look_at(std::move(cell));
    }
    return {best_, true};
  }

 private:
  /// A box that may hold the farthest point, with the formula simplified for it.
  struct Cell {
    double reach;    ///< of the box
    uint64_t order;  ///< of those that reach equally far, the newest comes first: depth first
    Box box;
    Formula formula;

    bool operator<(const Cell& b) const {
      return reach != b.reach ? reach < b.reach : order < b.order;
    }
  };
  /// One polytope of a union: literals that must all hold.
  struct Term {
    std::vector<Literal> literals;
    std::vector<uint32_t> operands;  ///< tokens whose subtrees must hold too
  };

  double reach_of(Vec3 p) const { return sign_ * p[axis_]; }
  double reach_of(const Box& box) const { return sign_ > 0 ? box.hi[axis_] : -box.lo[axis_]; }
  double depth_of(const Box& box) const { return sign_ > 0 ? box.lo[axis_] : -box.hi[axis_]; }

  /// Simplifies `around` for the box and opens it, unless it is decided.
  void open_child(const Formula& around, const Box& box) {
    tokens_ += around.size();
    Formula formula;
    const bool expand_all = expanded_size(scene_, around) <= kExpandAll;
    const Truth truth = simplifier_.simplify(around, box, expand_all, formula);
    if (truth == Truth::kTrue) best_ = std::max(best_, reach_of(box));
    if (truth != Truth::kVaries) return;
    open_.push({reach_of(box), order_++, box, std::move(formula)});
  }

  void look_at(Cell cell) {
    // Only what lies beyond the best point counts.
    const double needed = best_ + accuracy_ / 2;
    if (depth_of(cell.box) < needed) {
      (sign_ > 0 ? cell.box.lo : cell.box.hi)[axis_] = sign_ * needed;
      tokens_ += cell.formula.size();
      Formula formula;
      const bool expand_all = expanded_size(scene_, cell.formula) <= kExpandAll;
      const Truth truth = simplifier_.simplify(cell.formula, cell.box, expand_all, formula);
      if (truth == Truth::kTrue) best_ = std::max(best_, reach_of(cell.box));
      if (truth != Truth::kVaries) return;
      cell.formula = std::move(formula);
    }
    int split_axis = longest_axis(cell.box);
    if (expanded_size(scene_, cell.formula) <= kFewLiterals && !has_units(cell.formula)) {
      const double reach = reach_of_terms(cell);
      if (reach <= best_ + accuracy_) return;
      if (reach < reach_of(cell.box)) {
        (sign_ > 0 ? cell.box.hi : cell.box.lo)[axis_] = sign_ * reach;
        split_axis = longest_axis(cell.box);
      }
      split_axis = most_bent_axis(cell, split_axis);
    }
    if (max_component(cell.box.size()) <= accuracy_) {
      // Too small to tell, and too small to matter.
      best_ = std::max(best_, reach_of(cell.box));
      return;
    }
    const double middle = cell.box.center()[split_axis];
    Box low = cell.box, high = cell.box;
    low.hi[split_axis] = high.lo[split_axis] = middle;
    open_child(cell.formula, low);
    open_child(cell.formula, high);
  }

  static int longest_axis(const Box& box) {
    const Vec3 size = box.size();
    return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  }

  /// The axis along which the surfaces bend most in the cell: splitting it brings them nearest to
  /// their tangent planes. `otherwise` if none bends.
  int most_bent_axis(const Cell& cell, int otherwise) const {
    const Vec3 h = cell.box.size() * 0.5;
    Vec3 bend{};
    for (const Token token : cell.formula) {
      if (token.kind() != TokenKind::kFace) continue;
      const auto& f = scene_.half_spaces[scene_.faces[token.payload()].literal >> 1].f;
      const Vec3 a = abs(f.diag), mixed = abs(f.off);
      const double yz = mixed.x * h.y * h.z, xz = mixed.y * h.x * h.z, xy = mixed.z * h.x * h.y;
      bend += {a.x * h.x * h.x + xy + xz, a.y * h.y * h.y + xy + yz, a.z * h.z * h.z + xz + yz};
    }
    if (max_component(bend) < accuracy_ * 1e-3) return otherwise;
    return bend.x >= bend.y && bend.x >= bend.z ? 0 : bend.y >= bend.z ? 1 : 2;
  }

  bool has_units(const Formula& formula) const {
    return std::ranges::any_of(formula,
                               [](Token token) { return token.kind() == TokenKind::kUnit; });
  }

  /// How far the formula can reach in the cell, and on the way the best point found in it.
  double reach_of_terms(const Cell& cell) {
    double reach = -kInfinity;
    size_t terms = 0;
    std::vector<Term> pending(1);
    push_operands(cell.formula, 0, cell.formula.size(), pending[0].operands);
    while (!pending.empty()) {
      Term term = std::move(pending.back());
      pending.pop_back();
      if (!expand(cell.formula, term, pending)) continue;
      if (++terms > kMostTerms) return reach_of(cell.box);
      reach = std::max(reach, reach_of_term(cell, term.literals));
    }
    return reach;
  }

  /// Works through the term's operands, and-groups and literals first. False if the term is
  /// impossible or was handed on as several.
  bool expand(const Formula& formula, Term& term, std::vector<Term>& pending) const {
    std::vector<uint32_t> choices;
    while (!term.operands.empty()) {
      const uint32_t i = term.operands.back();
      term.operands.pop_back();
      const Token token = formula[i];
      if (token.kind() == TokenKind::kAnd) {
        push_operands(formula, i + 1, i + token.payload(), term.operands);
      } else if (token.kind() == TokenKind::kOr) {
        choices.push_back(i);
      } else {
        const Literal literal = scene_.faces[token.payload()].literal ^ uint32_t(token.negated());
        if (std::ranges::find(term.literals, literal ^ 1) != term.literals.end()) return false;
        if (std::ranges::find(term.literals, literal) == term.literals.end())
          term.literals.push_back(literal);
      }
    }
    if (choices.empty()) return true;
    const uint32_t chosen = choices.back();
    choices.pop_back();
    std::vector<uint32_t> alternatives;
    push_operands(formula, chosen + 1, chosen + formula[chosen].payload(), alternatives);
    for (const uint32_t alternative : alternatives) {
      pending.push_back({term.literals, choices});
      pending.back().operands.push_back(alternative);
    }
    return false;
  }

  /// Appends the numbers of the operands that stand in first <= i < last. A pass header's operands
  /// are those of the group around it.
  static void push_operands(const Formula& formula, size_t first, size_t last,
                            std::vector<uint32_t>& out) {
    for (size_t i = first; i < last;) {
      const Token token = formula[i];
      if (!token.is_pass()) out.push_back(uint32_t(i));
      i += token.is_group() && !token.is_pass() ? token.payload() : 1;
    }
  }

  double reach_of_term(const Cell& cell, const std::vector<Literal>& literals) {
    const Vec3 center = cell.box.center(), half = cell.box.size() * 0.5;
    Vec3 objective{};
    objective[axis_] = sign_;
    planes_.clear();
    bool all_flat = true;
    Vec3 inward{};
    for (const Literal literal : literals) {
      all_flat = all_flat && scene_.half_spaces[literal >> 1].is_plane();
      const std::optional<Constraint> plane = tangent_plane(literal, center, half);
      if (!plane) continue;
      planes_.push_back(*plane);
      inward -= plane->n;
    }
    const auto program = [&](double margin) {
      const Vec3 inner = half - Vec3{margin, margin, margin};
      for (Constraint& plane : planes_) plane.d -= margin;
      return farthest_point(objective, planes_, inner);
    };
    const std::optional<Vec3> farthest = program(0);
    if (!farthest) return -kInfinity;
    const Vec3 p = center + *farthest;
    const double reach = reach_of(p);
    if (reach <= best_ + accuracy_) return reach;
    const double margin = std::min(kNoVolume * accuracy_, 0.1 * min_component(half));
    if (!program(margin)) return -kInfinity;
    // A polytope is convex: with a ball in it, all of it is solid.
    if (all_flat)
      best_ = std::max(best_, reach);
    else
      look_for_solid(cell, p, inward);
    return reach;
  }

  /// The tangent plane of the literal's surface in the middle of a cell, about which it is
  /// relative, moved out by as much as the surface bends in the cell: it holds all that the literal
  /// does there. None if the surface has no direction there.
  std::optional<Constraint> tangent_plane(Literal literal, Vec3 center, Vec3 half) const {
    using K = Kernels<double>;
    const HalfSpace& h = scene_.half_spaces[literal >> 1];
    const Vec3 q = center - h.center;
    const double side = literal & 1 ? -1 : 1;
    const auto gradient = K::quadric_half_gradient(h.f, q);
    const Vec3 n = Vec3{gradient.x, gradient.y, gradient.z} * (2 * side);
    const double steepness = length(n);
    if (!(steepness > kFlatGradient)) return std::nullopt;
    const Vec3 a = h.f.diag * side, mixed = abs(h.f.off);
    double bend =
        -2 * (mixed.x * half.y * half.z + mixed.y * half.x * half.z + mixed.z * half.x * half.y);
    for (int k = 0; k < 3; ++k) bend += std::min(a[k], 0.0) * half[k] * half[k];
    const double value = side * K::quadric_value(h.f, q);
    return Constraint{n / steepness, -(value + bend) / steepness};
  }

  /// Tries points behind `p`, which may be just outside of the solid: straight back, and into the
  /// wedge between the surfaces.
  void look_for_solid(const Cell& cell, Vec3 p, Vec3 inward) {
    Vec3 back{};
    back[axis_] = -sign_;
    const double room = reach_of(p) - best_;
    for (double step = accuracy_ / 4; step < room; step *= 4) {
      for (const Vec3 way : {back, normalize(inward)}) {
        const Vec3 q = max(cell.box.lo, min(p + way * step, cell.box.hi));
        if (reach_of(q) <= best_) continue;
        Formula ignored;
        tokens_ += cell.formula.size();
        if (simplifier_.simplify(cell.formula, {q, q}, true, ignored) == Truth::kTrue)
          best_ = reach_of(q);
      }
    }
  }

  static double min_component(Vec3 v) { return std::min(v.x, std::min(v.y, v.z)); }

  const Scene& scene_;
  int axis_, sign_;
  double accuracy_;
  Simplifier simplifier_;
  std::priority_queue<Cell> open_;
  uint64_t order_ = 0;
  size_t tokens_ = 0;
  double best_ = -kInfinity;        ///< how far the solid surely reaches
  std::vector<Constraint> planes_;  ///< scratch
};

/// The solid's box within `start`, local.
SolidBounds search_all(const Scene& scene, const Box& start, size_t most_cells,
                       const Workers& workers) {
  const double accuracy = kBoundsAccuracy * max_component(start.size());
  std::array<Farthest, 6> found;
  workers.for_parts(found.size(), 1, [&](size_t first, size_t last, size_t) {
    for (size_t i = first; i < last; ++i)
      found[i] = Search(scene, int(i / 2), i % 2 ? 1 : -1, accuracy).run(start, most_cells);
  });
  SolidBounds result;
  for (int axis = 0; axis < 3; ++axis) {
    const Farthest &low = found[size_t(2 * axis)], &high = found[size_t(2 * axis + 1)];
    result.box.lo[axis] = -low.reach;
    result.box.hi[axis] = high.reach;
    result.exact = result.exact && low.exact && high.exact;
  }
  return result;
}

}  // namespace

SolidBounds solid_bounds(const Scene& scene, int threads, size_t most_cells) {
  if (scene.region.is_empty()) return {};
  const Workers workers(threads);
  SolidBounds result;
  Box start = scene.region;
  // A box that turns out much smaller than where it was looked for is looked for again in there.
  constexpr int kMostRounds = 4;
  constexpr double kMuchSmaller = 0.25;
  for (int round = 0; round < kMostRounds; ++round) {
    const double edge = max_component(start.size()), accuracy = kBoundsAccuracy * edge;
    const SolidBounds found = search_all(scene, start, most_cells, workers);
    if (found.box.is_empty() && round > 0) break;
    result = found;
    if (found.box.is_empty()) return result;
    if (round == 0 && !scene.bounded) {
      for (int axis = 0; axis < 3; ++axis)
        if (found.box.lo[axis] <= start.lo[axis] + 2 * accuracy ||
            found.box.hi[axis] >= start.hi[axis] - 2 * accuracy)
          result.bounded = false;
      if (!result.bounded) break;
    }
    if (max_component(found.box.size()) > kMuchSmaller * edge) break;
    const Vec3 margin = Vec3{2, 2, 2} * accuracy;
    start = intersect({found.box.lo - margin, found.box.hi + margin}, scene.region);
  }
  result.box = {result.box.lo + scene.origin, result.box.hi + scene.origin};
  return result;
}

}  // namespace whittle
