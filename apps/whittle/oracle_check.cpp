#include "oracle_check.h"

#include <fmt/format.h>

#include <array>
#include <vector>

#include "image/compare.h"

namespace whittle {
namespace {

constexpr float kDisplacement = 1e-3f;  ///< pixels

bool is_same(const Camera& camera, const Hit& a, const Hit& b) {
  CompareSettings settings;
  // In an orthographic picture distances count from a plane through the model.
  if (camera.orthographic) settings.distance_floor = 2 * camera.half_height;
  Frame frame_a(1, 1), frame_b(1, 1);
  frame_a.hits[0] = a;
  frame_b.hits[0] = b;
  return compare(frame_a, frame_b, settings).equal();
}

std::string describe(const Hit& hit) {
  if (!hit.hit()) return "nothing";
  return fmt::format("id {} at {:.6g} with normal ({:.4g}, {:.4g}, {:.4g})", hit.id, hit.distance,
                     hit.normal.x, hit.normal.y, hit.normal.z);
}

}  // namespace

OracleCheck check_against_oracle(Tracer& tracer, Tracer& oracle, const Camera& camera) {
  std::vector<PixelPosition> places;
  for (int y = 0; y < kCheckedSide; ++y) {
    for (int x = 0; x < kCheckedSide; ++x) {
      places.push_back({(float(x) + 0.5f) * float(camera.width) / float(kCheckedSide),
                        (float(y) + 0.5f) * float(camera.height) / float(kCheckedSide)});
    }
  }
  std::vector<Hit> seen(places.size()), right(places.size());
  tracer.probe(camera, places, seen);
  oracle.probe(camera, places, right);

  OracleCheck check;
  for (size_t i = 0; i < places.size(); ++i) {
    if (is_same(camera, seen[i], right[i])) {
      ++check.certain;
      continue;
    }
    const auto [x, y] = places[i];
    constexpr float d = kDisplacement;
    const std::array<PixelPosition, 4> around = {
        {{x - d, y - d}, {x + d, y - d}, {x - d, y + d}, {x + d, y + d}}};
    std::array<Hit, 4> near_by;
    oracle.probe(camera, around, near_by);
    bool is_certain = true;
    for (const Hit& hit : near_by) is_certain = is_certain && is_same(camera, hit, right[i]);
    if (!is_certain) {
      ++check.ambiguous;
      continue;
    }
    ++check.certain;
    if (++check.wrong == 1) {
      check.first = fmt::format("at pixel ({:.1f}, {:.1f}) it shows {}, where the oracle sees {}",
                                x, y, describe(seen[i]), describe(right[i]));
    }
  }
  return check;
}

}  // namespace whittle
