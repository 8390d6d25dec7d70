#include "orbit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numeric>
#include <vector>

#include "base/timing.h"
#include "base/workers.h"
#include "model/instances.h"
#include "trace/turntable.h"

namespace whittle {
namespace {

using Json = nlohmann::ordered_json;

uint64_t refined(const Renderer& renderer) {
  return renderer.cells() != nullptr ? statistics_of(*renderer.cells()).refined : 0;
}

size_t differing(const Frame& a, const Frame& b) {
  size_t count = 0;
  for (size_t i = 0; i < a.hits.size(); ++i)
    count += std::memcmp(&a.hits[i], &b.hits[i], sizeof(Hit)) != 0;
  return count;
}

}  // namespace

Result<Json> measure_orbit(const Model& model, const RendererSettings& settings,
                           const Camera& start, int steps) {
  Result<Renderer> kept = Renderer::make(model, settings);
  if (!kept) return kept.error();
  Result<Renderer> afresh = Renderer::make(model, settings);
  if (!afresh) return afresh.error();
  if (Status done = kept->prepare(start); !done) return done.error();
  // A first picture may leave out what is hidden, a second one does not.
  for (int i = 0; i < 2; ++i)
    if (const Result<Frame> frame = kept->trace(start); !frame) return frame.error();

  const Workers workers(settings.threads);
  const Vec3 about = view_region(bounds(model)).center();
  std::vector<double> step_ms, afresh_ms, subdivide_ms, share;
  std::vector<uint64_t> newly, all;
  for (int i = 1; i <= steps; ++i) {
    const Camera camera = turned(start, about, i);
    const uint64_t before = refined(*kept);
    const Stopwatch watch;
    const Result<Frame> frame = kept->trace(camera);
    step_ms.push_back(watch.milliseconds());
    if (!frame) return frame.error();
    subdivide_ms.push_back(kept->times().subdivide);
    // Less than before: a new tree.
    const uint64_t now = refined(*kept);
    newly.push_back(now >= before ? now - before : now);

    afresh->discard();
    const Stopwatch other_watch;
    if (Status done = afresh->prepare(camera); !done) return done.error();
    const Result<Frame> expected = afresh->trace(camera);
    afresh_ms.push_back(other_watch.milliseconds());
    if (!expected) return expected.error();
    if (afresh->cells() != nullptr) refine_all(*afresh->cells(), workers);
    all.push_back(refined(*afresh));
    share.push_back(all.back() > 0 ? double(newly.back()) / double(all.back()) : 0);
    if (const size_t differ = differing(*frame, *expected); differ != 0)
      return Error{ErrorKind::kInput,
                   fmt::format("step {} of the orbit differs from the same picture made afresh at "
                               "{} pixels",
                               i, differ)};
  }
  Json json;
  json["steps"] = steps;
  json["step_ms"] = step_ms;
  json["of_it_cells_ms"] = subdivide_ms;
  json["afresh_ms"] = afresh_ms;
  json["refined"] = newly;
  json["refined_afresh"] = all;
  json["median_step_ms"] = median(step_ms);
  json["median_afresh_ms"] = median(afresh_ms);
  json["median_refined_share"] = median(share);
  json["refined_share_in_all"] = std::accumulate(share.begin(), share.end(), 0.0);
  json["most_refined_share"] = *std::ranges::max_element(share);
  return json;
}

}  // namespace whittle
