// The order of the cells is the order in which rays meet them, and no cell that a ray needs is
// missing.
#include "trace/vulkan/front_to_back.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>

#include "lower/lower.h"
#include "subdivide/subdivide.h"
#include "subdivide/threshold.h"
#include "support/agreement.h"
#include "support/random_tree.h"
#include "support/read_text.h"
#include "trace/pixel_threshold.h"
#include "trace/vulkan/cell_stream.h"
#include "trace/vulkan/view_data.h"

namespace whittle {
namespace {

/// The boxes of all cells, by number, found by walking the flat tree.
std::map<uint32_t, Box> boxes_of(const FlatCells& flat, const Box& region) {
  std::map<uint32_t, Box> boxes;
  struct Open {
    uint32_t at;
    Box box;
  };
  std::vector<Open> open{{flat.root, region}};
  while (!open.empty()) {
    const Open now = open.back();
    open.pop_back();
    if (now.at == kNoChild || now.at == kOpenPlace) continue;
    if (is_cell(now.at)) {
      boxes[now.at & ~kCellBit] = now.box;
      continue;
    }
    const FlatNode& node = flat.nodes[now.at];
    for (int side = 0; side < 2; ++side) {
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

/// Rays through some pixels of a picture meet all these cells, in this order; returns how many were
/// met. `wanted`: through which pixels.
template <class Wanted>
int expect_order(const Scene& scene, const std::map<uint32_t, Box>& boxes, const Camera& camera,
                 const std::vector<VisibleCell>& visible, const Wanted& wanted) {
  std::map<uint32_t, size_t> rank;
  for (size_t i = 0; i < visible.size(); ++i) rank[visible[i].cell] = i;
  EXPECT_EQ(rank.size(), visible.size()) << "no cell twice";
  int met = 0;
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) {
      if (!wanted(x, y)) continue;
      const Ray ray = camera.ray(x + 0.5, y + 0.5);
      const Vec3 origin = ray.origin - scene.origin;
      std::vector<std::pair<size_t, double>> order;  // rank, t
      for (const auto& [cell, box] : boxes) {
        const auto [t0, t1] = way(ray, origin, box);
        if (!(t1 > t0 + 1e-9)) continue;
        EXPECT_TRUE(rank.contains(cell)) << "a cell that the ray meets is missing";
        order.push_back({rank[cell], t0});
        ++met;
      }
      std::sort(order.begin(), order.end());
      for (size_t i = 1; i < order.size(); ++i)
        EXPECT_LE(order[i - 1].second, order[i].second + 1e-9);
    }
  return met;
}

struct RandomModel {
  Model model;
  Scene scene;
  SubdivideSettings settings;

  explicit RandomModel(uint64_t seed) : model(model_of(random_tree(seed, {.primitives = 12}))) {
    scene = *lower(model);
    settings.leaf_size = 3;
  }
  Sight sight(const Camera& camera) const {
    return {camera, local_eye(scene, camera), scene.origin, {0, 0, camera.width, camera.height}, 0};
  }
  /// The boxes of all leaves, as the tree has them.
  std::vector<Box> leaves() const {
    std::vector<Box> boxes;
    const CellTree tree = subdivide(scene, settings);
    for_each_leaf(tree, [&](CellLink link, const Box& box) {
      if (is_leaf(link.kind())) boxes.push_back(box);
    });
    return boxes;
  }
};

constexpr auto kEveryPixel = [](int, int) { return true; };

TEST(FrontToBack, IsTheOrderOfEveryRayAndMissesNoCell) {
  int met = 0;
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const RandomModel subject(seed);
    const CellTree tree = subdivide(subject.scene, subject.settings);
    CellSupply supply(subject.scene, tree, true, 1);
    EXPECT_FALSE(supply.is_open());
    const CellBatch all = *supply.at_once(nullptr);
    const std::map<uint32_t, Box> boxes = boxes_of(supply.flat(), supply.region());
    EXPECT_EQ(boxes.size(), all.cells.size() / shader::kCellWords);
    EXPECT_EQ(boxes.size(), statistics_of(tree).leaf_count());
    for (const Camera& camera : cameras_for(subject.model, 12, 9)) {
      std::vector<VisibleCell> visible;
      std::vector<OpenCellInSight> open;
      order_front_to_back(supply.flat(), supply.region(), subject.sight(camera), visible, open);
      EXPECT_TRUE(open.empty());
      met += expect_order(subject.scene, boxes, camera, visible, kEveryPixel);
    }
  }
  EXPECT_GT(met, 10000);
}

bool same_cell(const VisibleCell& a, const VisibleCell& b) {
  return a.cell == b.cell && a.leaf_case == b.leaf_case && a.is_wide == b.is_wide;
}

/// To order the cells once more gives the same, and no open cell.
void expect_nothing_is_left(const CellSupply& supply, const Sight& sight,
                            const std::vector<VisibleCell>& visible) {
  std::vector<VisibleCell> again;
  std::vector<OpenCellInSight> open;
  order_front_to_back(supply.flat(), supply.region(), sight, again, open);
  EXPECT_TRUE(open.empty());
  EXPECT_TRUE(std::ranges::equal(visible, again, same_cell));
}

/// What a stream gives, all batches in a row; all pixels left of `solved_to` are said to be solved.
std::vector<VisibleCell> stream_of(CellSupply& supply, const Sight& sight, const Camera& camera,
                                   int solved_to, int& batches) {
  std::vector<uint32_t> seen;
  for (int i = 0; i < camera.width * camera.height; ++i)
    seen.push_back(i % camera.width < solved_to ? 1 : 0);
  const auto solved = std::make_shared<const SolvedPixels>(seen, camera.width, camera.height);
  std::vector<VisibleCell> visible;
  const auto take = [&](const CellBatch& batch) {
    visible.insert(visible.end(), batch.visible.begin(), batch.visible.end());
    ++batches;
    return true;
  };
  EXPECT_TRUE(supply.stream(
      sight, 0, [&] { return solved; }, take));
  return visible;
}

TEST(FrontToBack, AStreamHasTheSameOrderAndWhatIsSeenLaterIsStillThere) {
  int met = 0, batches = 0;
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    const RandomModel subject(seed);
    const std::vector<Box> leaves = subject.leaves();
    const std::vector<Camera> cameras = cameras_for(subject.model, 24, 16);
    for (const Camera& camera : cameras) {
      const Sight sight = subject.sight(camera);
      const CellTree tree = open_cells(subject.scene, subject.settings);
      CellSupply supply(subject.scene, tree, true, 2);
      if (!supply.is_open()) continue;
      constexpr int kSolved = 8;
      const std::vector<VisibleCell> visible = stream_of(supply, sight, camera, kSolved, batches);
      EXPECT_FALSE(supply.is_open());
      const std::map<uint32_t, Box> boxes = boxes_of(supply.flat(), supply.region());
      EXPECT_EQ(boxes.size(), supply.cell_count());
      // Of all leaves that there are: unsolved pixels see what is in the stream and nothing else.
      std::map<uint32_t, Box> all = boxes;
      for (const Box& leaf : leaves) {
        if (std::ranges::none_of(boxes, [&](const auto& b) { return b.second == leaf; }))
          all[uint32_t(supply.cell_count() + all.size())] = leaf;
      }
      EXPECT_EQ(all.size(), leaves.size());
      met += expect_order(subject.scene, all, camera, visible,
                          [](int x, int) { return x >= kSolved; });
      // Then pictures from elsewhere refine what they need first.
      for (const Camera& other : cameras) {
        std::vector<VisibleCell> seen;
        std::vector<OpenCellInSight> open;
        const Sight from(subject.sight(other));
        order_front_to_back(supply.flat(), supply.region(), from, seen, open);
        ASSERT_TRUE(supply.refined(open, from, seen));
        expect_nothing_is_left(supply, from, seen);
        std::map<uint32_t, Box> now = boxes_of(supply.flat(), supply.region());
        for (const Box& leaf : leaves) {
          if (std::ranges::none_of(now, [&](const auto& b) { return b.second == leaf; }))
            now[uint32_t(supply.cell_count() + now.size())] = leaf;
        }
        met += expect_order(subject.scene, now, other, seen, kEveryPixel);
      }
    }
  }
  EXPECT_GT(met, 10000);
  EXPECT_GT(batches, 50) << "there are many batches";
}

TEST(FrontToBack, AStreamFromItsOwnThreadIsTheSame) {
  const RandomModel subject(3);
  const Camera camera = cameras_for(subject.model, 24, 16)[0];
  const Sight sight = subject.sight(camera);
  const auto whole = [&] {
    const CellTree tree = open_cells(subject.scene, subject.settings);
    CellSupply supply(subject.scene, tree, true, 2);
    int batches = 0;
    return stream_of(supply, sight, camera, 0, batches);
  }();
  ASSERT_GT(whole.size(), 50u);
  const CellTree tree = open_cells(subject.scene, subject.settings);
  CellSupply supply(subject.scene, tree, true, 2);
  std::vector<VisibleCell> visible;
  {
    CellStream stream(supply, sight, 0);
    const std::vector<uint32_t> nothing(24 * 16, 0);
    for (bool is_last = false; !is_last;) {
      const Result<CellBatch> batch = stream.next();
      ASSERT_TRUE(batch);
      visible.insert(visible.end(), batch->visible.begin(), batch->visible.end());
      stream.hide(std::make_shared<const SolvedPixels>(nothing, 24, 16));
      is_last = batch->is_last;
    }
  }
  EXPECT_TRUE(std::ranges::equal(visible, whole, same_cell));

  // Nobody need wait for its end.
  const CellTree other = open_cells(subject.scene, subject.settings);
  CellSupply abandoned(subject.scene, other, true, 2);
  CellStream stream(abandoned, sight, 0);
  EXPECT_TRUE(stream.next());
}

/// The boxes of what the supply gives for a picture, front to back, after it has refined what that
/// needs.
std::vector<Box> seen_by(CellSupply& supply, const Sight& sight) {
  std::vector<VisibleCell> visible;
  std::vector<OpenCellInSight> open;
  supply.follow();
  order_front_to_back(supply.flat(), supply.region(), sight, visible, open);
  EXPECT_TRUE(supply.refined(open, sight, visible));
  expect_nothing_is_left(supply, sight, visible);
  const std::map<uint32_t, Box> all = boxes_of(supply.flat(), supply.region());
  std::vector<Box> boxes;
  for (const VisibleCell& cell : visible) boxes.push_back(all.at(cell.cell));
  return boxes;
}

TEST(FrontToBack, AMovedThresholdLeavesTheCellsOfAFreshSupplyAndNoneGoesTwice) {
  const Workers workers(2);
  size_t changes = 0;
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    RandomModel subject(seed);
    subject.settings.leaf_size = 1;
    subject.settings.ignore_small = seed % 3 != 0;
    std::vector<Camera> cameras = cameras_for(subject.model, 24, 16);
    Camera far = cameras[0];
    far.eye = far.eye - far.forward * 1e6;
    cameras.insert(seed % 2 == 0 ? cameras.begin() : cameras.end(), far);
    subject.settings.is_small = PixelThreshold(cameras[0], 1);
    const CellTree tree = open_cells(subject.scene, subject.settings);
    CellSupply supply(subject.scene, tree, true, 2);
    std::vector<Box> before;
    uint32_t sent = 0;
    for (int round = 0; round < 3; ++round) {
      for (const Camera& camera : cameras) {
        // Moves between pictures change nothing.
        for (size_t i = 0; i < (seed + size_t(round)) % 3; ++i)
          move_threshold(tree, PixelThreshold(cameras[i], 1), workers);
        move_threshold(tree, PixelThreshold(camera, 1), workers);
        const std::vector<Box> seen = seen_by(supply, subject.sight(camera));
        subject.settings.is_small = PixelThreshold(camera, 1);
        const CellTree fresh = open_cells(subject.scene, subject.settings);
        CellSupply other(subject.scene, fresh, true, 2);
        EXPECT_EQ(seen, seen_by(other, subject.sight(camera)));
        changes += seen != before;
        before = seen;
      }
      if (round == 0) sent = supply.cell_count();
      EXPECT_EQ(supply.cell_count(), sent) << "all that comes back has gone already";
    }
  }
  EXPECT_GT(changes, 50u);
}

}  // namespace
}  // namespace whittle
