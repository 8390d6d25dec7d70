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

#include "subdivide/box_cut.h"
#include "subdivide/cell_store.h"
#include "subdivide/leaf.h"
#include "subdivide/open_cell.h"
#include "subdivide/simplify.h"
#include "subdivide/split_rules.h"
#include "subdivide/subdivide.h"
#include "subdivide/threshold.h"
#include "subdivide/wide.h"

namespace whittle {

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

  /// Whether a cell would be another one across the threshold, and how much is known of that.
  enum class Across { kSame, kIgnored, kUnknown };

  /// What is found out about a cell when it is asked whether it ends.
  struct Ending {
    std::optional<CellLink> link;  ///< what the cell is; none: it is to be split
    bool is_small = false;
    Across across = Across::kSame;
  };

  /// The two parts of a cell that is cut: boxes, truths, formulas.
  struct Halves {
    BoxCut cut;
    OpenCell part[2] = {};
    Truth truth[2] = {};
    Formula formula[2];
    std::vector<uint32_t> near[2];
    double cost = 0;  ///< literals that a ray through the parent will meet, up to a factor
  };

  /// The whole region, open or decided already.
  CellLink open_region();
  Ending ending(const OpenCell& open);
  CellLink split(const Cell& cell, const OpenCell& open, const Helpers* helpers);
  CellLink split_in_two(const Cell& cell, const OpenCell& open);
  void halve(const OpenCell& parent, BoxCut cut, Halves& halves);
  bool is_wide(std::span<const Token> formula, uint32_t depth) const;
  std::optional<CellLink> split_wide(const Cell& cell, const OpenCell& parent,
                                     const Helpers* helpers);
  std::optional<CellLink> open_parts(const Cell& cell, const OpenCell& parent,
                                     const SplitGrid& grid,
                                     const std::vector<std::span<const Token>>& formulas,
                                     std::span<const uint32_t> near, const Helpers* helpers);

  const Scene& scene_;
  const SubdivideSettings& settings_;
  const SplitRules rules_;
  const double margin_;  ///< how far cells are grown, local units
  CellStore store_;
  Simplifier simplifier_;
  BoxCutter box_cutter_;
  LeafAnalysis analysis_;
  // Scratch space.
  Halves halves_, others_;
  Formula expanded_;
  std::vector<const Cell*> pending_;
};

/// All refiners of a tree, and so all its cells.
class RefinerPool {
 public:
  RefinerPool(const Scene& scene, const SubdivideSettings& settings, const Workers* workers);

  /// One that nobody uses.
  Refiner& take();
  void give(Refiner& refiner);

  /// The region's cell.
  const Cell& root() const { return root_.cells[0]; }
  SubdivideStats stats() const;

  /// See threshold.h.
  MovedThreshold move(IsSmall is_small, const Workers& workers);
  /// How often that was done.
  uint64_t moves() const { return moves_; }

 private:
  const Scene& scene_;
  SubdivideSettings settings_;
  const UnitBoxes boxes_;
  CellPair root_;  ///< its first cell is the root
  uint64_t moves_ = 0;
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
