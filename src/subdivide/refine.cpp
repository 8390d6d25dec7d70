#include "subdivide/refine.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "subdivide/cell_claim.h"
#include "subdivide/join_grid.h"

namespace whittle {
namespace {

/// A cell of at least so many operands is split into parts of about kWantedOperands each at once.
constexpr size_t kWide = 4096, kWantedOperands = 128;
constexpr int kMostSplitsAtOnce = 12;

/// A loop that helpers share, if there are any.
Loop loop_over(const Helpers* helpers) {
  const Workers* const workers = helpers == nullptr ? nullptr : &helpers->workers;
  return
      [workers](size_t n, size_t grain, const auto& body) { for_parts(workers, n, grain, body); };
}

}  // namespace

Refiner::Refiner(const Scene& scene, const UnitBoxes& boxes, const SubdivideSettings& settings)
    : scene_(scene),
      settings_(settings),
      rules_(scene, settings),
      margin_(max_component(scene.region.size()) * settings.margin),
      store_(bool(settings.is_small)),
      simplifier_(scene, boxes, margin_),
      box_cutter_(scene, margin_),
      analysis_(scene) {}

CellLink Refiner::refined(const Cell& cell, const Helpers* helpers) {
  CellLink known;
  std::optional<CellClaim> claim = CellClaim::take(cell, known);
  if (!claim) return known;
  const OpenCell& open = claim->open();
  const Ending ending = this->ending(open);
  const CellLink result = ending.link ? *ending.link : split(cell, open, helpers);
  // What the cell would be across the threshold, and whether its formula is needed to find out.
  bool keeps_formula = false;
  if (settings_.is_small && ending.across != Across::kSame && across(cell) == kNowhere) {
    keeps_formula = ending.across == Across::kUnknown;
    across(cell) = (keeps_formula ? claim->link() : CellLink(CellKind::kIgnored, nullptr)).bits() |
                   (ending.is_small ? 0 : CellLink::kIfSmall);
  }
  claim->become(result);
  --store_.stats.cells[size_t(CellKind::kOpen)];
  ++store_.stats.cells[size_t(result.kind())];
  ++store_.stats.refined;
  if (!keeps_formula) store_.give_back(open);
  return result;
}

void Refiner::refine_all(const Cell& cell) {
  // As deep as the tree, not as the model.
  pending_.assign(1, &cell);
  while (!pending_.empty()) {
    const CellLink link = refined(*pending_.back());
    pending_.pop_back();
    if (link.kind() != CellKind::kNode) continue;
    pending_.push_back(link.children() + 1);
    pending_.push_back(link.children());
  }
}

Refiner::Ending Refiner::ending(const OpenCell& open) {
  const SplitRules::Outlook outlook = rules_.outlook(open);
  Ending end;
  end.is_small = outlook.is_small;
  if (outlook.is_long) {
    end.across = Across::kUnknown;
    if (!outlook.is_small) return end;
  }
  std::span<const Token> formula = open.tokens();
  if (has_units(formula)) {
    const Truth truth =
        simplifier_.simplify(formula, open.box, Expand::kAll, expanded_, open.near());
    if (truth != Truth::kVaries) {
      end.link = CellStore::decided(truth == Truth::kTrue);
      return end;
    }
    formula = expanded_;
  }
  analysis_.analyse(formula);
  if (analysis_.size() == 0) {
    end.link = CellStore::decided(analysis_.constant_value());
    return end;
  }
  const bool is_simple = rules_.is_simple(analysis_, outlook);
  const bool ignores = settings_.ignore_small;
  if (!is_simple && (!outlook.must_end || ignores))
    end.across = ignores && !outlook.is_small ? Across::kIgnored : Across::kUnknown;
  if (!is_simple && !outlook.is_small && !outlook.must_end) return end;
  end.link = outlook.is_small && ignores && !is_simple ? CellLink(CellKind::kIgnored, nullptr)
                                                       : store_.leaf(analysis_);
  return end;
}

CellLink Refiner::split(const Cell& cell, const OpenCell& open, const Helpers* helpers) {
  if (is_wide(open.tokens(), open.depth)) {
    if (const std::optional<CellLink> grid = split_wide(cell, open, helpers)) return *grid;
  }
  constexpr uint32_t kSplits = 3;
  if (settings_.split == SplitRule::kOctree && open.depth + kSplits <= kMostDepth) {
    const std::vector<std::span<const Token>> all(size_t(1) << kSplits, open.tokens());
    const SplitGrid grid = make_grid(open.box, kSplits, settings_.split, open.depth);
    if (const std::optional<CellLink> eight =
            open_parts(cell, open, grid, all, open.near(), nullptr))
      return *eight;
  }
  return split_in_two(cell, open);
}

void Refiner::halve(const OpenCell& parent, BoxCut cut, Halves& halves) {
  halves.cut = cut;
  halves.cost = 0;
  for (int side = 0; side < 2; ++side) {
    OpenCell& part = halves.part[side];
    part = {};
    part.box = parent.box;
    (side == 0 ? part.box.hi : part.box.lo)[cut.axis] = cut.at;
    part.depth = parent.depth + 1;
    store_.stats.classified += parent.token_count;
    halves.truth[side] = simplifier_.simplify(parent.tokens(), part.box, expand_of(parent.literals),
                                              halves.formula[side], parent.near());
    if (halves.truth[side] != Truth::kVaries) continue;
    const Simplifier::Size size = simplifier_.size_of(halves.formula[side]);
    part.literals = size.literals;
    part.is_crowded = size.is_crowded;
    simplifier_.list_near(halves.formula[side], halves.near[side]);
    part.token_count = uint32_t(halves.formula[side].size());
    part.near_count = uint32_t(halves.near[side].size());
    halves.cost += half_area(part.box) * part.literals;
  }
}

CellLink Refiner::split_in_two(const Cell& cell, const OpenCell& parent) {
  const int first = split_axis(parent.box.size(), settings_.split, parent.depth);
  const Vec3 middle = parent.box.center();
  BoxCut cut{first, middle[first]};
  if (settings_.split == SplitRule::kLongest)
    cut = box_cutter_.cut(parent.tokens(), parent.box, cut).value_or(cut);
  halve(parent, cut, halves_);
  for (int axis = 0; axis < 3 && settings_.split == SplitRule::kCost; ++axis) {
    if (axis == first) continue;
    halve(parent, {axis, middle[axis]}, others_);
    if (others_.cost < halves_.cost) std::swap(others_, halves_);
  }
  OpenCell* parts[2] = {};
  for (int side = 0; side < 2; ++side)
    if (halves_.truth[side] == Truth::kVaries) parts[side] = &halves_.part[side];
  rules_.share(parent, parts, 2 * sizeof(Cell), 1);
  Cell* const cells = store_.new_pair();
  store_.stats.depth = std::max(store_.stats.depth, parent.depth + 1);
  for (int side = 0; side < 2; ++side) {
    const CellLink link = parts[side] != nullptr
                              ? store_.open(*parts[side], halves_.formula[side], halves_.near[side])
                              : CellStore::decided(halves_.truth[side] == Truth::kTrue);
    cells[side].bits.store(link.bits(), std::memory_order_relaxed);
    ++store_.stats.cells[size_t(link.kind())];
  }
  cell.split = halves_.cut.at;
  return {CellKind::kNode, cells, halves_.cut.axis};
}

/// Whether the cell is worth splitting many times at once. Where small cells end early, each split
/// has to be looked at.
bool Refiner::is_wide(std::span<const Token> formula, uint32_t depth) const {
  return formula.size() >= kWide && !settings_.is_small && depth < kMostDepth / 2 &&
         operand_count(formula) >= kWide;
}

std::optional<CellLink> Refiner::split_wide(const Cell& cell, const OpenCell& parent,
                                            const Helpers* helpers) {
  const size_t wanted = parent.token_count / kWantedOperands;
  const int splits = std::min(int(std::bit_width(wanted)), kMostSplitsAtOnce);
  const SplitGrid grid = make_grid(parent.box, splits, settings_.split, parent.depth);
  const std::vector<Formula> dealt =
      deal_operands(scene_, parent.tokens(), grid, margin_, loop_over(helpers));
  if (dealt.empty()) return std::nullopt;
  return open_parts(cell, parent, grid, {dealt.begin(), dealt.end()}, {}, helpers);
}

/// Splits a cell into the parts of a grid, of each of which a formula is known that is right there.
/// Nothing if the memory does not suffice for that.
std::optional<CellLink> Refiner::open_parts(const Cell& cell, const OpenCell& parent,
                                            const SplitGrid& grid,
                                            const std::vector<std::span<const Token>>& formulas,
                                            std::span<const uint32_t> near,
                                            const Helpers* helpers) {
  const Loop loop = loop_over(helpers);
  const size_t parts = formulas.size();
  const auto splits = uint32_t(grid.axes.size());
  // Nothing gets longer from here on, so if this fits all does.
  std::vector<uint32_t> literals(parts);
  loop(parts, 1, [&](size_t first, size_t last, size_t) {
    for (size_t part = first; part < last; ++part)
      literals[part] = expanded_size(scene_, formulas[part]);
  });
  size_t most = 0;
  for (size_t part = 0; part < parts; ++part)
    most +=
        2 * sizeof(Cell) + rules_.bytes_unsplit(literals[part], rules_.most_words(formulas[part]));
  if (most > parent.memory) return std::nullopt;

  // Every part by itself.
  std::vector<CellLink> links(parts);
  std::vector<OpenCell*> opened(parts);
  loop(parts, 1, [&](size_t first, size_t last, size_t worker) {
    Refiner& refiner = helpers == nullptr ? *this : helpers->refiner_of(worker);
    for (size_t part = first; part < last; ++part) {
      refiner.store_.stats.classified += formulas[part].size();
      OpenCell child{.box = grid.part(part), .depth = parent.depth + splits};
      Formula& formula = refiner.halves_.formula[0];
      const Truth truth = refiner.simplifier_.simplify(formulas[part], child.box,
                                                       expand_of(literals[part]), formula, near);
      links[part] = CellStore::decided(truth == Truth::kTrue);
      if (truth != Truth::kVaries) continue;
      const Simplifier::Size size = refiner.simplifier_.size_of(formula);
      child.literals = size.literals;
      child.is_crowded = size.is_crowded;
      std::vector<uint32_t>& listed = refiner.halves_.near[0];
      refiner.simplifier_.list_near(formula, listed);
      links[part] = refiner.store_.open(child, formula, listed);
      opened[part] = static_cast<OpenCell*>(const_cast<void*>(links[part].target()));
    }
  });
  rules_.share(parent, opened, 2 * sizeof(Cell) * parts, splits);
  store_.stats.depth = std::max(store_.stats.depth, parent.depth + splits);
  return join_grid(grid, std::move(links), store_, cell.split);
}

CellLink Refiner::open_region() {
  if (scene_.region.is_empty()) return CellStore::decided(false);
  Formula simplified;
  std::vector<uint32_t> near;
  std::span<const Token> formula = scene_.formula;
  Simplifier::Size size{expanded_size(scene_, formula), !scene_.boundaries.empty()};
  // Of a wide one nearly all is in the region, and its parts will be looked at by all threads.
  if (!is_wide(formula, 0)) {
    store_.stats.classified += formula.size();
    const Truth truth =
        simplifier_.simplify(formula, scene_.region, expand_of(size.literals), simplified);
    if (truth != Truth::kVaries) return CellStore::decided(truth == Truth::kTrue);
    formula = simplified;
    size = simplifier_.size_of(formula);
    simplifier_.list_near(formula, near);
  }
  const OpenCell whole{.box = scene_.region,
                       .memory = settings_.memory,
                       .literals = size.literals,
                       .is_crowded = size.is_crowded};
  return store_.open(whole, formula, near);
}

}  // namespace whittle
