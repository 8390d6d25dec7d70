#include "trace/cpu/cpu.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <mutex>
#include <stop_token>
#include <string>

#include "base/degrees.h"
#include "lower/lower.h"
#include "subdivide/subdivide.h"
#include "support/agreement.h"
#include "support/instruction_sets.h"
#include "support/random_tree.h"
#include "support/read_text.h"

namespace whittle {
namespace {

/// A model ready to be traced with given rules.
struct Traced {
  explicit Traced(const std::string& text, const SubdivideSettings& settings = {}) {
    scene = *lower(model_of(text));
    cells = subdivide(scene, settings);
    tracer = make_cpu_tracer(scene, cells);
  }
  Traced(const Traced&) = delete;

  /// The hit of one ray.
  Hit hit(Vec3 from, Vec3 to) { return trace_one(*tracer, from, to - from); }

  Scene scene;
  CellTree cells;
  std::unique_ptr<CpuTracer> tracer;
};

void expect_hit(const Hit& hit, double distance, uint32_t id, Vec3 normal) {
  EXPECT_EQ(hit.id, id);
  EXPECT_NEAR(hit.distance, distance, 1e-5 * distance);
  EXPECT_NEAR(hit.normal.x, normal.x, 1e-6);
  EXPECT_NEAR(hit.normal.y, normal.y, 1e-6);
  EXPECT_NEAR(hit.normal.z, normal.z, 1e-6);
}

TEST(Cpu, ASphereIsHitWhereItIs) {
  Traced sphere("sphere(2);");
  expect_hit(sphere.hit({10, 0, 0}, {0, 0, 0}), 8, 1, {1, 0, 0});
  expect_hit(sphere.hit({10, 0, std::sqrt(3.0)}, {0, 0, std::sqrt(3.0)}), 9, 1,
             {0.5, 0, std::sqrt(0.75)});
  EXPECT_FALSE(sphere.hit({10, 0, 2.001}, {0, 0, 2.001}).hit());
  EXPECT_FALSE(sphere.hit({10, 0, 0}, {20, 0, 0}).hit());
}

TEST(Cpu, TheEyeMayBeAnywhere) {
  Traced model("difference(){cube(10, center = true); sphere(3);}");
  // Outside; in the subtracted sphere (which is empty space); in the material.
  expect_hit(model.hit({20, 1, 0}, {0, 1, 0}), 15, 1, {1, 0, 0});
  expect_hit(model.hit({0, 0, 0}, {1, 0, 0}), 3, 2, {-1, 0, 0});
  expect_hit(model.hit({4, 0, 0}, {5, 0, 0}), 1, 1, {1, 0, 0});
  expect_hit(model.hit({4, 0, 0}, {0, 0, 0}), 1, 2, {-1, 0, 0});
}

TEST(Cpu, APlaneThatOnlyHappensToPassThereOwnsNothing) {
  // The wedge's slope goes on beyond the wedge and meets the cube's top just where the ray does.
  const char* const text =
      "polyhedron(points = [[0,6,0],[3,6,0],[0,6,3],[0,8,0],[3,8,0],[0,8,3]],"
      " faces = [[0,2,1],[3,4,5],[0,1,4,3],[1,2,5,4],[2,0,3,5]]);"
      "translate([0,0,-1]) cube([4,4,2]);";
  SubdivideSettings all_in_one_leaf;
  all_in_one_leaf.leaf_size = 16;
  Traced model(text, all_in_one_leaf);
  for (const double y : {1.0, 2.0, 3.5})
    expect_hit(model.hit({2, y, 10}, {2, y, 0}), 9, 2, {0, 0, 1});
}

TEST(Cpu, WhereAWallTouchesAnotherTheEarlierOwns) {
  // A round bar inside a square one, turned by an odd angle, so that rounding differs along the
  // lines where they touch.
  const char* const turn = "rotate([30, 0, 17])";
  const std::string cube = "translate([0, -2, -2]) cube([40, 4, 4]);",
                    bar = "rotate([0, 90, 0]) cylinder(h = 40, r = 2);";
  const double c = cos_degrees(17), s = sin_degrees(17), cx = cos_degrees(30), sx = 0.5;
  const Affine map = {.row = {{c, -s * cx, s * sx}, {s, c * cx, -c * sx}, {0, sx, cx}},
                      .translation = {}};
  for (const bool bar_first : {false, true}) {
    Traced model(std::string(turn) + "{" + (bar_first ? bar + cube : cube + bar) + "}");
    for (int i = 1; i < 400; ++i) {
      const Vec3 on = map.point({i / 10.0, 0, 2});
      const Vec3 up = map.vector({0, 0, 1});
      EXPECT_EQ(model.hit(on + up * 8.0, on).id, 1u) << i;
    }
  }
}

TEST(Cpu, AnEyeOnASurfaceHasPassedIt) {
  Traced model("cube(10, center = true); translate([0, 0, 9]) sphere(2);");
  // On a face: away from the body there is nothing, into it there is its far side.
  for (int i = 0; i < 100; ++i) {
    const Vec3 aside = {0.31 + 0.7 * std::cos(i), 0.57 + 0.7 * std::sin(i), 1};
    EXPECT_FALSE(model.hit({5, 0, 1}, {6, aside.x, aside.y}).hit());
    EXPECT_FALSE(model.hit({5, 5, 5}, {6, 5 + aside.x, 5 + aside.y}).hit());
    EXPECT_GT(model.hit({5, 0, 1}, {4, aside.x, aside.y}).distance, 1);
  }
  expect_hit(model.hit({0, 0, 5}, {0, 0, 6}), 2, 2, {0, 0, -1});
  expect_hit(model.hit({0, 0, 11}, {0, 0, 0}), 4, 2, {0, 0, -1});
  EXPECT_FALSE(model.hit({0, 0, 11}, {0.1, 0.2, 12}).hit());
  // On the tip of a cone, where all slopes meet.
  Traced cone("cylinder(h = 4, r1 = 2, r2 = 0);");
  EXPECT_FALSE(cone.hit({0, 0, 4}, {1, 0.3, 3}).hit());
  EXPECT_FALSE(cone.hit({0, 0, 4}, {1, 0.3, 5}).hit());
  expect_hit(cone.hit({0, 0, 4}, {0, 0, 3}), 4, 1, {0, 0, -1});
  EXPECT_EQ(model.tracer->stats().disagreements + cone.tracer->stats().disagreements, 0u);
}

TEST(Cpu, SmallAndFlatBodiesAreExactInLargeModels) {
  // A millionth of the model wide, far from its middle.
  Traced ball("cube(1e4, center = true); translate([8000, 3000, 1000]) sphere(0.01);");
  const double half = 0.01 * std::sqrt(0.5);
  const Vec3 eye = {8000, 2999, 1000};
  const Hit hit = ball.hit(eye + Vec3{half, 0, 0}, Vec3{8000, 3000, 1000} + Vec3{half, 0, 0});
  EXPECT_EQ(hit.id, 2u);
  EXPECT_NEAR(hit.distance, 1 - half, 1e-7);
  EXPECT_NEAR(hit.normal.x, std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(hit.normal.y, -std::sqrt(0.5), 1e-6);
  // A disc, a millionth of its width thick, met aslant where its top leans by 1 in 800,000.
  Traced disc("scale([1, 1, 1e-6]) sphere(1);");
  const Hit top = disc.hit({0.6, -2, 1}, {0.6, 0, 0});
  EXPECT_NEAR(top.distance, std::sqrt(5.0), 5e-6);
  EXPECT_NEAR(top.normal.x, 0.75e-6, 1e-10);
}

TEST(Cpu, FlushPocketsHaveNoLid) {
  Traced model("difference(){cube(10); translate([2,2,5]) cube([6,6,5]);}");
  expect_hit(model.hit({5, 5, 20}, {5, 5, 0}), 15, 2, {0, 0, 1});
  expect_hit(model.hit({1, 1, 20}, {1, 1, 0}), 10, 1, {0, 0, 1});
}

TEST(Cpu, OfCoincidentFacesTheEarlierStatementOwns) {
  Traced both("translate([5,0,0]) cube(10); cube(10);");
  expect_hit(both.hit({7, 5, 20}, {7, 5, 0}), 10, 1, {0, 0, 1});
  expect_hit(both.hit({2, 5, 20}, {2, 5, 0}), 10, 2, {0, 0, 1});
  // The earlier statement's face is there, but its material is cut away below it: it is not seen.
  Traced cut("difference(){cube(10); translate([5,-1,-1]) cube(20);} cube(10);");
  expect_hit(cut.hit({7, 5, 20}, {7, 5, 0}), 10, 3, {0, 0, 1});
  expect_hit(cut.hit({2, 5, 20}, {2, 5, 0}), 10, 1, {0, 0, 1});
  // A cutter that lies on the material takes nothing, and owns nothing.
  Traced resting("difference(){cube(10); translate([0,0,10]) cube(10);}");
  expect_hit(resting.hit({5, 5, 30}, {5, 5, 0}), 20, 1, {0, 0, 1});
}

TEST(Cpu, FacesOnSplitsAreNotLost) {
  // The splits of a symmetric region fall on x = 0, and so does a face of each.
  SubdivideSettings fine;
  fine.leaf_size = 1;
  Traced model(
      "cube([10,10,10]); translate([-10,0,0]) sphere(1); translate([-10,5,5]) cube(4);"
      "translate([-10,-10,-10]) cube([10,10,10]);",
      fine);
  expect_hit(model.hit({-5, 5, 2}, {0, 5, 2}), 5, 1, {-1, 0, 0});
  expect_hit(model.hit({5, -5, -5}, {0, -5, -5}), 5, 4, {1, 0, 0});
  EXPECT_EQ(model.tracer->stats().disagreements, 0u);
}

TEST(Cpu, RaysAlongAxesFacesAndSplitsEnd) {
  Traced model("cube(10, center = true); translate([0,0,5]) sphere(3);");
  expect_hit(model.hit({0, 0, 20}, {0, 0, 0}), 12, 2, {0, 0, 1});
  expect_hit(model.hit({20, 0, 0}, {0, 0, 0}), 15, 1, {1, 0, 0});
  EXPECT_FALSE(model.hit({20, 5.001, 0}, {0, 5.001, 0}).hit());
}

TEST(Cpu, HalfspacesReachAsFarAsOneLooks) {
  Traced ground("halfspace(n = [0,0,1], d = 0); translate([0,0,5]) sphere(1);");
  expect_hit(ground.hit({0, 0, 20}, {0, 0, 0}), 14, 2, {0, 0, 1});
  expect_hit(ground.hit({100, 0, 20}, {100, 0, 0}), 20, 1, {0, 0, 1});
  // From below one looks out of the material, at the surface from inside.
  expect_hit(ground.hit({100, 0, -20}, {100, 0, 0}), 20, 1, {0, 0, 1});
}

TEST(Cpu, AnEmptyModelShowsNothing) {
  Traced nothing("difference(){group(); cube(10);}");
  EXPECT_FALSE(nothing.hit({20, 5, 5}, {0, 5, 5}).hit());
  Traced cancelled("difference(){cube(10); cube(10);}");
  EXPECT_FALSE(cancelled.hit({20, 5, 5}, {0, 5, 5}).hit());
}

TEST(Cpu, IgnoredCellsAreHoles) {
  SubdivideSettings settings;
  settings.leaf_size = 1;
  settings.ignore_small = true;
  settings.is_small = [](const Box&) { return true; };
  Traced model("difference(){sphere(5); translate([1,0,0]) sphere(5);}", settings);
  EXPECT_FALSE(model.hit({-20, 0, 0}, {0, 0, 0}).hit());
}

TEST(Cpu, EveryInstructionSetGivesTheSameBytes) {
  for (const uint64_t seed : {3, 5, 8}) {
    const Model model = model_of(random_tree(seed, {.primitives = 30}));
    const Scene scene = *lower(model);
    const CellTree cells = subdivide(scene, {});
    const auto tracer = make_cpu_tracer(scene, cells);
    for (const Camera& camera : cameras_for(model, 75, 53)) {
      std::vector<Frame> frames;
      for_every_instruction_set([&] { frames.push_back(tracer->render(camera, {})); });
      ASSERT_GE(frames.size(), 1u);
      for (const Frame& frame : frames)
        EXPECT_EQ(
            std::memcmp(frame.hits.data(), frames[0].hits.data(), frame.hits.size() * sizeof(Hit)),
            0);
    }
  }
}

TEST(Cpu, ProbesAndPicturesSeeTheSame) {
  Traced model("difference(){cube(10, center = true); sphere(6.5);} cylinder(r=1,h=20);");
  Camera camera = camera_along({20, 30, 25}, {-20, -30, -25});
  camera.width = 61, camera.height = 43;
  camera.half_height = 0.3;
  const Frame frame = model.tracer->render(camera, {});
  std::vector<PixelPosition> positions;
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) positions.push_back({float(x) + 0.5f, float(y) + 0.5f});
  std::vector<Hit> hits(positions.size());
  model.tracer->probe(camera, positions, hits);
  EXPECT_EQ(std::memcmp(frame.hits.data(), hits.data(), hits.size() * sizeof(Hit)), 0);
  EXPECT_TRUE(frame.at(30, 21).hit());
}

TEST(Cpu, RaysOfACameraThatAreCastSeeWhatItSees) {
  const Model model = model_of(random_tree(4, {.primitives = 30}));
  const Scene scene = *lower(model);
  const CellTree cells = subdivide(scene, {});
  const auto tracer = make_cpu_tracer(scene, cells);
  for (const Camera& camera : cameras_for(model, 75, 53)) {
    const Frame frame = tracer->render(camera, {});
    std::vector<Ray> rays;
    for (int y = 0; y < camera.height; ++y)
      for (int x = 0; x < camera.width; ++x) rays.push_back(camera.ray(x + 0.5, y + 0.5));
    for_every_instruction_set([&] {
      std::vector<Hit> hits(rays.size());
      tracer->cast(rays, hits);
      EXPECT_EQ(std::memcmp(frame.hits.data(), hits.data(), hits.size() * sizeof(Hit)), 0);
    });
  }
}

TEST(Cpu, EveryPartOfThePictureIsToldOnce) {
  const Model model = model_of("sphere(10);");
  const Scene scene = *lower(model);
  const CellTree cells = subdivide(scene, {});
  const auto tracer = make_cpu_tracer(scene, cells);
  const Camera camera = cameras_for(model, 150, 70)[0];
  std::mutex mutex;
  Frame told(150, 70);
  std::vector<int> times(150 * 70);
  const PartSeen note = [&](const Frame& frame, const PixelRect& part) {
    const std::lock_guard lock(mutex);
    for (int y = part.y0; y < part.y1; ++y)
      for (int x = part.x0; x < part.x1; ++x)
        told.at(x, y) = frame.at(x, y), ++times[size_t(y * 150 + x)];
  };
  const Frame frame = tracer->render(camera, {.part_seen = note});
  EXPECT_EQ(std::memcmp(frame.hits.data(), told.hits.data(), told.hits.size() * sizeof(Hit)), 0);
  EXPECT_TRUE(std::ranges::all_of(times, [](int n) { return n == 1; }));
}

TEST(Cpu, StopsWhenItIsAskedTo) {
  const Model model = model_of("sphere(10);");
  const Scene scene = *lower(model);
  const CellTree cells = subdivide(scene, {});
  const auto tracer = make_cpu_tracer(scene, cells, 1);
  const Camera camera = cameras_for(model, 150, 70)[0];
  std::stop_source stop;
  int parts = 0;
  const PartSeen once = [&](const Frame&, const PixelRect&) {
    ++parts;
    stop.request_stop();
  };
  tracer->render(camera, {.stop = stop.get_token(), .part_seen = once});
  EXPECT_EQ(parts, 1);
}

TEST(Cpu, AProbeSeesTheSameWhateverIsProbedBesideIt) {
  // Many positions in few pixels, then some far from them, as at a picture's edges.
  Traced model("difference(){cube(10, center = true); sphere(6.5);} cylinder(r=1,h=20);");
  Camera camera = camera_along({20, 30, 25}, {-20, -30, -25});
  camera.width = 61, camera.height = 43;
  camera.half_height = 0.3;
  std::vector<PixelPosition> positions;
  for (int i = 0; i < 1500; ++i) {
    const int far = i % 400 < 300 ? 0 : i % 7 * 8;
    positions.push_back({float(i % 4 + far) + 0.1f * float(i / 4 % 10),
                         float(20 + i / 40 % 5) + 0.2f * float(i % 5)});
  }
  std::vector<Hit> hits(positions.size());
  for_every_instruction_set([&] {
    model.tracer->probe(camera, positions, hits);
    size_t seen = 0;
    for (size_t i = 0; i < positions.size(); ++i) {
      Hit alone;
      model.tracer->probe(camera, std::span(positions).subspan(i, 1), std::span(&alone, 1));
      ASSERT_EQ(std::memcmp(&alone, &hits[i], sizeof(Hit)), 0) << i;
      seen += alone.hit();
    }
    EXPECT_GT(seen, 10u);
    EXPECT_LT(seen, positions.size());
  });
}

TEST(Cpu, WhatWasRecordedIsSeenAgain) {
  for (const uint64_t seed : {2, 9}) {
    const Model model = model_of(random_tree(seed, {.primitives = 30}));
    const Scene scene = *lower(model);
    const CellTree cells = subdivide(scene, {});
    const auto tracer = make_cpu_tracer(scene, cells);
    for (const Camera& camera : cameras_for(model, 91, 70))
      for_every_instruction_set([&] {
        const Frame rendered = tracer->render(camera, {}), recorded = tracer->record(camera);
        const uint64_t visits = tracer->stats().cells;
        const Frame replayed = tracer->replay(camera);
        EXPECT_EQ(tracer->stats().cells, visits) << "no ray walks";
        for (const Frame* frame : {&recorded, &replayed})
          EXPECT_EQ(std::memcmp(frame->hits.data(), rendered.hits.data(),
                                rendered.hits.size() * sizeof(Hit)),
                    0);
      });
  }
}

/// Whether the ray passes the box.
bool meets(const Ray& ray, const Box& box) {
  double t0 = ray.t_min, t1 = kInfinity;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (box.lo[axis] - ray.origin[axis]) / ray.direction[axis],
                 b = (box.hi[axis] - ray.origin[axis]) / ray.direction[axis];
    t0 = std::max(t0, std::min(a, b)), t1 = std::min(t1, std::max(a, b));
  }
  return t0 <= t1;
}

TEST(Cpu, NoCellIsRefinedThatNoRayMeets) {
  // Cells of a few pixels, so that rays next to one another go many ways.
  std::string text = "difference() { cube(40);";
  for (int i = 0; i < 600; ++i)
    text += "translate([" + std::to_string(i * 37 % 401 * 0.1) + "," +
            std::to_string(i * 53 % 397 * 0.1) + "," + std::to_string(i * 71 % 389 * 0.1) +
            "]) sphere(1.1);";
  const Model model = model_of(text + "}");
  const Scene scene = *lower(model);
  size_t refined = 0;
  for (const Camera& camera : cameras_for(model, 40, 30)) {
    const CellTree cells = open_cells(scene, {});
    make_cpu_tracer(scene, cells)->render(camera, {});
    std::vector<Ray> rays;
    for (int y = 0; y < camera.height; ++y)
      for (int x = 0; x < camera.width; ++x) rays.push_back(camera.ray(x + 0.5, y + 0.5));
    for_each_leaf(cells, [&](CellLink link, const Box& box) {
      if (link.kind() < CellKind::kConjunction || link.kind() == CellKind::kOpen) return;
      ++refined;
      const double more = 1e-9 * max_component(scene.region.size());
      const Box world{box.lo + scene.origin - Vec3{more, more, more},
                      box.hi + scene.origin + Vec3{more, more, more}};
      EXPECT_TRUE(std::ranges::any_of(rays, [&](const Ray& ray) { return meets(ray, world); }));
    });
  }
  EXPECT_GT(refined, 100u);
}

TEST(Cpu, RaysThatEndLeaveFarCellsAlone) {
  std::string text = "union() {";
  for (int i = 0; i < 600; ++i)
    text += "translate([" + std::to_string(i * 37 % 4001 * 0.1) + "," +
            std::to_string(i * 53 % 397 * 0.1) + "," + std::to_string(i * 71 % 389 * 0.1) +
            "]) sphere(1.1);";
  const Model model = model_of(text + "}");
  const Scene scene = *lower(model);
  std::vector<Ray> rays;
  for (int i = 0; i < 200; ++i)
    rays.push_back({{-5, 10 + i * 0.1, 20}, normalize(Vec3{1, 0.01 * (i % 7), 0.01 * (i % 9)})});
  const auto cast = [&](std::vector<Hit>& hits) {
    const CellTree cells = open_cells(scene, {});
    hits.resize(rays.size());
    make_cpu_tracer(scene, cells, 1)->cast(rays, hits);
    return statistics_of(cells).refined;
  };
  std::vector<Hit> all, near;
  const uint64_t refined_for_all = cast(all);
  constexpr double kEnd = 60;
  for (Ray& ray : rays) ray.t_max = kEnd;
  EXPECT_LT(cast(near) * 2, refined_for_all);
  size_t within = 0;
  for (size_t i = 0; i < rays.size(); ++i) {
    if (!(all[i].distance < kEnd)) {
      EXPECT_FALSE(near[i].distance < kEnd);
      continue;
    }
    ++within;
    EXPECT_EQ(near[i].distance, all[i].distance);
    EXPECT_EQ(near[i].id, all[i].id);
  }
  EXPECT_GT(within, 20u);
  EXPECT_LT(within, rays.size() - 20);
}

TEST(Cpu, ARayMayRunInAPlaneFromItsEyeOn) {
  Traced half("halfspace(n = [0, 0, 1], d = 2);");
  EXPECT_FALSE(half.hit({3, 0, 2}, {4, 0, 2}).hit()) << "as far as the region reaches";
  Traced cube("cube(10, center = true);");
  for (const double x : {0.0, 1.0, 5.0}) {
    const Hit hit = cube.hit({x, 0, 5}, {9, 3, 5});
    if (!hit.hit()) continue;
    EXPECT_NEAR(hit.distance, (5 - x) / std::cos(std::atan2(3, 9 - x)), 1e-6);
  }
}

TEST(Cpu, RaysThatPartTakeTheirOwnWay) {
  // Straight along an axis: the directions of neighbouring rays have all four pairs of signs.
  Traced model(
      "difference(){cube(10, center = true); translate([0,0,2]) cube([3,3,8], center = true);"
      " sphere(4.5);}");
  Camera camera = camera_along({0, 0, 30}, {0, 0, -1});
  camera.width = camera.height = 64;
  camera.half_height = 0.25;
  camera.right = {1, 0, 0}, camera.up = {0, 1, 0};
  const Frame frame = model.tracer->render(camera, {});
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      // The model has the symmetry of the square, and so has the picture.
      EXPECT_EQ(frame.at(x, y).id, frame.at(63 - x, y).id);
      EXPECT_EQ(frame.at(x, y).id, frame.at(y, x).id);
      ASSERT_EQ(frame.at(x, y).hit(), frame.at(x, 63 - y).hit());
      if (!frame.at(x, y).hit()) continue;
      EXPECT_NEAR(frame.at(x, y).distance, frame.at(x, 63 - y).distance, 1e-4);
    }
  EXPECT_EQ(frame.at(32, 32).id, 3u);
}

}  // namespace
}  // namespace whittle
