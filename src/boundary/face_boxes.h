// The boxes of one body's faces, in groups of neighbours in their order, and these again in groups.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/box.h"

namespace whittle {

class FaceBoxes {
 public:
  static constexpr size_t kGroup = 4;
  struct Node {
    uint32_t level = 0;  ///< 0: a face
    uint32_t index = 0;
  };

  /// `boxes` must live on. There is at least one.
  void set(std::span<const Box> boxes);

  Node root() const { return {height_, 0}; }
  const Box& box(Node node) const {
    return node.level == 0 ? faces_[node.index] : levels_[node.level - 1][node.index];
  }
  /// The nodes below one that is no face, from the first to before the last.
  uint32_t first_below(Node node) const { return node.index * uint32_t(kGroup); }
  uint32_t last_below(Node node) const;

  /// The faces whose boxes meet one's, but for itself.
  void neighbours(uint32_t face, std::vector<uint32_t>& found);

 private:
  std::span<const Box> faces_;
  uint32_t height_ = 0;
  std::vector<std::vector<Box>> levels_;  ///< of groups; more than the height are left from before
  std::vector<Node> stack_;
};

}  // namespace whittle
