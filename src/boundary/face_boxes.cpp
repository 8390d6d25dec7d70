#include "boundary/face_boxes.h"

#include <algorithm>

namespace whittle {
namespace {

bool meet(const Box& a, const Box& b) {
  return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y &&
         a.lo.z <= b.hi.z && b.lo.z <= a.hi.z;
}

}  // namespace

void FaceBoxes::set(std::span<const Box> boxes) {
  faces_ = boxes;
  height_ = 0;
  for (std::span<const Box> below = boxes; below.size() > 1; below = levels_[height_++]) {
    if (height_ == levels_.size()) levels_.emplace_back();
    std::vector<Box>& groups = levels_[height_];
    groups.assign((below.size() + kGroup - 1) / kGroup, {});
    for (size_t i = 0; i < below.size(); ++i)
      groups[i / kGroup] = unite(groups[i / kGroup], below[i]);
  }
}

uint32_t FaceBoxes::last_below(Node node) const {
  const size_t count = node.level == 1 ? faces_.size() : levels_[node.level - 2].size();
  return uint32_t(std::min(count, (node.index + 1) * kGroup));
}

void FaceBoxes::neighbours(uint32_t face, std::vector<uint32_t>& found) {
  found.clear();
  const Box& its_box = faces_[face];
  stack_.assign(1, root());
  while (!stack_.empty()) {
    const Node node = stack_.back();
    stack_.pop_back();
    if (node.level == 0) {
      if (node.index != face) found.push_back(node.index);
      continue;
    }
    for (uint32_t i = first_below(node); i < last_below(node); ++i)
      if (const Node below{node.level - 1, i}; meet(box(below), its_box)) stack_.push_back(below);
  }
}

}  // namespace whittle
