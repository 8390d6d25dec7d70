// The order of the cells is the order in which rays meet them, and no cell that a ray needs is
// missing.
#include "trace/vulkan/front_to_back.h"

#include <gtest/gtest.h>

#include <map>

#include "lower/lower.h"
#include "subdivide/subdivide.h"
#include "support/agreement.h"
#include "support/random_tree.h"
#include "support/read_text.h"
#include "trace/vulkan/view_data.h"

namespace whittle {
namespace {

/// The boxes of all cells, by number, found by walking the flat tree.
std::map<uint32_t, Box> boxes_of(const FlatCells& flat) {
  std::map<uint32_t, Box> boxes;
  struct Open {
    uint32_t at;
    Box box;
  };
  std::vector<Open> open;
  if (flat.root != kNoChild) open.push_back({flat.root, flat.region});
  while (!open.empty()) {
    const Open now = open.back();
    open.pop_back();
    if (now.at & kCellBit) {
      boxes[now.at & ~kCellBit] = now.box;
      continue;
    }
    const FlatNode& node = flat.nodes[now.at];
    for (int side = 0; side < 2; ++side) {
      if (node.child[side] == kNoChild) continue;
      Box box = now.box;
      (side == 0 ? box.hi : box.lo)[node.axis] = node.split;
      open.push_back({node.child[side], box});
    }
  }
  return boxes;
}

/// The ray's way through a box; empty if first > second.
std::pair<double, double> way(const Ray& ray, Vec3 origin, const Box& box) {
  double t0 = ray.t_min, t1 = kInfinity;
  for (int axis = 0; axis < 3; ++axis) {
    const double inverse = 1 / ray.direction[axis];
    const double a = (box.lo[axis] - origin[axis]) * inverse,
                 b = (box.hi[axis] - origin[axis]) * inverse;
    t0 = std::max(t0, std::min(a, b));
    t1 = std::min(t1, std::max(a, b));
  }
  return {t0, t1};
}

TEST(FrontToBack, IsTheOrderOfEveryRayAndMissesNoCell) {
  int met = 0;
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const Model model = model_of(random_tree(seed, {.primitives = 12}));
    const Scene scene = *lower(model);
    SubdivideSettings small_leaves;
    small_leaves.leaf_size = 3;
    const CellTree tree = subdivide(scene, small_leaves);
    const FlatCells flat = *flatten(scene, tree, true);
    const std::map<uint32_t, Box> boxes = boxes_of(flat);
    EXPECT_EQ(boxes.size(), flat.cell_count());
    EXPECT_EQ(boxes.size(), statistics_of(tree).leaf_count());
    for (const Camera& camera : cameras_for(model, 12, 9)) {
      const Vec3 eye = local_eye(scene, camera);
      std::vector<VisibleCell> visible;
      order_front_to_back(flat, camera, eye, {0, 0, camera.width, camera.height}, 0, visible);
      std::map<uint32_t, size_t> rank;
      for (size_t i = 0; i < visible.size(); ++i) rank[visible[i].cell] = i;
      EXPECT_EQ(rank.size(), visible.size()) << "no cell twice";
      for (int y = 0; y < camera.height; ++y)
        for (int x = 0; x < camera.width; ++x) {
          const Ray ray = camera.ray(x + 0.5, y + 0.5);
          const Vec3 origin = ray.origin - scene.origin;
          std::vector<std::pair<size_t, double>> order;  // rank, t
          for (const auto& [cell, box] : boxes) {
            const auto [t0, t1] = way(ray, origin, box);
            if (!(t1 > t0 + 1e-9)) continue;
            ASSERT_TRUE(rank.contains(cell)) << "a cell that the ray meets is missing";
            order.push_back({rank[cell], t0});
            ++met;
          }
          std::sort(order.begin(), order.end());
          for (size_t i = 1; i < order.size(); ++i)
            EXPECT_LE(order[i - 1].second, order[i].second + 1e-9);
        }
    }
  }
  EXPECT_GT(met, 10000);
}

}  // namespace
}  // namespace whittle
