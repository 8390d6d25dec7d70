#include "boundary/paints.h"

#include <algorithm>

namespace whittle {

Paints::Paints(const Scene& scene, std::span<const PlacedHalfSpace> half_spaces,
               std::span<const uint32_t> of_body, PlaneTable& planes)
    : of_body_(of_body) {
  if (of_body.empty()) return;
  std::vector<std::pair<uint32_t, uint32_t>> pairs;  // plane, paint
  pairs.reserve(scene.faces.size());
  for (const Face& face : scene.faces)
    pairs.emplace_back(half_spaces[face.literal >> 1].plane, of_body[scene.units[face.unit].id]);
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  for (size_t i = 0; i < pairs.size(); ++i) {
    const bool follows = i > 0 && pairs[i - 1].first == pairs[i].first;
    const bool is_followed = i + 1 < pairs.size() && pairs[i + 1].first == pairs[i].first;
    if (!follows && !is_followed) continue;
    const uint32_t plane = pairs[i].first;
    copies_.emplace(pairs[i], follows ? planes.add_copy(plane) : plane);
  }
}

bool Paints::are_several(uint32_t plane) const {
  const auto found = copies_.lower_bound({plane, 0});
  return found != copies_.end() && found->first.first == plane;
}

uint32_t Paints::painted(uint32_t plane, uint32_t body) const {
  const auto found = copies_.find({plane, of_body_[body]});
  return found == copies_.end() ? plane : found->second;
}

void Paints::spread(std::vector<uint32_t>& by_plane) const {
  for (const auto& [plane_and_paint, copy] : copies_)
    by_plane[copy] = by_plane[plane_and_paint.first];
}

}  // namespace whittle
