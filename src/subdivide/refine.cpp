#include "subdivide/refine.h"

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <thread>
#include <utility>

namespace whittle {
namespace {

/// A cell of at least so many operands is split into parts of about kWantedOperands each at once.
constexpr size_t kWide = 4096, kWantedOperands = 128;
constexpr int kMostSplitsAtOnce = 12;

/// A cell whose formula has not become shorter, in itself and in its sibling, over this many splits
/// in a row is a corner or an edge where many surfaces meet: no split will part them.
uint32_t stall_limit(uint32_t literals) {
  return std::max(6u, literals);
}

/// One conjunction or disjunction, which needs no table, of so many literals costs no more.
constexpr uint32_t kQuickLiterals = 10;

/// Whether splitting a cell of so many literals saves more than it takes, all counted in visits of
/// a node by a ray. Each ray saves a part of the literals that it would look at, and makes a visit
/// and a bit more; beyond `quick` literals, with which a leaf is solved for many rays at once, it
/// saves much more. The split itself takes so much for each literal of the formula.
bool pays_off(uint32_t literals, double rays, uint32_t quick = kTableLiterals) {
  constexpr double kSavedEach = 0.32, kSavedBeyond = 4, kMoreVisits = 1.3, kSplitEach = 120;
  const uint32_t beyond = std::max(literals, quick) - quick;
  return rays * (kSavedEach * literals + kSavedBeyond * beyond - kMoreVisits) >
         kSplitEach * literals;
}

/// Of the memory that is left each part of a cell gets as much as it has of the literals, and as if
/// it had so many more: where few surfaces meet for good, many cells are needed too.
constexpr uint32_t kFew = 16;

/// The link of an open cell that a thread is at.
constexpr uint64_t kBusy = 1u << 7;

/// Those who wait for another thread look so many times in a row, and then now and then.
constexpr int kSpins = 200;
constexpr std::chrono::microseconds kNap{20};

/// A ray that meets a box meets a part of it about as often as the part has surface of it.
double half_area(const Box& box) {
  const Vec3 size = box.size();
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

void wait_a_little(int round) {
  if (round < kSpins)
    std::this_thread::yield();
  else
    std::this_thread::sleep_for(kNap);
}

}  // namespace

Refiner::Refiner(const Scene& scene, const UnitBoxes& boxes, const SubdivideSettings& settings)
    : scene_(scene),
      settings_(settings),
      has_threshold_(bool(settings.is_small)),
      region_edge_(max_component(scene.region.size())),
      simplifier_(scene, boxes, region_edge_ * settings.margin),
      box_cutter_(scene, region_edge_ * settings.margin),
      analysis_(scene) {}

CellLink Refiner::refined(const Cell& cell, const Helpers* helpers) {
  for (int round = 0;; ++round) {
    const CellLink link = cell.link();
    if (link.kind() != CellKind::kOpen) return link;
    uint64_t bits = link.bits();
    if ((bits & kBusy) != 0 || !cell.bits.compare_exchange_strong(bits, bits | kBusy)) {
      wait_a_little(round);
      continue;
    }
    const OpenCell& open = *static_cast<const OpenCell*>(link.target());
    try {
      const CellLink result = refine(cell, open, helpers);
      const bool keeps = has_threshold_ && keep_formula(cell, link);
      cell.bits.store(result.bits(), std::memory_order_release);
      --stats_.cells[size_t(CellKind::kOpen)];
      ++stats_.cells[size_t(result.kind())];
      ++stats_.refined;
      if (keeps) return result;
      const size_t bytes = OpenCell::bytes(open.words());
      stats_.memory_bytes -= bytes;
      open_cells_.give(const_cast<OpenCell*>(&open), bytes);
      return result;
    } catch (...) {
      cell.bits.store(link.bits(), std::memory_order_release);
      throw;
    }
  }
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

CellLink Refiner::refine(const Cell& cell, const OpenCell& open, const Helpers* helpers) {
  CellLink link;
  if (ends(open, link)) return link;
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
  return split(cell, open);
}

/// What a cell takes if it is not split, at most: open, rounded up to a power of two, and as a
/// leaf. Its literals may be many and their half-spaces few.
size_t Refiner::bytes_unsplit(size_t literals, size_t words) const {
  return 2 * OpenCell::bytes(words) + sizeof(Leaf) + literals * (sizeof(Step) + sizeof(Token)) +
         std::min(literals, scene_.half_spaces.size()) * sizeof(LeafLiteral);
}

/// Words that a formula takes at most, in the cell it is for or in a part of it, with the triangles
/// that are listed.
size_t Refiner::most_words(std::span<const Token> formula) const {
  if (scene_.boundaries.empty()) return formula.size();
  return formula.size() + count_boundaries(scene_, formula) * NearTriangles::kMostWords;
}

/// Whether the cell is not split, and then what it is.
bool Refiner::ends(const OpenCell& open, CellLink& link) {
  const double edge = max_component(open.box.size()) / region_edge_;
  const Box world{open.box.lo + scene_.origin, open.box.hi + scene_.origin};
  const bool small = settings_.is_small && settings_.is_small(world);
  const double rays = edge * edge * settings_.rays;
  const bool is_auto = settings_.leaf_size == kAutoLeafSize;
  // At 512 x 512 rays this is the smallest edge that others have.
  constexpr double kFewestRays = 1.0 / 1024;
  const bool useless = !has_threshold_ &&
                       (is_auto ? !pays_off(open.literals, rays)
                                : edge * edge * open.literals < settings_.least_use) &&
                       !open.is_crowded;
  const size_t split_bytes =
      2 * (sizeof(Cell) + bytes_unsplit(open.literals, most_words(open.tokens())));
  const bool must_end_anyway =
      useless || (is_auto ? rays * 0.25 < kFewestRays : edge * 0.5 < settings_.smallest_edge) ||
      open.stalled >= stall_limit(open.literals) || open.depth >= kMostDepth ||
      open.memory < split_bytes;
  const bool must_end = small || must_end_anyway;
  std::span<const Token> formula = open.tokens();
  // To split a crowd of triangles takes much less than to make a formula of them.
  const bool is_long =
      !must_end_anyway &&
      (open.is_crowded || (open.literals > kExpandAll && !has_few_half_spaces(scene_, formula)));
  is_small_ = small;
  across_ = is_long ? Across::kUnknown : Across::kSame;
  if (is_long && !small) return false;
  if (has_units(formula)) {
    const Truth truth =
        simplifier_.simplify(formula, open.box, Expand::kAll, expanded_, open.near());
    if (truth != Truth::kVaries) {
      link = decided(truth == Truth::kTrue);
      return true;
    }
    formula = expanded_;
  }
  analysis_.analyse(formula);
  if (analysis_.size() == 0) {
    link = decided(analysis_.constant_value());
    return true;
  }
  const uint32_t quick = analysis_.is_one_group() ? kQuickLiterals : kTableLiterals;
  const bool simple = is_auto ? !pays_off(analysis_.size(), rays, quick) : simple_enough();
  if (!simple && (!must_end_anyway || settings_.ignore_small))
    across_ = settings_.ignore_small && !small ? Across::kIgnored : Across::kUnknown;
  if (!must_end && !simple) return false;
  link =
      small && settings_.ignore_small && !simple ? CellLink(CellKind::kIgnored, nullptr) : leaf();
  return true;
}

/// Notes what the cell that was refined is across the threshold. Whether its formula is needed to
/// find that out.
bool Refiner::keep_formula(const Cell& cell, CellLink open) const {
  uint64_t& there = across(cell);
  if (there != kNowhere || across_ == Across::kSame) return false;
  const bool unknown = across_ == Across::kUnknown;
  there = (unknown ? open : CellLink(CellKind::kIgnored, nullptr)).bits();
  if (!is_small_) there |= kIfSmall;
  return unknown;
}

CellLink Refiner::decided(bool full) {
  return {full ? CellKind::kFull : CellKind::kEmpty, nullptr};
}

CellLink Refiner::leaf() {
  const CellLink link = analysis_.write(leaves_);
  const Leaf& leaf = link.leaf();
  stats_.memory_bytes += leaf.bytes();
  if (stats_.leaves_by_size.size() <= leaf.literal_count)
    stats_.leaves_by_size.resize(leaf.literal_count + 1);
  ++stats_.leaves_by_size[leaf.literal_count];
  return link;
}

void Refiner::halve(const OpenCell& parent, Cut cut, Halves& halves) {
  halves.cut = cut;
  halves.cost = 0;
  for (int side = 0; side < 2; ++side) {
    OpenCell& part = halves.part[side];
    part = {};
    part.box = parent.box;
    (side == 0 ? part.box.hi : part.box.lo)[cut.axis] = cut.at;
    stats_.classified += parent.token_count;
    halves.truth[side] = simplifier_.simplify(parent.tokens(), part.box, expand_of(parent.literals),
                                              halves.formula[side], parent.near());
    if (halves.truth[side] != Truth::kVaries) continue;
    const Simplifier::Size size = simplifier_.size_of(halves.formula[side]);
    part.literals = size.literals;
    part.is_crowded = size.is_crowded;
    simplifier_.list_near(halves.formula[side], halves.near[side]);
    halves.cost += half_area(part.box) * part.literals;
  }
}

CellLink Refiner::split(const Cell& cell, const OpenCell& parent) {
  const int first = split_axis(parent.box.size(), settings_.split, parent.depth);
  const Vec3 middle = parent.box.center();
  Cut cut{first, middle[first]};
  if (settings_.split == SplitRule::kLongest)
    cut = box_cutter_.cut(parent.tokens(), parent.box, cut).value_or(cut);
  halve(parent, cut, halves_);
  for (int axis = 0; axis < 3 && settings_.split == SplitRule::kCost; ++axis) {
    if (axis == first) continue;
    halve(parent, {axis, middle[axis]}, others_);
    if (others_.cost < halves_.cost) std::swap(others_, halves_);
  }
  size_t unsplit[2] = {0, 0}, weight[2] = {0, 0};
  for (int side = 0; side < 2; ++side) {
    if (halves_.truth[side] != Truth::kVaries) continue;
    unsplit[side] = bytes_unsplit(halves_.part[side].literals,
                                  halves_.formula[side].size() + halves_.near[side].size());
    weight[side] = halves_.part[side].literals + kFew;
  }
  const bool stalls = std::ranges::all_of(halves_.part, [&](const OpenCell& part) {
    return part.literals >= parent.literals && !part.is_crowded;
  });
  const size_t taken = 2 * sizeof(Cell) + unsplit[0] + unsplit[1];
  const double rest = parent.memory > taken ? double(parent.memory - taken) : 0;
  Cell* const cells = new_pair();
  stats_.depth = std::max(stats_.depth, parent.depth + 1);
  for (int side = 0; side < 2; ++side) {
    CellLink link = decided(halves_.truth[side] == Truth::kTrue);
    if (halves_.truth[side] == Truth::kVaries) {
      OpenCell& part = halves_.part[side];
      part.depth = parent.depth + 1;
      part.stalled = stalls ? parent.stalled + 1 : 0;
      part.memory =
          unsplit[side] + size_t(rest * double(weight[side]) / double(weight[0] + weight[1]));
      link = open(part, halves_.formula[side], halves_.near[side]);
    }
    cells[side].bits.store(link.bits(), std::memory_order_relaxed);
    ++stats_.cells[size_t(link.kind())];
  }
  cell.split = halves_.cut.at;
  return {CellKind::kNode, cells, halves_.cut.axis};
}

/// Whether the cell is worth splitting many times at once. Where small cells end early, each split
/// has to be looked at.
bool Refiner::is_wide(std::span<const Token> formula, uint32_t depth) const {
  return formula.size() >= kWide && !has_threshold_ && depth < kMostDepth / 2 &&
         operand_count(formula) >= kWide;
}

/// A loop that helpers share, if there are any.
Loop Refiner::loop_over(const Helpers* helpers) {
  const Workers* const workers = helpers == nullptr ? nullptr : &helpers->workers;
  return
      [workers](size_t n, size_t grain, const auto& body) { for_parts(workers, n, grain, body); };
}

std::optional<CellLink> Refiner::split_wide(const Cell& cell, const OpenCell& parent,
                                            const Helpers* helpers) {
  const size_t wanted = parent.token_count / kWantedOperands;
  const int splits = std::min(int(std::bit_width(wanted)), kMostSplitsAtOnce);
  const SplitGrid grid = make_grid(parent.box, splits, settings_.split, parent.depth);
  const std::vector<Formula> dealt = deal_operands(
      scene_, parent.tokens(), grid, region_edge_ * settings_.margin, loop_over(helpers));
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
    most += 2 * sizeof(Cell) + bytes_unsplit(literals[part], most_words(formulas[part]));
  if (most > parent.memory) return std::nullopt;

  // Every part by itself.
  std::vector<CellLink> links(parts);
  std::vector<OpenCell*> opened(parts);
  loop(parts, 1, [&](size_t first, size_t last, size_t worker) {
    Refiner& refiner = helpers == nullptr ? *this : helpers->refiner_of(worker);
    for (size_t part = first; part < last; ++part) {
      refiner.stats_.classified += formulas[part].size();
      OpenCell child{grid.part(part), 0, parent.depth + splits, 0, 0, false, 0, 0};
      Formula& formula = refiner.halves_.formula[0];
      const Truth truth = refiner.simplifier_.simplify(formulas[part], child.box,
                                                       expand_of(literals[part]), formula, near);
      links[part] = decided(truth == Truth::kTrue);
      if (truth != Truth::kVaries) continue;
      const Simplifier::Size size = refiner.simplifier_.size_of(formula);
      child.literals = size.literals;
      child.is_crowded = size.is_crowded;
      std::vector<uint32_t>& listed = refiner.halves_.near[0];
      refiner.simplifier_.list_near(formula, listed);
      links[part] = refiner.open(child, formula, listed);
      opened[part] = static_cast<OpenCell*>(const_cast<void*>(links[part].target()));
    }
  });

  size_t taken = 2 * sizeof(Cell) * parts, weights = 0;
  bool stalls = true;
  for (const OpenCell* open : opened) {
    stalls = stalls && open != nullptr && open->literals >= parent.literals;
    if (open == nullptr) continue;
    taken += bytes_unsplit(open->literals, open->words());
    weights += open->literals + kFew;
  }
  const double rest = parent.memory > taken ? double(parent.memory - taken) : 0;
  for (OpenCell* open : opened) {
    if (open == nullptr) continue;
    open->stalled = stalls ? parent.stalled + splits : 0;
    open->memory = bytes_unsplit(open->literals, open->words()) +
                   size_t(rest * double(open->literals + kFew) / double(weights));
  }
  stats_.depth = std::max(stats_.depth, parent.depth + splits);
  return join(cell, grid, links);
}

/// The splits that lead to the parts of a grid, the last ones first. What is decided alike on both
/// sides of a split is not split there.
CellLink Refiner::join(const Cell& cell, const SplitGrid& grid, std::vector<CellLink> links) {
  std::vector<double> splits(links.size(), 0);
  std::array<size_t, 3> count{grid.cuts[0].size() - 1, grid.cuts[1].size() - 1,
                              grid.cuts[2].size() - 1};
  std::array<size_t, 3> stride{1, 1, 1};  // of the finest parts
  for (size_t level = grid.axes.size(); level-- > 0;) {
    const int axis = grid.axes[level];
    const size_t along = size_t(axis);
    std::array<size_t, 3> half = count;
    half[along] /= 2;
    std::vector<CellLink> joined(half[0] * half[1] * half[2]);
    std::vector<double> joined_splits(joined.size());
    for (size_t z = 0; z < half[2]; ++z)
      for (size_t y = 0; y < half[1]; ++y)
        for (size_t x = 0; x < half[0]; ++x) {
          const std::array<size_t, 3> to{x, y, z};
          std::array<size_t, 3> low = to;
          low[along] *= 2;
          std::array<size_t, 3> high = low;
          ++high[along];
          const auto number = [&](const std::array<size_t, 3>& at) {
            return (at[2] * count[1] + at[1]) * count[0] + at[0];
          };
          const size_t a = number(low), b = number(high), at = (z * half[1] + y) * half[0] + x;
          if (links[a].bits() == links[b].bits()) {
            joined[at] = links[a];
            continue;
          }
          Cell* const pair = new_pair();
          for (const auto& [made, from] : {std::pair(pair, a), std::pair(pair + 1, b)}) {
            made->split = splits[from];
            made->bits.store(links[from].bits(), std::memory_order_relaxed);
            ++stats_.cells[size_t(links[from].kind())];
          }
          joined[at] = CellLink(CellKind::kNode, pair, axis);
          joined_splits[at] = grid.cuts[along][high[along] * stride[along]];
        }
    links = std::move(joined);
    splits = std::move(joined_splits);
    count = half;
    stride[along] *= 2;
  }
  cell.split = splits[0];
  return links[0];
}

Cell* Refiner::new_pair() {
  const size_t bytes = bytes_of_pair();
  auto* const pair = static_cast<Cell*>(cells_.allocate(bytes, alignof(CellPair)));
  for (Cell* const cell : {pair, pair + 1}) {
    ::new (cell) Cell;
    if (has_threshold_) across(*cell) = kNowhere;
  }
  if (has_threshold_) pair_of(*pair).changed = 0;
  stats_.memory_bytes += bytes;
  return pair;
}

CellLink Refiner::open(const OpenCell& what, std::span<const Token> formula,
                       std::span<const uint32_t> near) {
  const size_t bytes = OpenCell::bytes(formula.size() + near.size());
  auto* const made = ::new (open_cells_.take(bytes)) OpenCell(what);
  made->token_count = uint32_t(formula.size());
  std::uninitialized_copy(formula.begin(), formula.end(), reinterpret_cast<Token*>(made + 1));
  made->near_count = uint32_t(near.size());
  std::uninitialized_copy(near.begin(), near.end(), const_cast<uint32_t*>(made->near().data()));
  stats_.memory_bytes += bytes;
  return {CellKind::kOpen, made};
}

CellLink Refiner::open_region() {
  if (scene_.region.is_empty()) return decided(false);
  Formula simplified;
  std::vector<uint32_t> near;
  std::span<const Token> formula = scene_.formula;
  Simplifier::Size size{expanded_size(scene_, formula), !scene_.boundaries.empty()};
  // Of a wide one nearly all is in the region, and its parts will be looked at by all threads.
  if (!is_wide(formula, 0)) {
    stats_.classified += formula.size();
    const Truth truth =
        simplifier_.simplify(formula, scene_.region, expand_of(size.literals), simplified);
    if (truth != Truth::kVaries) return decided(truth == Truth::kTrue);
    formula = simplified;
    size = simplifier_.size_of(formula);
    simplifier_.list_near(formula, near);
  }
  return open({scene_.region, settings_.memory, 0, 0, size.literals, size.is_crowded, 0, 0},
              formula, near);
}

bool Refiner::simple_enough() const {
  if (settings_.leaf == LeafRule::kHalfSpaces) return analysis_.size() <= settings_.leaf_size;
  return analysis_.primitive_count() <= settings_.leaf_size || analysis_.is_plain_union();
}

}  // namespace whittle
