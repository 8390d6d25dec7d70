// Any bytes as a model (picture_model.h) with facets: its boundary must be closed, manifold, and
// wind once around what is inside.
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <string_view>

#include "boundary/evaluate_solid.h"
#include "fuzz/picture_model.h"
#include "fuzz/require.h"
#include "fuzz/target.h"
#include "lower/evaluate.h"
#include "lower/lower.h"
#include "model/instances.h"
#include "support/mesh_checks.h"
#include "support/read_text.h"

namespace whittle {
namespace {

/// Points at random, but for those so near to a surface that rounding decides.
void check_points(const Scene& scene, const SolidMesh& mesh, const std::string& text) {
  constexpr int kPoints = 12;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> share(0, 1);
  const Vec3 size = scene.region.size();
  double slack = 1e-6 * max_component(size);
  for (const Boundary& boundary : scene.boundaries) slack = std::max(slack, 4 * boundary.slack());
  for (int i = 0; i < kPoints; ++i) {
    Vec3 p = scene.region.lo;
    for (int k = 0; k < 3; ++k) p[k] += share(random) * size[k];
    const auto is_near = [&](const HalfSpace& h) {
      return std::fabs(Kernels<double>::quadric_value(h.f, p - h.center)) < slack;
    };
    if (std::ranges::any_of(scene.half_spaces, is_near)) continue;
    const int expected = contains(scene, scene.formula, p) ? 1 : 0;
    require(winding(mesh, p + scene.origin) == expected, "a point on the wrong side\n" + text);
  }
}

/// Curves of six sides where thirty were asked for: they meet in as many ways, five times as fast.
void coarsen(std::string& text) {
  constexpr std::string_view kFine = "$fa = 12", kCoarse = "$fa = 60";
  for (size_t at = text.find(kFine); at != std::string::npos; at = text.find(kFine, at))
    text.replace(at, kFine.size(), kCoarse);
}

PictureInput decode(std::span<const uint8_t> bytes, double nearly) {
  PictureInput input = decode_picture(bytes, nearly);
  coarsen(input.text);
  return input;
}

void check(std::span<const uint8_t> bytes) {
  PictureInput input = decode(bytes, 0);
  Model model = facetted_model_of(input.text);
  if (input.uses_nearly) {
    input = decode(bytes, tolerance(bounds(model)));
    model = facetted_model_of(input.text);
  }
  const Result<Scene> scene = lower(model);
  if (!scene || !scene->bounded) return;
  const Workers workers(1);
  const Result<SolidMesh> mesh = evaluate_solid(*scene, workers);
  require(bool(mesh), "no boundary: " + (mesh ? "" : mesh.error().message) + "\n" + input.text);
  const std::string fault = manifold_fault(*mesh);
  require(fault.empty(), fault + "\n" + input.text);
  check_points(*scene, *mesh, input.text);
}

}  // namespace
}  // namespace whittle

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  whittle::check({data, size});
  return 0;
}
