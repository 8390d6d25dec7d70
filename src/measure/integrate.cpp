#include "measure/integrate.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "measure/cell_integrator.h"
#include "subdivide/subdivide.h"

namespace whittle {
namespace {

struct Item {
  CellLink link;
  Box box;
};

/// What is not empty, in enough parts to keep all threads busy.
std::vector<Item> items_of(const CellTree& tree) {
  std::vector<Item> items;
  for_each_leaf(tree, [&](CellLink link, const Box& box) {
    if (link.kind() == CellKind::kFull || is_leaf(link.kind())) items.push_back({link, box});
  });
  constexpr size_t kEnough = 256;
  while (!items.empty() && items.size() < kEnough) {
    std::vector<Item> parts;
    for (const Item& item : items) {
      const int axis = split_axis(item.box.size(), SplitRule::kLongest, 0);
      Item low = item, high = item;
      low.box.hi[axis] = high.box.lo[axis] = item.box.center()[axis];
      parts.push_back(low);
      parts.push_back(high);
    }
    items.swap(parts);
  }
  return items;
}

class Passes {
 public:
  Passes(const Scene& scene, const Workers& workers, const IntegrateSettings& settings,
         std::vector<Item> items)
      : scene_(scene),
        workers_(workers),
        settings_(settings),
        items_(std::move(items)),
        half_spaces_(CellIntegrator::place(scene)),
        integrators_(workers) {}

  /// No part may be wrong by more than `each`. None if that takes too many parts.
  std::optional<Integrated> run(double each) {
    constexpr size_t kChunk = 8;
    std::vector<Integral> sums((items_.size() + kChunk - 1) / kChunk);
    std::atomic<uint64_t> parts{0};
    std::atomic<size_t> done{0};
    workers_.for_parts(sums.size(), 1, [&](size_t first, size_t last, size_t worker) {
      CellIntegrator& integrator = integrators_.of(worker, scene_, half_spaces_, gauss_);
      for (size_t chunk = first; chunk < last; ++chunk) {
        for (size_t i = chunk * kChunk; i < std::min(items_.size(), (chunk + 1) * kChunk); ++i) {
          if (parts > settings_.most_parts) return;
          const uint64_t before = integrator.parts();
          integrator.add(items_[i].link, items_[i].box, each, before + settings_.most_parts,
                         sums[chunk]);
          parts += integrator.parts() - before;
        }
        if (settings_.progress) settings_.progress(double(++done) / double(sums.size()));
      }
    });
    if (parts > settings_.most_parts) return std::nullopt;
    Integrated all;
    for (const Integral& sum : sums) all.integral.add(sum);
    all.parts = parts;
    add_rounding(all.integral);
    all.is_within = all.integral.bound(kVolume) <= settings_.within * all.integral[kVolume];
    return all;
  }

 private:
  /// Surfaces are off by rounding, and where bodies are boundaries by these's slack.
  void add_rounding(Integral& integral) const {
    constexpr double kRounding = 1e-15;
    const Vec3 half = scene_.region.size() * 0.5;
    double off = 4 * kRounding * max_component(half);
    for (const Boundary& boundary : scene_.boundaries) off = std::max(off, 2 * boundary.slack());
    const double surface = integral[kArea] + integral.bound(kArea);
    const double volume = off * surface + kRounding * integral[kVolume];
    integral.add_bounds(weighted(volume, {}, half));
  }

  const Scene& scene_;
  const Workers& workers_;
  const IntegrateSettings& settings_;
  const GaussTable gauss_;
  const std::vector<Item> items_;
  const std::vector<PlacedHalfSpace> half_spaces_;
  PerWorker<CellIntegrator> integrators_;
};

}  // namespace

Integrated integrate(const Scene& scene, const Workers& workers,
                     const IntegrateSettings& settings) {
  if (scene.region.is_empty()) {
    Integrated nothing;
    nothing.is_within = true;
    return nothing;
  }
  const CellTree tree = open_cells(scene, {}, &workers);
  refine_all(tree, workers);
  Passes passes(scene, workers, settings, items_of(tree));
  const Vec3 size = scene.region.size();
  // What is 0 never becomes more.
  constexpr double kLeast = std::numeric_limits<double>::min();
  double each = std::max(size.x * size.y * size.z * settings.within / 1024, kLeast);
  std::optional<Integrated> best;
  bool is_limited = false;
  while (true) {
    std::optional<Integrated> found = passes.run(each);
    if (!found) {
      if (best) return *best;
      is_limited = true;
      each *= 64;
      continue;
    }
    best = found;
    const Integral& integral = best->integral;
    const double bound = integral.bound(kVolume), wanted = settings.within * integral[kVolume];
    // Along edges twice as small parts are twice as many, and each is 16 times as good.
    const double share = std::pow(wanted / bound, 4.0 / 3) * 0.6;
    constexpr double kLeastShare = 1e-9;
    if (best->is_within || is_limited || !(share > kLeastShare)) return *best;
    // In small steps: a time through that takes too many parts is in vain.
    each = std::max(each * std::clamp(share, 1.0 / 64, 0.5), kLeast);
  }
}

}  // namespace whittle
