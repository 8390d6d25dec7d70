#include "subdivide/refine.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace whittle {
namespace {

/// Formulas that would have no more literals than this get all their primitives expanded.
constexpr uint32_t kExpandAll = 64;

/// A cell whose formula has not become shorter, in itself and in its sibling, over this many splits
/// in a row is a corner or an edge where many surfaces meet: no split will part them.
uint32_t stall_limit(uint32_t literals) {
  return std::max(6u, literals);
}

/// What a cell takes if it is not split, at most: as a leaf, or open and rounded up to a power of
/// two.
size_t bytes_unsplit(size_t literals, size_t tokens) {
  return 2 * sizeof(OpenCell) + 2 * sizeof(Token) * tokens + 32 * literals;
}

/// Of the memory that is left each part of a cell gets as much as it has of the literals, and as if
/// it had so many more: where few surfaces meet for good, many cells are needed too.
constexpr uint32_t kFew = 16;

/// The link of an open cell that a thread is at.
constexpr uint64_t kBusy = 1u << 7;

/// Those who wait for another thread look so many times in a row, and then now and then.
constexpr int kSpins = 200;
constexpr std::chrono::microseconds kNap{20};

bool has_units(std::span<const Token> formula) {
  return std::any_of(formula.begin(), formula.end(),
                     [](Token token) { return token.kind() == TokenKind::kUnit; });
}

void wait_a_little(int round) {
  if (round < kSpins)
    std::this_thread::yield();
  else
    std::this_thread::sleep_for(kNap);
}

}  // namespace

Refiner::Refiner(const Scene& scene, const SubdivideSettings& settings)
    : scene_(scene),
      settings_(settings),
      region_edge_(max_component(scene.region.size())),
      simplifier_(scene, region_edge_ * kCellMargin),
      analysis_(scene) {}

CellLink Refiner::refined(const Cell& cell) {
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
      const CellLink result = refine(cell, open);
      cell.bits.store(result.bits(), std::memory_order_release);
      --stats_.cells[size_t(CellKind::kOpen)];
      ++stats_.cells[size_t(result.kind())];
      const size_t bytes = OpenCell::bytes(open.token_count);
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

CellLink Refiner::refine(const Cell& cell, const OpenCell& open) {
  CellLink link;
  return ends(open, link) ? link : split(cell, open);
}

/// Whether the cell is not split, and then what it is.
bool Refiner::ends(const OpenCell& open, CellLink& link) {
  const double edge = max_component(open.box.size()) / region_edge_;
  const Box world{open.box.lo + scene_.origin, open.box.hi + scene_.origin};
  const bool small = settings_.is_small && settings_.is_small(world);
  const bool useless = !settings_.is_small && edge * edge * open.literals < settings_.least_use;
  const size_t split_bytes = 2 * (sizeof(Cell) + bytes_unsplit(open.literals, open.token_count));
  const bool must_end = small || useless || edge * 0.5 < settings_.smallest_edge ||
                        open.stalled >= stall_limit(open.literals) || open.depth >= kMostDepth ||
                        open.memory < split_bytes;
  std::span<const Token> formula = open.tokens();
  if (open.literals > kExpandAll && !must_end && !has_few_half_spaces(formula)) return false;
  if (has_units(formula)) {
    const Truth truth = simplifier_.simplify(formula, open.box, true, expanded_);
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
  const bool simple = simple_enough();
  if (!must_end && !simple) return false;
  link =
      small && settings_.ignore_small && !simple ? CellLink(CellKind::kIgnored, nullptr) : leaf();
  return true;
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

CellLink Refiner::split(const Cell& cell, const OpenCell& parent) {
  const Place place = choose_split(parent);
  OpenCell child[2];
  Truth truth[2];
  size_t unsplit[2] = {0, 0}, weight[2] = {0, 0};
  for (int side = 0; side < 2; ++side) {
    child[side].box = parent.box;
    (side == 0 ? child[side].box.hi : child[side].box.lo)[place.axis] = place.at;
    stats_.classified += parent.token_count;
    truth[side] = simplifier_.simplify(parent.tokens(), child[side].box,
                                       parent.literals <= kExpandAll, child_formula_[side]);
    child[side].literals = expanded_size(scene_, child_formula_[side]);
    if (truth[side] != Truth::kVaries) continue;
    unsplit[side] = bytes_unsplit(child[side].literals, child_formula_[side].size());
    weight[side] = child[side].literals + kFew;
  }
  const bool stalls = child[0].literals >= parent.literals && child[1].literals >= parent.literals;
  const size_t taken = 2 * sizeof(Cell) + unsplit[0] + unsplit[1];
  const double rest = parent.memory > taken ? double(parent.memory - taken) : 0;
  auto* const cells = static_cast<Cell*>(cells_.allocate(2 * sizeof(Cell), 2 * sizeof(Cell)));
  stats_.memory_bytes += 2 * sizeof(Cell);
  stats_.depth = std::max(stats_.depth, parent.depth + 1);
  for (int side = 0; side < 2; ++side) {
    Cell* const made = ::new (cells + side) Cell;
    CellLink link = decided(truth[side] == Truth::kTrue);
    if (truth[side] == Truth::kVaries) {
      child[side].depth = parent.depth + 1;
      child[side].stalled = stalls ? parent.stalled + 1 : 0;
      child[side].memory =
          unsplit[side] + size_t(rest * double(weight[side]) / double(weight[0] + weight[1]));
      link = open(child[side], child_formula_[side]);
    }
    made->bits.store(link.bits(), std::memory_order_relaxed);
    ++stats_.cells[size_t(link.kind())];
  }
  cell.split = place.at;
  return {CellKind::kNode, cells, place.axis};
}

CellLink Refiner::open(const OpenCell& what, std::span<const Token> formula) {
  const size_t bytes = OpenCell::bytes(formula.size());
  auto* const made = ::new (open_cells_.take(bytes)) OpenCell(what);
  made->token_count = uint32_t(formula.size());
  std::uninitialized_copy(formula.begin(), formula.end(), reinterpret_cast<Token*>(made + 1));
  stats_.memory_bytes += bytes;
  return {CellKind::kOpen, made};
}

/// Whether a formula, however long, has no more half-spaces than a truth table can hold: many
/// copies of one body.
bool Refiner::has_few_half_spaces(std::span<const Token> formula) const {
  std::array<uint32_t, kTableLiterals> known;
  size_t count = 0;
  const auto is_one_more_known = [&](uint32_t face) {
    const uint32_t number = scene_.faces[face].literal >> 1;
    if (std::find(known.begin(), known.begin() + count, number) != known.begin() + count)
      return true;
    if (count == known.size()) return false;
    known[count++] = number;
    return true;
  };
  return std::all_of(formula.begin(), formula.end(), [&](Token token) {
    if (token.is_group()) return true;
    if (token.kind() == TokenKind::kFace) return is_one_more_known(token.payload());
    const Unit& unit = scene_.units[token.payload()];
    for (uint32_t k = 0; k < unit.face_count; ++k)
      if (!is_one_more_known(unit.first_face + k)) return false;
    return true;
  });
}

bool Refiner::simple_enough() const {
  if (settings_.leaf == LeafRule::kHalfSpaces) return analysis_.size() <= settings_.leaf_size;
  return analysis_.primitive_count() <= settings_.leaf_size || analysis_.is_plain_union();
}

Refiner::Place Refiner::choose_split(const OpenCell& open) const {
  const Vec3 size = open.box.size();
  int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  if (settings_.split == SplitRule::kXyz) axis = int(open.depth % 3);
  return {axis, open.box.center()[axis]};
}

RefinerPool::RefinerPool(const Scene& scene, const SubdivideSettings& settings)
    : scene_(scene), settings_(settings) {
  open_root();
}

void RefinerPool::open_root() {
  Refiner& refiner = take();
  CellLink link;
  if (!scene_.region.is_empty()) {
    refiner.stats_.classified += scene_.formula.size();
    Formula formula;
    const Truth truth =
        refiner.simplifier_.simplify(scene_.formula, scene_.region,
                                     expanded_size(scene_, scene_.formula) <= kExpandAll, formula);
    const OpenCell whole{scene_.region, settings_.memory, 0, 0, expanded_size(scene_, formula), 0};
    link = truth == Truth::kVaries ? refiner.open(whole, formula)
                                   : refiner.decided(truth == Truth::kTrue);
  }
  root_.bits.store(link.bits(), std::memory_order_relaxed);
  ++refiner.stats_.cells[size_t(link.kind())];
  refiner.stats_.memory_bytes += sizeof(Cell);
  give(refiner);
}

Refiner& RefinerPool::take() {
  const std::lock_guard lock(mutex_);
  if (unused_.empty()) {
    all_.push_back(std::make_unique<Refiner>(scene_, settings_));
    unused_.reserve(all_.size());
    return *all_.back();
  }
  Refiner& refiner = *unused_.back();
  unused_.pop_back();
  return refiner;
}

void RefinerPool::give(Refiner& refiner) {
  const std::lock_guard lock(mutex_);
  unused_.push_back(&refiner);
}

SubdivideStats RefinerPool::stats() const {
  SubdivideStats sum;
  for (const auto& refiner : all_) {
    const SubdivideStats& part = refiner->stats_;
    for (size_t kind = 0; kind < sum.cells.size(); ++kind) sum.cells[kind] += part.cells[kind];
    if (sum.leaves_by_size.size() < part.leaves_by_size.size())
      sum.leaves_by_size.resize(part.leaves_by_size.size());
    for (size_t size = 0; size < part.leaves_by_size.size(); ++size)
      sum.leaves_by_size[size] += part.leaves_by_size[size];
    sum.depth = std::max(sum.depth, part.depth);
    sum.classified += part.classified;
    sum.memory_bytes += part.memory_bytes;
  }
  return sum;
}

}  // namespace whittle
