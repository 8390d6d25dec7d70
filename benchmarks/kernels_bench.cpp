// What the innermost steps cost: one half-space against a cell, one against a ray, one formula
// against a cell. Whole frames are measured by `whittle bench`.
#include <benchmark/benchmark.h>

#include <random>
#include <vector>

#include "io/generate.h"
#include "io/read.h"
#include "lower/lower.h"
#include "subdivide/simplify.h"

namespace whittle {
namespace {

Scene cheese(int holes) {
  Result<Read> read = read_csg(*generate_model("cheese", holes, 1), "cheese");
  return *lower(read->model);
}

/// Boxes an eighth of the region wide, anywhere in it.
std::vector<Box> boxes(const Box& region) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Box> result(1024);
  for (Box& box : result) {
    const Vec3 size = region.size();
    box.lo = region.lo +
             Vec3{unit(random) * size.x, unit(random) * size.y, unit(random) * size.z} * 0.875;
    box.hi = box.lo + size * 0.125;
  }
  return result;
}

void classify_half_space(benchmark::State& state) {
  const Scene scene = cheese(1000);
  const std::vector<Box> cells = boxes(scene.region);
  size_t i = 0;
  for (auto _ : state) {
    const CellBox cell(cells[i % cells.size()], 0);
    benchmark::DoNotOptimize(classify(scene.half_spaces[i % scene.half_spaces.size()], cell));
    ++i;
  }
}
BENCHMARK(classify_half_space);

void root_along_ray(benchmark::State& state) {
  using K = Kernels<double>;
  const Scene scene = cheese(1000);
  const Vec3 direction = normalize(Vec3{0.3, -0.5, 0.8});
  size_t i = 0;
  for (auto _ : state) {
    const HalfSpace& h = scene.half_spaces[i++ % scene.half_spaces.size()];
    benchmark::DoNotOptimize(
        K::along_root(K::quadric_along_ray(h.f, Vec3{1, 2, 3} - h.center, direction), false));
  }
}
BENCHMARK(root_along_ray);

void simplify_formula(benchmark::State& state) {
  const Scene scene = cheese(int(state.range(0)));
  const std::vector<Box> cells = boxes(scene.region);
  const UnitBoxes boxes(scene);
  Simplifier simplifier(scene, boxes, 0);
  Formula out;
  size_t i = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(
        simplifier.simplify(scene.formula, cells[i++ % cells.size()], true, out));
  state.SetItemsProcessed(int64_t(state.iterations()) * int64_t(scene.faces.size()));
}
BENCHMARK(simplify_formula)->Arg(10)->Arg(100)->Arg(1000)->Arg(10000);

}  // namespace
}  // namespace whittle

BENCHMARK_MAIN();
