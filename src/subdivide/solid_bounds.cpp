#include "subdivide/solid_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/workers.h"
#include "subdivide/first_cells.h"
#include "subdivide/simplify.h"
#include "subdivide/tangents.h"

namespace whittle {
namespace {

/// Formulas of more polytopes than this are not looked at as a union of them.
constexpr size_t kMostTerms = 64;
/// Tokens that one search may classify: a number, and some passes over the formula.
constexpr size_t kMostTokens = size_t(1) << 22, kMostPasses = 32;
/// A polytope that cannot hold a ball of this radius, as a share of the accuracy, is nothing: flat
/// leftovers, points where surfaces touch. A tenth of the tolerance, which is what material must be
/// thick: texts of six digits leave such slivers.
constexpr double kNoVolume = 0.1;

struct Farthest {
  double reach = -kInfinity;  ///< along the direction; -infinity: nothing is there
  bool exact = true;
};

/// The linear program of one polytope, with all its planes and the cell's sides moved in by a
/// margin.
class Program {
 public:
  Program(std::span<const Constraint> planes, Vec3 objective, Vec3 half)
      : planes_(planes), objective_(objective), half_(half) {}

  std::optional<Vec3> solve(double margin) const {
    moved_.assign(planes_.begin(), planes_.end());
    for (Constraint& plane : moved_) plane.d -= margin;
    return farthest_point(objective_, moved_, half_ - Vec3{margin, margin, margin});
  }

 private:
  std::span<const Constraint> planes_;
  Vec3 objective_, half_;
  mutable std::vector<Constraint> moved_;
};

/// The search in one direction. One along an axis can cut cells off where they are near enough; in
/// any other they are only put back in the row.
class Search {
 public:
  Search(const Scene& scene, const UnitBoxes& boxes, const FirstCells& first, Vec3 direction,
         double accuracy)
      : scene_(scene),
        first_(first),
        objective_(direction),
        accuracy_(accuracy),
        simplifier_(scene, boxes, 0) {
    for (int axis = 0; axis < 3; ++axis) {
      if (std::fabs(direction[axis]) != 1 || length(direction) != 1) continue;
      axis_ = axis;
      sign_ = direction[axis] > 0 ? 1 : -1;
    }
  }

  Farthest run(size_t most_cells) {
    open_first(0);
    const size_t most_tokens = kMostTokens + kMostPasses * scene_.formula.size();
    for (size_t cells = 0; !open_.empty(); ++cells) {
      std::ranges::pop_heap(open_, comes_later);
      Cell cell = std::move(open_.back());
      open_.pop_back();
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
    Simplifier::Size size;  ///< of the formula
    Formula faces;          ///< the formula, expanded
    size_t parts = 0;       ///< among the first cells, see there
  };
  static bool comes_later(const Cell& a, const Cell& b) {
    return a.reach != b.reach ? a.reach < b.reach : a.order < b.order;
  }
  /// One polytope of a union: literals that must all hold.
  struct Term {
    std::vector<Literal> literals;
    std::vector<uint32_t> operands;  ///< tokens whose subtrees must hold too
  };

  bool is_along_axis() const { return axis_ >= 0; }
  double reach_of(Vec3 p) const { return is_along_axis() ? sign_ * p[axis_] : dot(objective_, p); }
  double reach_of(const Box& box) const {
    if (is_along_axis()) return sign_ > 0 ? box.hi[axis_] : -box.lo[axis_];
    return dot(objective_, box.center()) + dot(abs(objective_), box.size()) / 2;
  }
  double depth_of(const Box& box) const { return sign_ > 0 ? box.lo[axis_] : -box.hi[axis_]; }

  /// Simplifies a formula for a box. What is all solid is noted.
  Truth simplify(const Formula& around, const Box& box, Formula& out) {
    const Truth truth = simplify_for(box, around, scene_, simplifier_, out);
    if (truth == Truth::kTrue) best_ = std::max(best_, reach_of(box));
    return truth;
  }

  /// Expands a cell's formula, if all in it can be. No faces: nothing there is beyond what is
  /// known.
  bool make_faces_of(Cell& cell) {
    if (!has_units(cell.formula)) {
      cell.faces = cell.formula;
      return true;
    }
    if (count_boundaries(scene_, cell.formula) == 0) return false;
    tokens_ += cell.formula.size();
    const Truth truth = simplifier_.simplify(cell.formula, cell.box, Expand::kAll, cell.faces);
    if (truth == Truth::kTrue) best_ = std::max(best_, reach_of(cell.box));
    return true;
  }

  /// Simplifies `around` for the box and opens it, unless it is decided. It is known not to reach
  /// farther than `most`.
  void open_child(const Formula& around, const Box& box, double most) {
    tokens_ += around.size();
    Formula formula;
    const Truth truth = simplify(around, box, formula);
    if (truth != Truth::kVaries) return;
    const Simplifier::Size size = simplifier_.size_of(formula);
    open_.push_back(
        {std::min(most, reach_of(box)), order_++, box, std::move(formula), size, {}, 0});
    std::ranges::push_heap(open_, comes_later);
  }

  /// The same for one of the first cells.
  void open_first(size_t i) {
    const FirstCells::Cell& cell = first_[i];
    tokens_ += first_.around(i).size();
    if (cell.truth == Truth::kTrue) best_ = std::max(best_, reach_of(cell.box));
    if (cell.truth != Truth::kVaries) return;
    open_.push_back(
        {reach_of(cell.box), order_++, cell.box, cell.formula, cell.size, {}, cell.parts});
    std::ranges::push_heap(open_, comes_later);
  }

  void look_at(Cell cell) {
    // Only what lies beyond the best point counts.
    const double needed = best_ + accuracy_ / 2;
    if (is_along_axis() && depth_of(cell.box) < needed) {
      (sign_ > 0 ? cell.box.lo : cell.box.hi)[axis_] = sign_ * needed;
      tokens_ += cell.formula.size();
      Formula formula;
      const Truth truth = simplify(cell.formula, cell.box, formula);
      if (truth != Truth::kVaries) return;
      cell.formula = std::move(formula);
      cell.size = simplifier_.size_of(cell.formula);
    } else if (cell.parts != 0) {
      open_first(cell.parts);
      open_first(cell.parts + 1);
      return;
    }
    int split_axis = longest_axis(cell.box);
    double most = cell.reach;
    if (!is_large(cell.size) && make_faces_of(cell)) {
      if (cell.faces.empty()) return;
      const double reach = reach_of_terms(cell);
      if (reach <= best_ + accuracy_) return;
      most = std::min(most, reach);
      if (is_along_axis() && reach < reach_of(cell.box)) {
        (sign_ > 0 ? cell.box.hi : cell.box.lo)[axis_] = sign_ * reach;
        split_axis = longest_axis(cell.box);
      }
      split_axis = most_bent_axis(cell, split_axis);
    }
    if (max_component(cell.box.size()) <= accuracy_) {
      // Too small to tell, and too small to matter.
      best_ = std::max(best_, std::min(most, reach_of(cell.box)));
      return;
    }
    for (const Box& part : split(cell.box, split_axis)) open_child(cell.formula, part, most);
  }

  /// The axis along which the surfaces bend most in the cell: splitting it brings them nearest to
  /// their tangent planes. `otherwise` if none bends.
  int most_bent_axis(const Cell& cell, int otherwise) const {
    const Vec3 h = cell.box.size() * 0.5;
    Vec3 bend{};
    for (const Token token : cell.faces) {
      if (token.kind() != TokenKind::kFace) continue;
      const auto& f = scene_.half_spaces[scene_.faces[token.payload()].literal >> 1].f;
      const Vec3 a = abs(f.diag), mixed = abs(f.off);
      const double yz = mixed.x * h.y * h.z, xz = mixed.y * h.x * h.z, xy = mixed.z * h.x * h.y;
      bend += {a.x * h.x * h.x + xy + xz, a.y * h.y * h.y + xy + yz, a.z * h.z * h.z + xz + yz};
    }
    if (max_component(bend) < accuracy_ * 1e-3) return otherwise;
    return bend.x >= bend.y && bend.x >= bend.z ? 0 : bend.y >= bend.z ? 1 : 2;
  }

  /// How far the formula can reach in the cell, and on the way the best point found in it.
  double reach_of_terms(const Cell& cell) {
    double reach = -kInfinity;
    size_t terms = 0;
    std::vector<Term> pending(1);
    pending[0].operands.push_back(uint32_t(whole(cell.faces).index));
    while (!pending.empty()) {
      Term term = std::move(pending.back());
      pending.pop_back();
      if (!expand(cell.faces, term, pending)) continue;
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
        push_operands(operand_at(formula, i), term.operands);
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
    push_operands(operand_at(formula, chosen), alternatives);
    for (const uint32_t alternative : alternatives) {
      pending.push_back({term.literals, choices});
      pending.back().operands.push_back(alternative);
    }
    return false;
  }

  /// Appends the numbers of a group's operands.
  static void push_operands(Operand group, std::vector<uint32_t>& out) {
    for (const Operand operand : operands_of(group)) out.push_back(uint32_t(operand.index));
  }

  double reach_of_term(const Cell& cell, const std::vector<Literal>& literals) {
    const Vec3 center = cell.box.center(), half = cell.box.size() * 0.5;
    tangents_.clear();
    planes_.clear();
    bool all_flat = true;
    for (const Literal literal : literals) {
      all_flat = all_flat && scene_.half_spaces[literal >> 1].is_plane();
      const std::optional<Tangent> surface = tangent(scene_, literal, center);
      if (!surface) continue;
      tangents_.push_back(*surface);
      planes_.push_back(outer_plane(*surface, half));
    }
    Program program(planes_, objective_, half);
    const std::optional<Vec3> farthest = program.solve(0);
    if (!farthest) return -kInfinity;
    double reach = reach_of(center + *farthest);
    if (reach <= best_ + accuracy_) return reach;
    if (!all_flat) {
      reach = std::min(reach, reach_of(center) + combined_reach_at(*farthest, half));
      if (reach <= best_ + accuracy_) return reach;
    }
    if (!program.solve(std::min(kNoVolume * accuracy_, 0.1 * min_component(half))))
      return -kInfinity;
    // A polytope is convex: with a ball in it, all of it is solid.
    if (all_flat)
      best_ = std::max(best_, reach);
    else
      look_for_solid(cell, program, reach);
    return reach;
  }

  /// The bound by sums of the surfaces nearest to the polytope's farthest point.
  double combined_reach_at(Vec3 farthest, Vec3 half) {
    constexpr size_t kMostNear = 4;
    near_.clear();
    for (size_t i = 0; i < planes_.size(); ++i)
      near_.push_back({planes_[i].d - dot(planes_[i].n, farthest), &tangents_[i]});
    const size_t count = std::min(near_.size(), kMostNear);
    std::ranges::partial_sort(near_, near_.begin() + std::ptrdiff_t(count));
    double reach = kInfinity;
    const auto with = [&](std::initializer_list<const Tangent*> some) {
      reach = std::min(reach, combined_reach({some.begin(), some.size()}, objective_, half));
    };
    for (size_t i = 0; i < count; ++i) {
      with({near_[i].second});
      for (size_t j = 0; j < i; ++j) {
        with({near_[i].second, near_[j].second});
        for (size_t k = 0; k < j; ++k) with({near_[i].second, near_[j].second, near_[k].second});
      }
    }
    return reach;
  }

  /// Tries the farthest points of ever smaller polytopes: curved surfaces may leave the first ones
  /// outside of the solid.
  void look_for_solid(const Cell& cell, const Program& program, double reach) {
    const double room = std::min(reach - best_, min_component(cell.box.size()) / 2);
    for (double margin = accuracy_ / 4; margin < room; margin *= 4) {
      const std::optional<Vec3> farthest = program.solve(margin);
      if (!farthest) return;
      const Vec3 q = cell.box.center() + *farthest;
      if (reach_of(q) <= best_) return;
      Formula ignored;
      tokens_ += cell.formula.size();
      if (simplifier_.simplify(cell.formula, {q, q}, Expand::kAll, ignored) == Truth::kTrue)
        best_ = reach_of(q);
    }
  }

  static double min_component(Vec3 v) { return std::min(v.x, std::min(v.y, v.z)); }

  const Scene& scene_;
  const FirstCells& first_;
  Vec3 objective_;
  int axis_ = -1, sign_ = 1;  ///< of the axis that it goes along; -1: none
  double accuracy_;
  Simplifier simplifier_;
  std::vector<Cell> open_;  ///< a heap: the cell that reaches farthest is in front
  uint64_t order_ = 0;
  size_t tokens_ = 0;
  double best_ = -kInfinity;  ///< how far the solid surely reaches
  // Scratch.
  std::vector<Tangent> tangents_;
  std::vector<Constraint> planes_;
  std::vector<std::pair<double, const Tangent*>> near_;  ///< with the distance
};

/// The search in each of some directions, of unit length, within `start`, local.
std::vector<Farthest> search_all(const Scene& scene, const UnitBoxes& boxes, const Box& start,
                                 std::span<const Vec3> directions, double accuracy,
                                 size_t most_cells, const Workers& workers) {
  const FirstCells first_cells(scene, boxes, start, workers);
  std::vector<Farthest> found(directions.size());
  workers.for_parts(found.size(), 1, [&](size_t first, size_t last, size_t) {
    for (size_t i = first; i < last; ++i)
      found[i] = Search(scene, boxes, first_cells, directions[i], accuracy).run(most_cells);
  });
  return found;
}

/// The solid's box within `start`, local, each side wrong by at most `accuracy`.
SolidBounds box_within(const Scene& scene, const UnitBoxes& boxes, const Box& start,
                       double accuracy, size_t most_cells, const Workers& workers) {
  constexpr std::array<Vec3, 6> kSides = {
      {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};
  const std::vector<Farthest> found =
      search_all(scene, boxes, start, kSides, accuracy, most_cells, workers);
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
  const UnitBoxes boxes(scene, &workers);
  SolidBounds result;
  Box start = scene.region;
  // A box that turns out much smaller than where it was looked for is looked for again in there.
  constexpr int kMostRounds = 4;
  constexpr double kMuchSmaller = 0.25;
  for (int round = 0; round < kMostRounds; ++round) {
    const double edge = max_component(start.size());
    const double accuracy = kBoundsAccuracy * kMuchSmaller * edge;
    const SolidBounds found = box_within(scene, boxes, start, accuracy, most_cells, workers);
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

std::vector<double> solid_reach(const Scene& scene, const Box& box,
                                std::span<const Vec3> directions, int threads, size_t most_cells) {
  std::vector<double> reach(directions.size(), -kInfinity);
  if (scene.region.is_empty() || box.is_empty()) return reach;
  const Workers workers(threads);
  const UnitBoxes boxes(scene, &workers);
  const double edge = max_component(box.size()), accuracy = kReachAccuracy * edge;
  const Vec3 margin = Vec3{1, 1, 1} * (kBoundsAccuracy * edge);
  const Box start =
      intersect({box.lo - scene.origin - margin, box.hi - scene.origin + margin}, scene.region);
  std::vector<Vec3> unit;
  for (const Vec3 direction : directions) unit.push_back(normalize(direction));
  const std::vector<Farthest> found =
      search_all(scene, boxes, start, unit, accuracy, most_cells, workers);
  for (size_t i = 0; i < found.size(); ++i)
    reach[i] = found[i].reach * length(directions[i]) + dot(directions[i], scene.origin);
  return reach;
}

}  // namespace whittle
