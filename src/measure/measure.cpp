#include "measure/measure.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "boundary/evaluate_solid.h"
#include "lower/lower.h"
#include "measure/integrate.h"
#include "measure/material.h"
#include "measure/mesh_integral.h"
#include "model/instances.h"

namespace whittle {
namespace {

Mass mass_of(const Integral& integral, Vec3 origin) {
  Mass mass;
  const double volume = integral[kVolume], off = integral.bound(kVolume);
  mass.volume = {volume, off};
  mass.area = {integral[kArea], integral.bound(kArea)};
  const double least = volume - off;
  if (!(least > 0)) {
    mass.centroid_bound = mass.inertia_bound = kInfinity;
    return mass;
  }
  Vec3 center;
  for (int i = 0; i < 3; ++i) {
    center[i] = integral[first_of(i)] / volume;
    mass.centroid_bound = std::max(
        mass.centroid_bound, (integral.bound(first_of(i)) + std::fabs(center[i]) * off) / least);
  }
  mass.centroid = center + origin;
  // Moved to the centroid: the integral of xy less that of x times the centroid's y.
  const double center_off = mass.centroid_bound;
  const auto about_center = [&](int i, int j) {
    const size_t product = product_of(i, j), first = first_of(j);
    return Bounded{integral[product] - center[i] * integral[first],
                   integral.bound(product) + std::fabs(center[i]) * integral.bound(first) +
                       center_off * (std::fabs(integral[first]) + integral.bound(first))};
  };
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const Bounded jj = about_center(j, j), kk = about_center(k, k), jk = about_center(j, k);
    mass.moments[i] = jj.value + kk.value;
    mass.products[i] = -jk.value;
    mass.inertia_bound = std::max({mass.inertia_bound, jj.bound + kk.bound, jk.bound});
  }
  return mass;
}

class Measurer {
 public:
  Measurer(const Scene& scene, const MeasureSettings& settings, const Workers& workers)
      : settings_(settings), workers_(workers) {
    is_facetted_ = std::all_of(scene.half_spaces.begin(), scene.half_spaces.end(),
                               [](const HalfSpace& h) { return h.is_plane(); });
  }

  Result<Mass> of(const Scene& scene) const {
    if (!is_facetted_) {
      const Integrated found =
          integrate(scene, workers_, {.within = settings_.within, .progress = settings_.progress});
      Mass mass = mass_of(found.integral, scene.origin);
      mass.is_within = found.is_within;
      return mass;
    }
    const Result<SolidMesh> mesh = evaluate_solid(scene, workers_);
    if (!mesh) return mesh.error();
    // What evaluate_solid() says of its corners.
    constexpr double kCornerError = 1e-12;
    const double edge = scene.region.is_empty() ? 0 : max_component(scene.region.size());
    Mass mass = mass_of(mesh_integral(*mesh, scene.origin, kCornerError * edge), scene.origin);
    mass.is_facetted = true;
    return mass;
  }

 private:
  const MeasureSettings& settings_;
  const Workers& workers_;
  bool is_facetted_ = true;
};

/// The colours of a scene's primitives, as they first come, and which each primitive has.
struct Palette {
  std::vector<std::optional<Rgba>> colors;
  std::vector<uint32_t> of_id;
};

Palette palette_of(const Model& model, const Scene& scene) {
  const std::vector<Appearance> looks = appearances(model);
  Palette palette;
  palette.of_id.resize(looks.size());
  uint32_t last = UINT32_MAX;
  for (const Unit& unit : scene.units) {
    if (unit.id == last) continue;
    last = unit.id;
    const Rgba look = looks[unit.id].color;
    const std::optional<Rgba> color = look.is_valid() ? std::optional(look) : std::nullopt;
    auto at = std::find(palette.colors.begin(), palette.colors.end(), color);
    if (at == palette.colors.end()) {
      palette.colors.push_back(color);
      // So many are not told apart anyway.
      if (palette.colors.size() > kMostColors) break;
      at = palette.colors.end() - 1;
    }
    palette.of_id[unit.id] = uint32_t(at - palette.colors.begin());
  }
  return palette;
}

}  // namespace

Result<Measures> measure(const Model& model, const MeasureSettings& settings) {
  if (model.drawing) return Error{ErrorKind::kInput, "what is flat has no volume"};
  const Workers workers(settings.threads);
  Result<Scene> scene = lower(model, &workers);
  if (!scene) return scene.error();
  if (!scene->bounded) return Error{ErrorKind::kInput, "the solid has no end, so no volume"};

  const Measurer measurer(*scene, settings, workers);
  Measures measures;
  const Result<Mass> whole = measurer.of(*scene);
  if (!whole) return whole.error();
  measures.whole = *whole;
  if (!settings.by_color) return measures;
  const Palette palette = palette_of(model, *scene);
  measures.color_count = palette.colors.size();
  if (palette.colors.size() < 2 || palette.colors.size() > kMostColors) return measures;
  const Formula all = std::move(scene->formula);
  constexpr size_t kMostGrowth = 8, kSmall = 1'000'000;
  for (uint32_t i = 0; i < palette.colors.size(); ++i) {
    scene->formula = all;
    Result<Formula> part = material_of(
        *scene, [&](uint32_t id) { return palette.of_id[id] == i; },
        std::max(kSmall, kMostGrowth * all.size()));
    if (!part) return part.error();
    scene->formula = *std::move(part);
    const Result<Mass> mass = measurer.of(*scene);
    if (!mass) return mass.error();
    if (mass->volume.value > mass->volume.bound)
      measures.colors.push_back({palette.colors[i], *mass});
  }
  return measures;
}

}  // namespace whittle
