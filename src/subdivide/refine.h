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
#include "subdivide/box_cut.h"
#include "subdivide/leaf.h"
#include "subdivide/simplify.h"
#include "subdivide/subdivide.h"
#include "subdivide/threshold.h"
#include "subdivide/wide.h"

namespace whittle {

/// A cell that is not known yet. Its formula is simplified for its box; the tokens stand behind,
/// and then which triangles of boundaries reach the cell.
struct OpenCell {
  Box box;
  size_t memory;  ///< its share: what it and all below it may take
  uint32_t depth;
  uint32_t stalled;   ///< splits since the formula last became shorter
  uint32_t literals;  ///< of the formula, expanded
  bool is_crowded;    ///< boundaries are in it with many more triangles (Simplifier::Size)
  uint32_t token_count;
  uint32_t near_count;

  std::span<const Token> tokens() const {
    return {reinterpret_cast<const Token*>(this + 1), token_count};
  }
  /// See NearTriangles.
  std::span<const uint32_t> near() const {
    return {reinterpret_cast<const uint32_t*>(tokens().data() + token_count), near_count};
  }
  /// Of tokens and of what is near.
  size_t words() const { return size_t(token_count) + near_count; }
  static_assert(sizeof(Token) == sizeof(uint32_t));
  static size_t bytes(size_t words) { return sizeof(OpenCell) + words * sizeof(Token); }
};

/// Two cells in a row, aligned so that either tells where the pair begins. What follows them is
/// there only if there is a threshold: what each of them would be on its other side, and the last
/// move of it that changed one of them or anything below.
struct alignas(2 * sizeof(Cell)) CellPair {
  Cell cells[2];
  uint64_t across[2];
  uint64_t changed;
};

/// The pair of which a cell is one.
inline CellPair& pair_of(const Cell& cell) {
  const auto at = reinterpret_cast<uintptr_t>(&cell);
  return *reinterpret_cast<CellPair*>(at - at % alignof(CellPair));
}

/// What a cell of a pair would be if it were small and is not, or the other way round: the bits of
/// its link, and kIfSmall in the first case. Open: not known yet. kNowhere: the same as it is, or
/// it is open and nobody knows at all.
inline uint64_t& across(const Cell& cell) {
  CellPair& pair = pair_of(cell);
  return pair.across[&cell == pair.cells ? 0 : 1];
}
inline constexpr uint64_t kIfSmall = 1u << 6;
inline constexpr uint64_t kNowhere = uint64_t(CellKind::kOpen);

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

  /// The whole region, open or decided already.
  CellLink open_region();
  CellLink refine(const Cell& cell, const OpenCell& open, const Helpers* helpers);
  bool ends(const OpenCell& open, CellLink& link);
  size_t bytes_unsplit(size_t literals, size_t words) const;
  size_t most_words(std::span<const Token> formula) const;
  bool keep_formula(const Cell& cell, CellLink open) const;
  size_t bytes_of_pair() const { return has_threshold_ ? sizeof(CellPair) : 2 * sizeof(Cell); }
  /// The two parts of a cell that is cut: boxes, truths, formulas.
  struct Halves {
    Cut cut;
    OpenCell part[2] = {};
    Truth truth[2] = {};
    Formula formula[2];
    std::vector<uint32_t> near[2];
    double cost = 0;  ///< literals that a ray through the parent will meet, up to a factor
  };
  void halve(const OpenCell& parent, Cut cut, Halves& halves);
  CellLink split(const Cell& cell, const OpenCell& open);
  CellLink leaf();
  bool simple_enough() const;
  bool is_wide(std::span<const Token> formula, uint32_t depth) const;
  std::optional<CellLink> split_wide(const Cell& cell, const OpenCell& parent,
                                     const Helpers* helpers);
  std::optional<CellLink> open_parts(const Cell& cell, const OpenCell& parent,
                                     const SplitGrid& grid,
                                     const std::vector<std::span<const Token>>& formulas,
                                     std::span<const uint32_t> near, const Helpers* helpers);
  static Loop loop_over(const Helpers* helpers);
  CellLink join(const Cell& cell, const SplitGrid& grid, std::vector<CellLink> links);
  Cell* new_pair();
  /// A cell of its own, open or decided already.
  CellLink open(const OpenCell& what, std::span<const Token> formula,
                std::span<const uint32_t> near);
  CellLink decided(bool full);

  const Scene& scene_;
  const SubdivideSettings& settings_;
  const bool has_threshold_;
  double region_edge_;
  Arena cells_, leaves_;
  BlockPool open_cells_;
  Simplifier simplifier_;
  BoxCutter box_cutter_;
  LeafAnalysis analysis_;
  Halves halves_, others_;
  Formula expanded_;
  // Of the cell that is refined.
  bool is_small_ = false;
  Across across_ = Across::kSame;
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
