#include "subdivide/subdivide.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "lower/evaluate.h"
#include "lower/lower.h"
#include "subdivide/leaf.h"
#include "subdivide/points_for_test.h"
#include "subdivide/refine.h"
#include "subdivide/same_cells_for_test.h"
#include "support/random_tree.h"
#include "support/read_text.h"

namespace whittle {
namespace {

Scene lowered(const std::string& text) {
  return *lower(model_of(text));
}

/// True if the point is so near to a surface that two roundings of it may differ.
bool near_a_surface(const Scene& scene, Vec3 p) {
  for (const HalfSpace& h : scene.half_spaces)
    if (std::fabs(Kernels<double>::quadric_value(h.f, p - h.center)) < 1e-9 * (1 + length(p)))
      return true;
  return false;
}

/// The solid at a point, by the leaf's own representation.
bool leaf_value(const Scene& scene, CellLink cell, Vec3 p) {
  if (cell.kind() == CellKind::kEmpty || cell.kind() == CellKind::kFull)
    return cell.kind() == CellKind::kFull;
  const Leaf& leaf = cell.leaf();
  uint64_t state = 0;
  size_t true_literals = 0;
  std::vector<bool> inside;
  for (const LeafLiteral& literal : leaf.literals()) {
    inside.push_back(contains(scene.half_spaces[literal.literal >> 1], p));
    if (inside.size() <= 64) state |= uint64_t(inside.back()) << (inside.size() - 1);
    true_literals += contains(scene, literal.literal, p);
  }
  switch (cell.kind()) {
    case CellKind::kConjunction:
      return true_literals == leaf.literal_count;
    case CellKind::kDisjunction:
      return true_literals > 0;
    case CellKind::kTable:
      return leaf.table >> state & 1;
    default: {
      uint32_t at = 0;
      while (at < kAnswerFalse) {
        const Step& step = leaf.steps()[at];
        at = inside[step.literal >> 1] != (step.literal & 1) ? step.on_true : step.on_false;
      }
      return at == kAnswerTrue;
    }
  }
}

/// Where a cell's leaf must be right.
Box grown(const Box& box, const CellTree& tree) {
  const Vec3 margin{tree.margin, tree.margin, tree.margin};
  return {box.lo - margin, box.hi + margin};
}

uint64_t cell_count(const CellTree& tree) {
  return statistics_of(tree).cell_count();
}

TEST(Leaf, TablesAreSimplifiedCompletely) {
  // (a and b) or (a and not b) is a; a and not a is nothing.
  const Scene same = lowered(
      "union(){ intersection(){ sphere(5); translate([3,0,0]) sphere(5); }"
      " difference(){ sphere(5); translate([3,0,0]) sphere(5); } }");
  LeafAnalysis leaf(same);
  leaf.analyse(same.formula);
  ASSERT_EQ(leaf.size(), 1u);
  Arena arena;
  const CellLink cell = leaf.write(arena);
  EXPECT_EQ(cell.kind(), CellKind::kConjunction);
  EXPECT_EQ(cell.leaf().literals()[0].literal, 0u);

  const Scene nothing = lowered("difference(){ sphere(5); sphere(5); }");
  LeafAnalysis constant(nothing);
  constant.analyse(nothing.formula);
  EXPECT_EQ(constant.size(), 0u);
  EXPECT_FALSE(constant.constant_value());
}

TEST(Leaf, SharedFacesHaveNoOwnerOfTheirOwn) {
  const Scene scene = lowered("sphere(5); sphere(5);");
  LeafAnalysis leaf(scene);
  leaf.analyse(scene.formula);
  Arena arena;
  const Leaf& written = leaf.write(arena).leaf();
  ASSERT_EQ(written.literal_count, 1u);
  EXPECT_EQ(written.literals()[0].owner, kSharedOwner);
  EXPECT_EQ(written.token_count, 3u);
}

struct Rules {
  std::string name;
  SubdivideSettings settings;
};

std::vector<Rules> all_rules() {
  std::vector<Rules> rules;
  for (const uint32_t k : {kAutoLeafSize, 1u, 2u, 4u, 6u, 8u, 16u}) {
    SubdivideSettings settings;
    settings.leaf_size = k;
    rules.push_back({"k=" + std::to_string(k), settings});
  }
  SubdivideSettings paper;
  paper.leaf_size = 2, paper.split = SplitRule::kXyz, paper.leaf = LeafRule::kPrimitives;
  rules.push_back({"paper", paper});
  SubdivideSettings coarse;
  coarse.leaf_size = 2, coarse.smallest_edge = 0.1;
  rules.push_back({"coarse", coarse});
  SubdivideSettings poor;
  poor.leaf_size = 2, poor.memory = 20'000;
  rules.push_back({"20 kB", poor});
  SubdivideSettings octree;
  octree.split = SplitRule::kOctree;
  rules.push_back({"octree", octree});
  octree.memory = 20'000;
  rules.push_back({"octree, 20 kB", octree});
  SubdivideSettings cost;
  cost.split = SplitRule::kCost;
  rules.push_back({"by cost", cost});
  SubdivideSettings overlapping;
  overlapping.margin = 1.0 / 64;
  rules.push_back({"overlapping", overlapping});
  return rules;
}

TEST(Subdivide, EveryLeafIsRightInItsCell) {
  Points points(7);
  std::array<uint64_t, kCellKinds> kinds{};
  for (uint64_t seed = 0; seed < 40; ++seed) {
    const Scene scene = lowered(random_tree(seed, {.primitives = 20, .coincident = seed % 2 == 0}));
    if (scene.region.is_empty()) continue;
    for (const Rules& rules : all_rules()) {
      const CellTree tree = subdivide(scene, rules.settings);
      const SubdivideStats stats = statistics_of(tree);
      for (size_t i = 0; i < kinds.size(); ++i) kinds[i] += stats.cells[i];
      uint32_t number = 0;
      for_each_leaf(tree, [&](CellLink cell, const Box& box) {
        if (++number % 7 != 0) return;
        const Vec3 p = points.in(grown(box, tree));
        if (near_a_surface(scene, p)) return;
        ASSERT_EQ(leaf_value(scene, cell, p), contains(scene, scene.formula, p))
            << rules.name << " seed " << seed << " kind " << int(cell.kind());
      });
    }
  }
  for (const CellKind kind :
       {CellKind::kNode, CellKind::kEmpty, CellKind::kFull, CellKind::kConjunction,
        CellKind::kDisjunction, CellKind::kTable, CellKind::kProgram})
    EXPECT_GT(kinds[size_t(kind)], 0u) << int(kind);
  EXPECT_EQ(kinds[size_t(CellKind::kIgnored)], 0u);
}

bool same(const CellTree& a, const CellTree& b) {
  return cell_count(a) == cell_count(b) && same_where_known(a, b);
}

TEST(Subdivide, KeepsToItsMemoryWhateverTheThreads) {
  const Scene scene = lowered(random_tree(3, {.primitives = 300}));
  const size_t free = statistics_of(subdivide(scene, {})).memory_bytes;
  uint64_t cells = 0;
  for (const size_t memory : {0u, 200'000u, 400'000u, 800'000u}) {
    SubdivideSettings settings;
    settings.memory = memory;
    settings.threads = 1;
    const CellTree one = subdivide(scene, settings);
    const SubdivideStats stats = statistics_of(one);
    if (memory > 0) {
      EXPECT_LE(stats.memory_bytes, memory);
    }
    EXPECT_LT(stats.memory_bytes, free);
    EXPECT_GT(stats.cell_count(), cells) << "more memory, more cells";
    cells = stats.cell_count();
    settings.threads = 7;
    EXPECT_TRUE(same(one, subdivide(scene, settings))) << memory;
  }
}

TEST(Subdivide, KeepsToItsMemoryWhereNothingGetsSimpler) {
  // Cylinders that all cross at one point.
  std::string text;
  for (int i = 0; i < 400; ++i) {
    text += "rotate([" + std::to_string(i * 7.1) + "," + std::to_string(i * 31.3) +
            ",0])cylinder(h=10,r=1,center=true);";
  }
  const Scene scene = lowered(text);
  for (const size_t memory : {300'000u, 3'000'000u}) {
    SubdivideSettings settings;
    settings.memory = memory;
    EXPECT_LE(statistics_of(subdivide(scene, settings)).memory_bytes, memory);
  }
}

TEST(Subdivide, LazilyFromManyThreadsTheCellsAreThoseOfAllAtOnce) {
  for (uint64_t seed = 0; seed < 8; ++seed) {
    const Scene scene = lowered(random_tree(seed, {.primitives = 60}));
    SubdivideSettings settings;
    settings.memory = seed % 2 == 0 ? settings.memory : 60'000;
    const CellTree eager = subdivide(scene, settings);
    const CellTree lazy = open_cells(scene, settings);
    // Each thread goes its own way through the same cells, and half of them do not see all.
    const auto walk = [&](uint64_t thread) {
      std::mt19937_64 random(thread);
      RefinerLease refiner(lazy);
      std::vector<const Cell*> stack{lazy.root};
      while (!stack.empty()) {
        const CellLink link = refiner->refined(*stack.back());
        stack.pop_back();
        EXPECT_NE(link.kind(), CellKind::kOpen);
        if (link.kind() != CellKind::kNode) continue;
        const size_t first = random() % 2;
        for (const size_t side : {1 - first, first})
          if (thread % 2 == 0 || random() % 16 != 0) stack.push_back(link.children() + side);
      }
    };
    {
      std::vector<std::jthread> threads;
      for (uint64_t i = 0; i < 4; ++i) threads.emplace_back(walk, 4 * seed + i + 1);
    }
    EXPECT_TRUE(same(eager, lazy)) << seed;
    EXPECT_EQ(statistics_of(lazy).cells[size_t(CellKind::kOpen)], 0u);
  }
}

TEST(Subdivide, NothingIsRefinedThatNobodyLooksAt) {
  const Scene scene = lowered(random_tree(3, {.primitives = 300}));
  const CellTree eager = subdivide(scene, {});
  const CellTree lazy = open_cells(scene, {});
  EXPECT_EQ(cell_count(lazy), 1u);
  RefinerLease refiner(lazy);
  // One way down.
  const Cell* cell = lazy.root;
  size_t splits = 0;
  for (CellLink link; (link = refiner->refined(*cell)).kind() == CellKind::kNode; ++splits)
    cell = link.children();
  EXPECT_EQ(cell_count(lazy), 2 * splits + 1);
  size_t compared = 0;
  EXPECT_TRUE(same_where_known(eager, lazy, &compared));
  EXPECT_GT(compared, splits);
}

TEST(Subdivide, CellsThatAreSplitManyTimesAtOnceAreRight) {
  // Wide unions, differences and intersections; the last one of boxes that do not tell anything.
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto at_random = [&] {
    return "translate([" + std::to_string(100 * unit(random)) + "," +
           std::to_string(60 * unit(random)) + "," + std::to_string(30 * unit(random)) + "])";
  };
  std::string balls, groups, shells;
  for (int i = 0; i < 4200; ++i) {
    balls += at_random() + "sphere(" + std::to_string(0.5 + unit(random)) + ");";
    groups += at_random() + "difference(){cube(2);sphere(1);intersection(){cube(1);sphere(1.2);}}";
    if (i % 10 == 0)
      shells += "difference(){cube([100,60,30]);" + at_random() + "cylinder(r=0.5,h=3);}";
  }
  Points points(12);
  for (const std::string& text :
       {groups, "difference(){cube([100,60,30]);" + balls + "}",
        // Wide only after a split, and then with a minuend that does not fill the cell.
        "difference(){cube([30,60,30]);scale([0.45,1,1]){" + balls +
            "}} translate([70,30,15]) sphere(20);",
        "intersection(){" + shells + "union(){" + balls + "}" + shells + "}"}) {
    const Scene scene = lowered(text);
    SubdivideSettings one, four;
    one.threads = 1, four.threads = 4;
    one.rays = four.rays = 1e4;
    one.margin = four.margin = 1.0 / 256;
    const CellTree tree = subdivide(scene, one);
    EXPECT_TRUE(same(tree, subdivide(scene, four)));
    const CellTree lazy = open_cells(scene, one);
    RefinerLease(lazy)->refine_all(*lazy.root);
    EXPECT_TRUE(same(tree, lazy));
    uint32_t number = 0;
    size_t looked_at = 0;
    for_each_leaf(tree, [&](CellLink cell, const Box& box) {
      if (++number % 13 != 0) return;
      const Vec3 p = points.in(grown(box, tree));
      if (near_a_surface(scene, p)) return;
      ++looked_at;
      ASSERT_EQ(leaf_value(scene, cell, p), contains(scene, scene.formula, p));
    });
    EXPECT_GT(looked_at, 20u);
    // With little memory as well.
    one.memory = four.memory = 6'000'000;
    const CellTree poor = subdivide(scene, one);
    EXPECT_LE(statistics_of(poor).memory_bytes, one.memory);
    EXPECT_TRUE(same(poor, subdivide(scene, four)));
  }
}

TEST(Subdivide, CopiesOfOneBodyAreOneLeaf) {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += "cube(10);";
  const Scene scene = lowered(text);
  SubdivideSettings settings;
  settings.leaf_size = 6;
  EXPECT_EQ(cell_count(subdivide(scene, settings)), 1u);
}

TEST(Subdivide, ByCostAStackOfPlatesIsTakenApartFirst) {
  std::string plates;
  for (int i = 0; i < 20; ++i)
    plates += "translate([0,0," + std::to_string(2 * i) + "]) cube([100,100,1]);";
  const Scene scene = lowered("difference(){ union(){" + plates + "} cylinder(h=100, r=5); }");
  SubdivideSettings settings;
  settings.leaf_size = 2;
  const uint64_t longest = cell_count(subdivide(scene, settings));
  settings.split = SplitRule::kCost;
  EXPECT_LT(cell_count(subdivide(scene, settings)) * 10, longest);
}

TEST(Subdivide, AnOctreeCutsAlongAllAxesOrNone) {
  // A ball's surface is in all eight parts, and in most parts of these.
  const Scene scene = lowered("difference(){ sphere(10); sphere(9.9); }");
  SubdivideSettings settings;
  settings.split = SplitRule::kOctree;
  settings.leaf_size = 1;
  const CellTree tree = subdivide(scene, settings);
  struct Visit {
    const Cell* cell;
    uint32_t depth;
  };
  std::vector<Visit> stack{{tree.root, 0}};
  size_t splits = 0;
  while (!stack.empty()) {
    const auto [cell, depth] = stack.back();
    stack.pop_back();
    const CellLink link = cell->link();
    if (link.kind() != CellKind::kNode) {
      // Parts that are decided alike may have been joined again; what has a surface has not.
      if (is_leaf(link.kind())) {
        EXPECT_EQ(depth % 3, 0u);
      }
      continue;
    }
    ++splits;
    EXPECT_EQ(link.axis(), int(depth % 3));
    for (int side = 0; side < 2; ++side) stack.push_back({link.children() + side, depth + 1});
  }
  EXPECT_GT(splits, 100u);
}

TEST(Subdivide, LeavesHoldAtMostKWhereCellsMayShrink) {
  const Scene scene = lowered(
      "difference(){cylinder(r=10,h=20); translate([5,0,10]) sphere(4);"
      " translate([-5,0,10]) sphere(4); translate([0,5,10]) sphere(4);}");
  for (const uint32_t k : {3u, 4u, 6u}) {
    SubdivideSettings settings;
    settings.leaf_size = k;
    const CellTree tree = subdivide(scene, settings);
    const SubdivideStats stats = statistics_of(tree);
    EXPECT_GT(stats.leaf_count(), 0u);
    EXPECT_LE(stats.leaves_by_size.size(), k + 1);
  }
}

TEST(Subdivide, DoesNotDependOnTheNumberOfThreads) {
  for (uint64_t seed = 0; seed < 10; ++seed) {
    const Scene scene = lowered(random_tree(seed, {.primitives = 60}));
    SubdivideSettings one, four;
    one.threads = 1, four.threads = 4;
    EXPECT_TRUE(same(subdivide(scene, one), subdivide(scene, four))) << seed;
  }
}

TEST(Subdivide, MoreRaysAreWorthMoreCells) {
  const Scene scene = lowered(random_tree(3, {.primitives = 300}));
  uint64_t cells = 0;
  for (const double rays : {1e2, 1e4, 1e6, 1e8}) {
    SubdivideSettings settings;
    settings.rays = rays;
    const uint64_t now = cell_count(subdivide(scene, settings));
    EXPECT_GT(now, cells) << rays;
    cells = now;
  }
}

TEST(Subdivide, CoincidentFacesLeaveNothingBehind) {
  // A - A is empty everywhere, although no cell is proved empty by bounds.
  const Scene scene = lowered("difference(){cube(10); cube(10);}");
  const CellTree tree = subdivide(scene, {});
  EXPECT_EQ(statistics_of(tree).leaf_count(), 0u);
  EXPECT_EQ(statistics_of(tree).cells[size_t(CellKind::kFull)], 0u);
}

TEST(Subdivide, PaperRulesTakeUnionsOfAnyNumberAsLeaves) {
  SubdivideSettings paper;
  paper.leaf_size = 2, paper.split = SplitRule::kXyz, paper.leaf = LeafRule::kPrimitives;
  const Scene spheres = lowered(
      "sphere(5); translate([1,0,0]) sphere(5); translate([0,1,0]) sphere(5);"
      "translate([0,0,1]) cube(6);");
  EXPECT_EQ(cell_count(subdivide(spheres, paper)), 1u);
  const Scene cut = lowered(
      "difference(){sphere(5); translate([1,0,0]) sphere(5); translate([0,1,0]) sphere(5);}");
  EXPECT_GT(cell_count(subdivide(cut, paper)), 1u);
}

TEST(Subdivide, SmallCellsAreIgnoredOnlyIfAskedFor) {
  // Three spheres meet in points: no cell there is ever simple.
  const Scene scene = lowered(
      "difference(){sphere(5); translate([1,0,0]) sphere(5); translate([0,1,0]) sphere(5);}");
  SubdivideSettings settings;
  settings.leaf_size = 2;
  settings.is_small = [](const Box& box) { return max_component(box.size()) < 0.5; };
  const auto ignored = [&] {
    return statistics_of(subdivide(scene, settings)).cells[size_t(CellKind::kIgnored)];
  };
  EXPECT_EQ(ignored(), 0u);
  settings.ignore_small = true;
  EXPECT_GT(ignored(), 0u);
}

TEST(Subdivide, StatisticsCountWhatIsThere) {
  const Scene scene = lowered("difference(){cube(10); sphere(3);}");
  const CellTree tree = subdivide(scene, {});
  const SubdivideStats stats = statistics_of(tree);
  uint64_t outer = 0, leaves = 0;
  size_t bytes = 0;
  for_each_leaf(tree, [&](CellLink cell, const Box&) {
    ++outer;
    if (cell.kind() < CellKind::kConjunction) return;
    ++leaves;
    bytes += cell.leaf().bytes();
  });
  EXPECT_EQ(stats.cell_count(), 2 * outer - 1);
  EXPECT_EQ(stats.leaf_count(), leaves);
  EXPECT_EQ(stats.memory_bytes, bytes + stats.cell_count() * sizeof(Cell));
}

}  // namespace
}  // namespace whittle
