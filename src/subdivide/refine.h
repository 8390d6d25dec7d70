// Refining: what turns an open cell into a leaf or into two cells, by one thread at a time and only
// when somebody wants to know.
//
// What a cell becomes follows from the cell alone: its box, its formula and its share of the
// memory. So the cells do not depend on who refines them, in which order, or on which of them are
// refined.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "base/arena.h"
#include "subdivide/leaf.h"
#include "subdivide/simplify.h"
#include "subdivide/subdivide.h"
#include "subdivide/wide.h"

namespace whittle {

/// A cell that is not known yet. Its formula is simplified for its box; the tokens stand behind.
struct OpenCell {
  Box box;
  size_t memory;  ///< its share: what it and all below it may take
  uint32_t depth;
  uint32_t stalled;   ///< splits since the formula last became shorter
  uint32_t literals;  ///< of the formula, expanded
  uint32_t token_count;

  std::span<const Token> tokens() const {
    return {reinterpret_cast<const Token*>(this + 1), token_count};
  }
  static size_t bytes(size_t tokens) { return sizeof(OpenCell) + tokens * sizeof(Token); }
};

class Refiner;

/// Threads that help to refine one cell, as long as there are few of them.
struct Helpers {
  const Workers& workers;
  std::function<Refiner&(size_t worker)> refiner_of;
};

/// Refines cells of one tree; used by one thread at a time.
class Refiner {
 public:
  Refiner(const Scene& scene, const UnitBoxes& boxes, const SubdivideSettings& settings);

  /// What the cell is; never kOpen. If another thread is at it, waits for that. What it throws (out
  /// of memory) leaves the cell open. With helpers, not from within a loop of theirs.
  CellLink refined(const Cell& cell, const Helpers* helpers = nullptr);
  /// Refines the cell and all below.
  void refine_all(const Cell& cell);

 private:
  friend class RefinerPool;

  CellLink refine(const Cell& cell, const OpenCell& open, const Helpers* helpers);
  bool ends(const OpenCell& open, CellLink& link);
  /// The two parts of a cell cut in the middle: boxes, truths, formulas.
  struct Halves {
    int axis = 0;
    double at = 0;
    OpenCell part[2] = {};
    Truth truth[2] = {};
    Formula formula[2];
    double cost = 0;  ///< literals that a ray through the parent will meet, up to a factor
  };
  void halve(const OpenCell& parent, int axis, Halves& halves);
  CellLink split(const Cell& cell, const OpenCell& open);
  CellLink leaf();
  bool has_few_half_spaces(std::span<const Token> formula) const;
  bool simple_enough() const;
  bool is_wide(std::span<const Token> formula, uint32_t depth) const;
  std::optional<CellLink> split_wide(const Cell& cell, const OpenCell& parent,
                                     const Helpers* helpers);
  std::optional<CellLink> open_parts(const Cell& cell, const OpenCell& parent,
                                     const SplitGrid& grid,
                                     const std::vector<std::span<const Token>>& formulas,
                                     const Helpers* helpers);
  static Loop loop_over(const Helpers* helpers);
  CellLink join(const Cell& cell, const SplitGrid& grid, std::vector<CellLink> links);
  Cell* new_pair();
  /// A cell of its own, open or decided already.
  CellLink open(const OpenCell& what, std::span<const Token> formula);
  CellLink decided(bool full);

  const Scene& scene_;
  const SubdivideSettings& settings_;
  double region_edge_;
  Arena cells_, leaves_;
  BlockPool open_cells_;
  Simplifier simplifier_;
  LeafAnalysis analysis_;
  Halves halves_, others_;
  Formula expanded_;
  std::vector<const Cell*> pending_;
  /// Counters wrap: a cell that one refiner opened may be refined by another.
  SubdivideStats stats_;
};

/// All refiners of a tree, and so all its cells.
class RefinerPool {
 public:
  RefinerPool(const Scene& scene, const SubdivideSettings& settings, const Workers* workers);

  /// One that nobody uses.
  Refiner& take();
  void give(Refiner& refiner);

  /// The region's cell.
  const Cell& root() const { return root_; }
  SubdivideStats stats() const;

 private:
  void open_root();

  const Scene& scene_;
  const SubdivideSettings settings_;
  const UnitBoxes boxes_;
  Cell root_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Refiner>> all_;
  std::vector<Refiner*> unused_;
};

/// The right to refine cells of a tree, for one thread at a time; the tree must outlive it.
class RefinerLease {
 public:
  explicit RefinerLease(const CellTree& tree) : pool_(*tree.refiner_pool), refiner_(pool_.take()) {}
  ~RefinerLease() { pool_.give(refiner_); }
  RefinerLease(const RefinerLease&) = delete;
  RefinerLease& operator=(const RefinerLease&) = delete;

  Refiner* operator->() const { return &refiner_; }
  Refiner& operator*() const { return refiner_; }

 private:
  RefinerPool& pool_;
  Refiner& refiner_;
};

}  // namespace whittle
