// What the innermost steps cost: reading a text, one half-space against a cell, one against a ray,
// one formula against a cell, one leaf along rays, one pixel's colour. Whole frames are measured by
// `whittle bench`.
#include <benchmark/benchmark.h>

#include <random>
#include <span>
#include <string>
#include <vector>

#include "csg/read_csg.h"
#include "generate/generate.h"
#include "image/shade.h"
#include "lower/lower.h"
#include "subdivide/simplify.h"
#include "whittle/renderer.h"

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

void read_text(benchmark::State& state) {
  const std::string text = *generate_model("cheese", int(state.range(0)), 1);
  for (auto _ : state) benchmark::DoNotOptimize(read_csg(text, "cheese"));
  state.SetBytesProcessed(int64_t(state.iterations()) * int64_t(text.size()));
}
BENCHMARK(read_text)->Arg(1000)->Arg(100000)->Unit(benchmark::kMillisecond);

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
        simplifier.simplify(scene.formula, cells[i++ % cells.size()], Expand::kUnits, out));
  state.SetItemsProcessed(int64_t(state.iterations()) * int64_t(scene.faces.size()));
}
BENCHMARK(simplify_formula)->Arg(10)->Arg(100)->Arg(1000)->Arg(10000);

/// Rays that all meet one leaf, which is the whole model: what is left is the leaf.
void solve_leaf(benchmark::State& state, const char* text) {
  const Result<Read> read = read_csg(text, "leaf");
  RendererSettings settings;
  settings.threads = 1;
  Result<Renderer> renderer = Renderer::make(read->model, settings);
  ViewOptions view;
  view.width = view.height = 64;
  const Camera camera = renderer->camera(view);
  WHITTLE_CHECK(renderer->prepare(camera));
  for (auto _ : state) benchmark::DoNotOptimize(renderer->trace(camera)->hits.data());
  state.SetItemsProcessed(int64_t(state.iterations()) * camera.width * camera.height);
}
BENCHMARK_CAPTURE(solve_leaf, sphere, "sphere(10);");
BENCHMARK_CAPTURE(solve_leaf, box, "cube(10);");
BENCHMARK_CAPTURE(solve_leaf, box_and_ball, "difference() { cylinder(h = 10, r = 5); sphere(4); }");
BENCHMARK_CAPTURE(solve_leaf, table, "union() { cylinder(h = 10, r = 5); sphere(6); }");

void shade_pixels(benchmark::State& state) {
  const Result<Read> read = read_csg(*generate_model("cheese", 1000, 1), "cheese");
  RendererSettings settings;
  settings.threads = 1;
  Result<Renderer> renderer = Renderer::make(read->model, settings);
  const Camera camera = renderer->camera({});
  WHITTLE_CHECK(renderer->prepare(camera));
  const Frame frame = *renderer->trace(camera);
  ShadeSettings look;
  look.style = Style(state.range(0));
  for (auto _ : state)
    benchmark::DoNotOptimize(renderer->shade(frame, camera, look, 1)->rgba.data());
  state.SetItemsProcessed(int64_t(state.iterations()) * camera.width * camera.height);
}
BENCHMARK(shade_pixels)
    ->ArgName("style")
    ->Arg(int64_t(Style::kStudio))
    ->Arg(int64_t(Style::kBlinn))
    ->Arg(int64_t(Style::kOpenscad))
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace whittle

BENCHMARK_MAIN();
