// Cells for the device, refined and flattened as pictures need them, on many threads.
#pragma once

#include <functional>
#include <memory>
#include <unordered_map>
#include <vector>

#include "base/workers.h"
#include "subdivide/refine.h"
#include "trace/vulkan/flatten.h"
#include "trace/vulkan/front_to_back.h"

namespace whittle {

/// Cells that are sent to the device in one go, and stored behind those that were sent before.
struct CellBatch {
  std::vector<uint32_t> cells, words;  ///< as in FlatCells
  std::vector<VisibleCell> visible;    ///< of them, in the order in which rays meet them
  bool is_last = false;                ///< of a stream
};

/// The host's tree of the cells that were sent. Used by one thread at a time, while no threshold
/// moves. Scene and tree must outlive it.
class CellSupply {
 public:
  CellSupply(const Scene& scene, const CellTree& tree, bool doubles, int threads);

  const Box& region() const { return tree_.region; }
  const FlatCells& flat() const { return flat_; }
  uint32_t cell_count() const { return cell_count_; }
  /// Nothing of it has been looked at, and there is something to be refined.
  bool is_open() const;
  /// To be called before the others when a threshold may have moved (subdivide/threshold.h). Cells
  /// that were sent stay on the device. Those that are out of use are set aside, and found again
  /// when they are wanted; what is new is open. So no cell is sent twice, and the size of the tree
  /// bounds how many are sent.
  void follow();

  /// All that the tile may see, or everything if there is none; in no order. Precondition of this
  /// and of stream(): nothing but the root has a place in flat(), as at the beginning or where
  /// is_open().
  Result<CellBatch> at_once(const Sight* sight);
  /// What of these cells the tile may see; it is added to the other cells that the tile may see,
  /// where it belongs. Both are those of order_front_to_back().
  Result<CellBatch> refined(const std::vector<OpenCellInSight>& open, const Sight& sight,
                            std::vector<VisibleCell>& visible);

  /// What has been solved so far.
  using Solved = std::shared_ptr<const SolvedPixels>;
  /// Takes a batch; false if no more are wanted.
  using Take = std::function<bool(CellBatch)>;
  /// What the tile may see of a tree that is_open(), front to back in batches: no ray meets a cell
  /// of a later batch before one of an earlier. `first_batch_ms`: as in RasterSettings. `solved` is
  /// asked now and then for what has been drawn, or null; what that hides stays open. The last
  /// batch says so, and may be empty. If `take` ends it early, no cells are of use any more.
  Status stream(const Sight& sight, double first_batch_ms, const std::function<Solved()>& solved,
                const Take& take);

 private:
  struct Job {
    const Cell* cell;
    Box box;
    TreePlace place;
    uint32_t depth;
  };
  /// When a batch ends: after some time, or only with everything.
  Status deliver(const Sight* sight, double milliseconds, const std::function<Solved()>& solved,
                 const Take& take);
  /// A place, and the moves of the threshold that have been followed there.
  struct Followed {
    TreePlace place;
    uint64_t moves;
  };
  const Cell& cell_in(TreePlace place) const;
  void follow(Followed& at);
  /// Flattens the jobs side by side, and puts what they give into its places. `ends`, if any, gets
  /// how many visible cells the batch has after each.
  Status run(const std::vector<Job>& jobs, const Wanted& wanted, CellBatch& batch,
             std::vector<size_t>* ends = nullptr);

  const Scene& scene_;
  const CellTree tree_;
  const bool doubles_;
  Workers workers_;
  PerWorker<RefinerLease> refiners_;
  FlatCells flat_;  ///< without the words that have gone
  uint32_t cell_count_ = 0, word_count_ = 0;
  uint64_t moves_ = 0;  ///< of the threshold, that have been followed
  struct Aside {
    uint32_t what;
    uint64_t moves;  ///< that have been followed there
  };
  /// What is out of use, by the leaf or the pair of cells that it was made of.
  std::unordered_map<const void*, Aside> aside_;
};

}  // namespace whittle
