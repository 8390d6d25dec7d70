#include "subdivide/subdivide.h"

#include <algorithm>
#include <array>
#include <optional>

#include "base/workers.h"
#include "subdivide/leaf.h"
#include "subdivide/simplify.h"

namespace whittle {
namespace {

/// Formulas that would have no more literals than this get all their primitives expanded.
constexpr uint32_t kExpandAll = 64;

/// The tree is split in breadth, level by level, until so many cells are open; then each of them is
/// built on its own. Enough to keep many threads busy, few enough to cost nothing.
constexpr size_t kFrontier = 512;

/// The budget, max_cells, counts a cell as one, and so many literals or tokens that are kept as one
/// more. As they were looked at on the way, that bounds the time as well.
constexpr size_t kKeptPerCell = 4;

/// A cell whose formula has not become shorter, in itself and in its sibling, over this many splits
/// in a row is a corner or an edge where many surfaces meet: no split will part them.
uint32_t stall_limit(uint32_t literals) {
  return std::max(6u, literals);
}

/// A cell on its way: its formula is already simplified for its box.
struct OpenCell {
  Box box;
  Formula formula;
  uint32_t depth = 0;
  uint32_t stalled = 0;  ///< splits since the formula last became shorter
};

/// Builds cells, appending to a tree of its own.
class Builder {
 public:
  /// `budget` as max_cells, for the cells that are built here.
  Builder(const Scene& scene, const SubdivideSettings& settings, size_t budget)
      : scene_(scene),
        settings_(settings),
        region_edge_(max_component(scene.region.size())),
        budget_(budget),
        simplifier_(scene, region_edge_ * kCellMargin),
        leaf_(scene) {}

  CellTree tree;

  /// The region's cell. Returns false if that is already all there is.
  bool open_root(OpenCell& root) {
    Formula formula = std::move(root.formula);
    tree.cells.resize(1);
    return open(formula, expanded_size(scene_, formula), root, 0);
  }

  /// Ends the cell as a leaf, or splits it and gives its two children, each with a value if it
  /// stays open.
  struct Children {
    std::array<std::optional<OpenCell>, 2> child;
  };
  Children step(OpenCell cell, uint32_t slot) {
    Children result;
    const uint32_t literals = expanded_size(scene_, cell.formula);
    if (end_here(cell, slot, literals)) return result;
    const Split split = choose_split(cell);
    tree.cells[slot].kind = CellKind::kNode;
    tree.cells[slot].axis = uint8_t(split.axis);
    tree.cells[slot].split = split.at;
    tree.cells[slot].index = uint32_t(tree.cells.size());
    tree.cells.resize(tree.cells.size() + 2);
    const uint32_t first = tree.cells[slot].index;
    uint32_t sizes[2] = {0, 0};
    for (uint32_t side = 0; side < 2; ++side) {
      OpenCell child;
      child.box = cell.box;
      (side == 0 ? child.box.hi : child.box.lo)[split.axis] = split.at;
      child.depth = cell.depth + 1;
      if (!open(cell.formula, literals, child, first + side)) continue;
      sizes[side] = expanded_size(scene_, child.formula);
      result.child[side] = std::move(child);
    }
    const bool stalls = sizes[0] >= literals && sizes[1] >= literals;
    for (auto& child : result.child)
      if (child) child->stalled = stalls ? cell.stalled + 1 : 0;
    return result;
  }

  /// Builds everything below an open cell. The stack is as deep as the tree, not as the model.
  void finish(OpenCell root, uint32_t root_slot) {
    struct Pending {
      OpenCell cell;
      uint32_t slot;
    };
    std::vector<Pending> pending;
    const auto push = [&](OpenCell cell, uint32_t slot) {
      pending_tokens_ += cell.formula.size();
      pending.push_back({std::move(cell), slot});
    };
    push(std::move(root), root_slot);
    while (!pending.empty()) {
      Pending now = std::move(pending.back());
      pending.pop_back();
      pending_tokens_ -= now.cell.formula.size();
      Children children = step(std::move(now.cell), now.slot);
      const uint32_t first = tree.cells[now.slot].index;
      for (uint32_t side = 2; side-- > 0;)
        if (children.child[side]) push(std::move(*children.child[side]), first + side);
    }
  }

 private:
  struct Split {
    int axis;
    double at;
  };

  /// Simplifies the formula around for this cell. False if the cell is empty or full: it is done.
  bool open(const Formula& around, uint32_t around_literals, OpenCell& cell, uint32_t slot) {
    tree.stats.depth = std::max(tree.stats.depth, cell.depth);
    tree.stats.classified += around.size();
    const Truth truth =
        simplifier_.simplify(around, cell.box, around_literals <= kExpandAll, cell.formula);
    if (truth == Truth::kVaries) return true;
    tree.cells[slot].kind = truth == Truth::kTrue ? CellKind::kFull : CellKind::kEmpty;
    return false;
  }

  /// Makes the cell a leaf (or empty, full, ignored) if a rule says so.
  bool end_here(OpenCell& cell, uint32_t slot, uint32_t literals) {
    const double edge = max_component(cell.box.size()) / region_edge_;
    const bool small = settings_.is_small && settings_.is_small(world(cell.box));
    const bool useless = !settings_.is_small && edge * edge * literals < settings_.least_use;
    const bool must_end = small || useless || edge * 0.5 < settings_.smallest_edge ||
                          cell.stalled >= stall_limit(literals) || spent() > budget_;
    if (literals > kExpandAll && !must_end && !has_few_half_spaces(cell.formula)) return false;
    if (has_units(cell.formula)) {
      const Formula units = std::move(cell.formula);
      const Truth truth = simplifier_.simplify(units, cell.box, true, cell.formula);
      if (truth != Truth::kVaries) {
        tree.cells[slot].kind = truth == Truth::kTrue ? CellKind::kFull : CellKind::kEmpty;
        return true;
      }
    }
    leaf_.analyse(cell.formula);
    if (leaf_.size() == 0) {
      tree.cells[slot].kind = leaf_.constant_value() ? CellKind::kFull : CellKind::kEmpty;
      return true;
    }
    if (!must_end && !simple_enough()) return false;
    if (small && settings_.ignore_small && !simple_enough())
      tree.cells[slot].kind = CellKind::kIgnored;
    else
      tree.cells[slot] = leaf_.append_to(tree);
    return true;
  }

  /// Of the budget, if one more cell is split.
  size_t spent() const {
    const size_t kept = tree.literals.size() + tree.tokens.size() + pending_tokens_;
    return tree.cells.size() + 2 + kept / kKeptPerCell;
  }

  /// Whether a formula, however long, has no more half-spaces than a truth table can hold: many
  /// copies of one body.
  bool has_few_half_spaces(const Formula& formula) const {
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

  bool simple_enough() const {
    if (settings_.leaf == LeafRule::kHalfSpaces) return leaf_.size() <= settings_.leaf_size;
    return leaf_.primitive_count() <= settings_.leaf_size || leaf_.is_plain_union();
  }

  bool has_units(const Formula& formula) const {
    return std::any_of(formula.begin(), formula.end(),
                       [](Token token) { return token.kind() == TokenKind::kUnit; });
  }

  Box world(const Box& box) const { return {box.lo + scene_.origin, box.hi + scene_.origin}; }

  Split choose_split(const OpenCell& cell) const {
    const Vec3 size = cell.box.size();
    int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    if (settings_.split == SplitRule::kXyz) axis = int(cell.depth % 3);
    return {axis, cell.box.center()[axis]};
  }

  const Scene& scene_;
  const SubdivideSettings& settings_;
  double region_edge_;
  size_t budget_;
  size_t pending_tokens_ = 0;  ///< in formulas of cells that finish() has open
  Simplifier simplifier_;
  LeafAnalysis leaf_;
};

/// Appends a part built elsewhere: its first cell goes to `slot`, all numbers move by what is
/// there.
void append(CellTree& whole, CellTree part, uint32_t slot) {
  const uint32_t cells = uint32_t(whole.cells.size()) - 1, leaves = uint32_t(whole.leaves.size()),
                 literals = uint32_t(whole.literals.size()), steps = uint32_t(whole.steps.size()),
                 tokens = uint32_t(whole.tokens.size());
  const auto moved = [&](Cell cell) {
    if (cell.kind == CellKind::kNode)
      cell.index += cells;
    else
      cell.index += leaves;
    return cell;
  };
  whole.cells[slot] = moved(part.cells[0]);
  for (size_t i = 1; i < part.cells.size(); ++i) whole.cells.push_back(moved(part.cells[i]));
  for (Leaf leaf : part.leaves) {
    leaf.first_literal += literals, leaf.first_step += steps, leaf.first_token += tokens;
    whole.leaves.push_back(leaf);
  }
  whole.literals.insert(whole.literals.end(), part.literals.begin(), part.literals.end());
  whole.steps.insert(whole.steps.end(), part.steps.begin(), part.steps.end());
  whole.tokens.insert(whole.tokens.end(), part.tokens.begin(), part.tokens.end());
  whole.stats.depth = std::max(whole.stats.depth, part.stats.depth);
  whole.stats.classified += part.stats.classified;
}

void count(CellTree& tree) {
  for (const Cell& cell : tree.cells) ++tree.stats.cells[size_t(cell.kind)];
  for (const Leaf& leaf : tree.leaves) {
    if (tree.stats.leaves_by_size.size() <= leaf.literal_count)
      tree.stats.leaves_by_size.resize(leaf.literal_count + 1);
    ++tree.stats.leaves_by_size[leaf.literal_count];
  }
  const auto bytes = [](const auto& v) { return v.size() * sizeof(v[0]); };
  tree.stats.memory_bytes = bytes(tree.cells) + bytes(tree.leaves) + bytes(tree.literals) +
                            bytes(tree.steps) + bytes(tree.tokens);
}

struct Frontier {
  OpenCell cell;
  uint32_t slot;
};

/// Whether the tree is split in breadth by one more level. Where nothing gets simpler, formulas
/// would only fill the memory: they may take half of what is left.
bool widens(const std::vector<Frontier>& frontier, size_t budget_left) {
  if (frontier.empty() || frontier.size() >= kFrontier || 2 * frontier.size() > budget_left)
    return false;
  size_t tokens = 0;
  for (const Frontier& open : frontier) tokens += open.cell.formula.size();
  return tokens / kKeptPerCell <= budget_left / 2;
}

/// What each open cell gets of the budget: half of it in equal parts, half by how much is in them.
/// Decided beforehand, so that the cells do not depend on which thread is first.
std::vector<size_t> shares(const std::vector<Frontier>& frontier, const Scene& scene,
                           size_t budget) {
  std::vector<size_t> sizes;
  size_t total = 0;
  for (const Frontier& open : frontier) {
    sizes.push_back(expanded_size(scene, open.cell.formula));
    total += sizes.back();
  }
  std::vector<size_t> result;
  const double half = 0.5 * double(budget);
  for (const size_t size : sizes)
    result.push_back(size_t(half / double(sizes.size()) + half * double(size) / double(total)));
  return result;
}

}  // namespace

CellTree subdivide(const Scene& scene, const SubdivideSettings& settings) {
  const auto builder = [&](size_t budget) { return Builder(scene, settings, budget); };

  Builder top = builder(settings.max_cells);
  top.tree.region = scene.region;
  if (scene.region.is_empty()) {
    top.tree.cells.resize(1);
    count(top.tree);
    return std::move(top.tree);
  }
  std::vector<Frontier> frontier(1);
  frontier[0].cell.box = scene.region;
  frontier[0].cell.formula = scene.formula;
  frontier[0].slot = 0;
  if (!top.open_root(frontier[0].cell)) frontier.clear();

  Workers workers(settings.threads);
  const auto budget_left = [&] {
    return settings.max_cells - std::min(settings.max_cells, top.tree.cells.size());
  };
  while (widens(frontier, budget_left())) {
    std::vector<Frontier> next;
    std::vector<CellTree> parts(frontier.size());
    std::vector<Builder::Children> children(frontier.size());
    workers.for_parts(frontier.size(), 1, [&](size_t first, size_t last, size_t) {
      for (size_t i = first; i < last; ++i) {
        Builder part = builder(settings.max_cells);
        part.tree.cells.resize(1);
        children[i] = part.step(std::move(frontier[i].cell), 0);
        parts[i] = std::move(part.tree);
      }
    });
    for (size_t i = 0; i < frontier.size(); ++i) {
      append(top.tree, std::move(parts[i]), frontier[i].slot);
      for (uint32_t side = 0; side < 2; ++side)
        if (children[i].child[side])
          next.push_back(
              {std::move(*children[i].child[side]), top.tree.cells[frontier[i].slot].index + side});
    }
    frontier = std::move(next);
  }

  std::vector<CellTree> parts(frontier.size());
  const std::vector<size_t> budgets = shares(frontier, scene, budget_left());
  workers.for_parts(frontier.size(), 1, [&](size_t first, size_t last, size_t) {
    for (size_t i = first; i < last; ++i) {
      Builder part = builder(budgets[i]);
      part.tree.cells.resize(1);
      part.finish(std::move(frontier[i].cell), 0);
      parts[i] = std::move(part.tree);
    }
  });
  for (size_t i = 0; i < frontier.size(); ++i)
    append(top.tree, std::move(parts[i]), frontier[i].slot);
  count(top.tree);
  return std::move(top.tree);
}

}  // namespace whittle
