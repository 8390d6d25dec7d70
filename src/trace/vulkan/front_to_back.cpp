#include "trace/vulkan/front_to_back.h"

namespace whittle {

void order_front_to_back(const FlatCells& flat, const Box& region, const Sight& sight,
                         std::vector<VisibleCell>& cells, std::vector<OpenCellInSight>& open) {
  cells.clear();
  open.clear();
  struct Item {
    uint32_t what;
    Box box;
    TreePlace place;
  };
  std::vector<Item> items;
  if (flat.root != kNoChild) items.push_back({flat.root, region, {}});
  while (!items.empty()) {
    const Item now = items.back();
    items.pop_back();
    const BoxSight seen = sight.look(now.box);
    if (seen == BoxSight::kNone) continue;
    if (is_cell(now.what)) {
      const uint32_t cell = now.what & ~kCellBit;
      cells.push_back({cell, flat.cases[cell], seen == BoxSight::kWide});
      continue;
    }
    if (now.what == kOpenPlace) {
      open.push_back({now.box, now.place, cells.size()});
      continue;
    }
    const FlatNode& node = flat.nodes[now.what];
    // What is pushed last comes first.
    const uint32_t first = sight.starts_above(node.axis, node.split) ? 1 : 0;
    for (const uint32_t side : {1 - first, first}) {
      if (node.child[side] == kNoChild) continue;
      Box box = now.box;
      (side == 0 ? box.hi : box.lo)[node.axis] = node.split;
      items.push_back({node.child[side], box, {now.what, side}});
    }
  }
}

}  // namespace whittle
