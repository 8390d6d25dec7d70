// The cells of one tile, sorted by case, and the indirect commands that draw them in two passes.
// The first draws the cells that are probably seen, the second those of the others that the first
// does not hide.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "trace/vulkan/bindings.h"
#include "trace/vulkan/front_to_back.h"

namespace whittle {

/// What is done to find cells that are hidden.
enum class Hiding {
  kNone,       ///< all cells are drawn in the first pass
  kPicture,    ///< cells of the second pass are tested
  kEverything  ///< those of both are: some pixels are shut, or parts were drawn before
};

class DrawList {
 public:
  enum Pass { kFirst, kSecond };

  /// Fills the list. `cells`: front to back, behind `rank` others. `last_seen`: by number of a
  /// cell, the picture in which it was last seen; those seen in `since` or later are drawn in the
  /// first pass, or if there are none the front ones. Compiles the shaders it needs. A kMachine
  /// error if there are more ranks than a depth buffer can tell apart.
  Status fill(RasterDevice& device, const Bindings& bindings, std::span<const VisibleCell> cells,
              uint32_t rank, std::span<const uint32_t> last_seen, uint32_t since, Hiding hiding);

  /// Whether that pass needs record_test() before it is drawn.
  bool is_tested(Pass pass) const {
    return hiding_ == Hiding::kEverything || (hiding_ == Hiding::kPicture && pass == kSecond);
  }
  /// Leaves out of the pass what the pyramid of depths hides; waits for that.
  void record_test(VkCommandBuffer commands, Pass pass) const;
  /// Between vkCmdBeginRendering() and its end; the bindings are in use.
  void record(VkCommandBuffer commands, Pass pass) const;

  /// Calls of each pass.
  uint32_t size() const { return uint32_t(draws_.size()); }
  /// After all that was recorded has run: the cells that were drawn.
  uint64_t drawn(Pass pass) const;

 private:
  /// Cells of one case, which are all drawn as boxes or all as squares.
  struct Draw {
    LeafCase shader = kAnyLeaf;
    bool is_wide = false;
    uint32_t first = 0, count[2] = {};  ///< instances, and how many belong to each pass
  };
  /// As shaders/hidden.comp has it.
  struct Command {
    VkDrawIndexedIndirectCommand draw;
    uint32_t first, count;  ///< instances to test
    uint32_t to;            ///< where those go that are not hidden
  };
  static_assert(offsetof(Command, first) == 20 && offsetof(Command, count) == 24 &&
                offsetof(Command, to) == 28 && sizeof(Command) == 32);

  void write_commands();
  /// Where a command finds its instances.
  uint32_t source(const Draw& draw, Pass pass) const;
  bool is_tested(const Draw& draw, Pass pass) const { return is_tested(pass) && !draw.is_wide; }
  Command* command(Pass pass) const {
    return static_cast<Command*>(commands_.mapped()) + pass * draws_.size();
  }

  const RasterDevice* device_ = nullptr;
  const Bindings* bindings_ = nullptr;
  Hiding hiding_ = Hiding::kNone;
  std::vector<Draw> draws_;
  uint32_t instance_count_ = 0;
  gpu::Buffer instances_;  ///< all, and behind them room for those that a test leaves
  gpu::Buffer commands_;   ///< of the first pass, and of the second
};

}  // namespace whittle
