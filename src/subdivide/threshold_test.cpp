// A tree whose threshold moved is the tree that is made afresh.
#include "subdivide/threshold.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "lower/lower.h"
#include "subdivide/refine.h"
#include "subdivide/same_cells_for_test.h"
#include "support/random_tree.h"
#include "support/read_text.h"

namespace whittle {
namespace {

/// Small is what looks small from a point.
IsSmall small_from(Vec3 eye, double share) {
  return [=](const Box& box) {
    return max_component(box.size()) < share * length(box.center() - eye);
  };
}

/// Eyes on a way around the model that comes near and, once, goes very far.
std::vector<Vec3> way_around(int steps) {
  std::vector<Vec3> eyes;
  for (int i = 0; i < steps; ++i) {
    const double angle = 0.9 * i, distance = i == 5 ? 150 : 14 + 10 * std::sin(1.7 * i);
    eyes.push_back({distance * std::cos(angle), distance * std::sin(angle), 5 * std::sin(0.4 * i)});
  }
  return eyes;
}

struct ThresholdRules {
  std::string name;
  SubdivideSettings settings;
};

/// In all of them small cells are ignored and, in the next, kept.
std::vector<ThresholdRules> threshold_rules() {
  SubdivideSettings paper;
  paper.leaf_size = 2, paper.split = SplitRule::kXyz, paper.leaf = LeafRule::kPrimitives;
  std::vector<ThresholdRules> rules{{"paper", paper}};
  SubdivideSettings coarse = paper;
  coarse.smallest_edge = 0.02;
  rules.push_back({"coarse", coarse});
  SubdivideSettings poor = paper;
  poor.memory = 200'000;
  rules.push_back({"poor", poor});
  SubdivideSettings octree = paper;
  octree.split = SplitRule::kOctree;
  rules.push_back({"octree", octree});
  SubdivideSettings automatic;
  rules.push_back({"auto", automatic});
  for (size_t i = 0, count = rules.size(); i < count; ++i) {
    rules.push_back(rules[i]);
    rules.back().name += ", small cells kept";
    rules[i].settings.ignore_small = true;
  }
  return rules;
}

/// Refines some of what is open: the ways of a few rays, so to speak.
void refine_some(const CellTree& tree, uint64_t seed) {
  std::mt19937_64 random(seed);
  RefinerLease refiner(tree);
  std::vector<const Cell*> stack{tree.root};
  while (!stack.empty()) {
    const CellLink link = refiner->refined(*stack.back());
    stack.pop_back();
    if (link.kind() != CellKind::kNode) continue;
    for (size_t side = 0; side < 2; ++side)
      if (random() % 4 != 0) stack.push_back(link.children() + side);
  }
}

TEST(Threshold, AMovedOneGivesTheCellsOfAFreshOne) {
  const Workers workers(2);
  MovedThreshold sum;
  uint64_t anew = 0, steps = 0;
  for (uint64_t seed = 1; seed <= 2; ++seed) {
    const Scene scene =
        *lower(model_of(random_tree(seed, {.primitives = 20 + 100 * int(seed % 3)})));
    for (ThresholdRules rules : threshold_rules()) {
      SCOPED_TRACE(rules.name + ", seed " + std::to_string(seed));
      CellTree moving;
      uint64_t step = 0;
      for (const Vec3& eye : way_around(7)) {
        ++step;
        rules.settings.is_small = small_from(eye, 0.04);
        const CellTree fresh = subdivide(scene, rules.settings);
        if (moving.root == nullptr) {
          moving = open_cells(scene, rules.settings);
        } else {
          const MovedThreshold moved = move_threshold(moving, rules.settings.is_small, workers);
          sum.opened += moved.opened;
          sum.closed += moved.closed;
          anew += moved.is_crowded;
          ++steps;
          if (moved.is_crowded) moving = open_cells(scene, rules.settings);
        }
        size_t compared = 0;
        // Lazily, and not all of it; every other time all.
        refine_some(moving, 100 * seed + step);
        EXPECT_TRUE(same_where_known(moving, fresh));
        if (step % 2 == 0) continue;
        refine_all(moving, workers);
        EXPECT_TRUE(same_where_known(moving, fresh, &compared));
        uint64_t leaves = 0;
        for_each_leaf(fresh, [&](CellLink, const Box&) { ++leaves; });
        EXPECT_EQ(compared, 2 * leaves - 1);
      }
    }
  }
  EXPECT_GT(sum.opened, 1000u);
  EXPECT_GT(sum.closed, 1000u);
  EXPECT_LT(anew, steps / 4) << "most of the trees are kept";
}

uint64_t refined(const CellTree& tree) {
  return statistics_of(tree).refined;
}

/// A block of 20 units about the origin, less many balls that cut one another.
Scene many_balls() {
  std::mt19937_64 random(5);
  std::string text = "difference(){cube(20,center=true);";
  for (int i = 0; i < 150; ++i) {
    double number[4];
    for (double& n : number) n = double(random() % 1'000'000) * 1e-6;
    text += "translate([";
    for (int axis = 0; axis < 3; ++axis) text += std::to_string(20 * number[axis] - 10) + ",";
    text += "])sphere(" + std::to_string(1 + 2 * number[3]) + ");";
  }
  return *lower(model_of(text + "}"));
}

SubdivideSettings paper_rules(Vec3 eye, double share) {
  SubdivideSettings settings = threshold_rules()[0].settings;
  settings.is_small = small_from(eye, share);
  return settings;
}

TEST(Threshold, OnlyWhatCrossedItIsRefined) {
  const Scene scene = many_balls();
  const Workers workers(2);
  const Vec3 here{30, 5, 8};
  const CellTree tree = subdivide(scene, paper_rules(here, 0.01));
  const uint64_t all = refined(tree);
  uint64_t most = 0, sum = 0;
  for (int step = 1; step <= 20; ++step) {
    const double angle = 0.01 * step;
    const Vec3 eye{30 * std::cos(angle), 5 + 30 * std::sin(angle), 8};
    const uint64_t before = refined(tree);
    move_threshold(tree, small_from(eye, 0.01), workers);
    refine_all(tree, workers);
    most = std::max(most, refined(tree) - before);
    sum += refined(tree) - before;
  }
  EXPECT_GT(all, 20'000u);
  EXPECT_GT(sum, 0u);
  EXPECT_LT(most, all / 20);
}

TEST(Threshold, WhatComesBackIsStillThere) {
  const Scene scene = many_balls();
  const Workers workers(2);
  const Vec3 here{30, 5, 8}, there{40, -20, 8};
  const CellTree tree = subdivide(scene, paper_rules(here, 0.02));
  move_threshold(tree, small_from(there, 0.02), workers);
  refine_all(tree, workers);
  const SubdivideStats before = statistics_of(tree);
  for (const Vec3 eye : {here, there, here}) {
    const MovedThreshold moved = move_threshold(tree, small_from(eye, 0.02), workers);
    EXPECT_GT(moved.opened + moved.closed, 100u);
    refine_all(tree, workers);
    EXPECT_EQ(refined(tree), before.refined);
    EXPECT_EQ(statistics_of(tree).memory_bytes, before.memory_bytes);
    EXPECT_EQ(statistics_of(tree).cell_count(), before.cell_count());
  }
}

TEST(Threshold, SaysWhenItIsTimeForANewTree) {
  const Scene scene = many_balls();
  const Workers workers(2);
  const Vec3 near{1, 2, 3}, far{200, 0, 0};
  {
    SCOPED_TRACE("most cells are out of use");
    const CellTree tree = subdivide(scene, paper_rules(near, 0.02));
    EXPECT_FALSE(move_threshold(tree, small_from(near, 0.021), workers).is_crowded);
    EXPECT_TRUE(move_threshold(tree, small_from(far, 0.02), workers).is_crowded);
  }
  {
    SCOPED_TRACE("all together take too much");
    SubdivideSettings settings = paper_rules(near, 0.02);
    settings.memory = 1000;
    const CellTree tree = subdivide(scene, settings);
    EXPECT_TRUE(move_threshold(tree, small_from(near, 0.021), workers).is_crowded);
  }
}

TEST(Threshold, WhoHeedsThatHoldsLittleThatIsOutOfUse) {
  const Scene scene = many_balls();
  const Workers workers(2);
  CellTree tree = subdivide(scene, paper_rules({8, 0, 0}, 0.2));
  uint64_t anew = 0;
  constexpr uint64_t kSteps = 150;
  for (uint64_t i = 1; i <= kSteps; ++i) {
    const double angle = double(i), height = 0.1 * angle - 7;
    const SubdivideSettings settings =
        paper_rules({9 * std::cos(angle), 9 * std::sin(angle), height}, 0.2);
    const MovedThreshold moved = move_threshold(tree, settings.is_small, workers);
    if (moved.is_crowded) {
      tree = open_cells(scene, settings);
      ++anew;
    } else {
      EXPECT_LE(statistics_of(tree).cell_count(), 4 * moved.cells + 5000);
    }
    refine_all(tree, workers);
  }
  EXPECT_GT(anew, 0u);
  EXPECT_LT(anew, kSteps / 4);
}

TEST(Threshold, AfterAMoveManyThreadsMayRefineAtOnce) {
  const Scene scene = many_balls();
  const Workers workers(4);
  const CellTree tree = open_cells(scene, paper_rules({30, 5, 8}, 0.03));
  for (int step = 0; step < 4; ++step) {
    const SubdivideSettings settings = paper_rules({30.0 - 5 * step, 5, 8}, 0.03);
    move_threshold(tree, settings.is_small, workers);
    {
      std::vector<std::jthread> threads;
      for (uint64_t i = 0; i < 4; ++i)
        threads.emplace_back([&, i] { refine_some(tree, 10 * uint64_t(step) + i); });
    }
    EXPECT_TRUE(same_where_known(tree, subdivide(scene, settings)));
  }
}

}  // namespace
}  // namespace whittle
