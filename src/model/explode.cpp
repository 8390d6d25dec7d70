#include "model/explode.h"

#include <algorithm>
#include <vector>

#include "base/affine.h"
#include "model/instances.h"
#include "model/tree_boxes.h"

namespace whittle {
namespace {

bool joins(NodeKind kind) {
  return kind == NodeKind::kUnion || kind == NodeKind::kTransform || kind == NodeKind::kColor;
}

/// By node, where it can be; empty where nothing is.
std::vector<Box> boxes_of(const Model& model) {
  std::vector<Box> boxes(model.nodes.size());
  InstanceWalk walk(model);
  for_tree_boxes(
      model, [&](uint32_t) { return instance_box(model, *walk.next()); },
      [&](uint32_t node, const Box& box) { boxes[node] = box; });
  return boxes;
}

/// The operands of a node where something is.
std::vector<uint32_t> operands_of(const Model& model, const std::vector<Box>& boxes,
                                  uint32_t node) {
  std::vector<uint32_t> operands;
  for (uint32_t i = node + 1; i < model.nodes[node].end; i = model.nodes[i].end)
    if (!model.nodes[i].background && !boxes[i].is_empty()) operands.push_back(i);
  return operands;
}

}  // namespace

Result<Model> explode(const Model& model, double factor) {
  const auto refused = [&](const char* why) {
    return Error{ErrorKind::kInput, model.file + ": error: " + why + " (--explode)"};
  };
  const std::vector<Box> boxes = boxes_of(model);
  Affine world_from_inside;
  std::vector<uint32_t> parts;
  for (uint32_t node = 0;;) {
    if (!joins(model.nodes[node].kind)) return refused("is one part; nothing can be moved apart");
    if (model.nodes[node].kind == NodeKind::kTransform)
      world_from_inside = world_from_inside * model.transforms[model.nodes[node].payload];
    parts = operands_of(model, boxes, node);
    if (parts.empty()) return refused("is empty; nothing can be moved apart");
    if (parts.size() > 1) break;
    node = parts[0];
  }
  Box all;
  for (const uint32_t part : parts) {
    if (!boxes[part].is_finite()) return refused("has a part without end, which has no middle");
    all = unite(all, boxes[part]);
  }

  Model moved = model;
  moved.nodes.clear();
  // Each part gets a node of its own before it.
  const auto new_index = [&](uint32_t old) {
    return old + uint32_t(std::ranges::lower_bound(parts, old) - parts.begin());
  };
  const Affine inside_from_world = inverse(world_from_inside);
  size_t next = 0;
  for (uint32_t i = 0; i < model.nodes.size(); ++i) {
    Node node = model.nodes[i];
    node.end = new_index(node.end);
    if (next < parts.size() && parts[next] == i) {
      ++next;
      const Vec3 way = (boxes[i].center() - all.center()) * factor;
      Node mover;
      mover.kind = NodeKind::kTransform;
      mover.end = node.end;
      mover.payload = uint32_t(moved.transforms.size());
      mover.where = node.where;
      moved.nodes.push_back(mover);
      moved.transforms.push_back(translation(inside_from_world.vector(way)));
    }
    moved.nodes.push_back(node);
  }
  return moved;
}

}  // namespace whittle
