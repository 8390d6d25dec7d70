#include "boundary/stl_loss.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "base/disjoint_sets.h"
#include "boundary/face_loops.h"

namespace whittle {
namespace {

/// What is left, with its edges sewn together where triangles between them are left out.
class Rest {
 public:
  Rest(const SolidMesh& mesh, std::vector<bool> is_gone, std::vector<bool> is_short)
      : twins_(twins_of(mesh)), is_gone_(std::move(is_gone)), is_short_(std::move(is_short)) {}

  size_t count_holes() const {
    DisjointSets shells(is_gone_.size());
    for (uint32_t edge = 0; edge < twins_.size(); ++edge)
      if (!is_gone_[edge / 3]) shells.join(edge / 3, across(edge) / 3);
    std::vector<bool> is_seen(twins_.size());
    int64_t corners = 0, edges = 0, triangles = 0, parts = 0;
    for (uint32_t edge = 0; edge < twins_.size(); ++edge) {
      if (is_gone_[edge / 3]) continue;
      ++edges;
      triangles += edge % 3 == 0;
      parts += edge % 3 == 0 && shells.find(edge / 3) == edge / 3;
      if (is_seen[edge]) continue;
      ++corners;
      for (uint32_t at = edge; !is_seen[at]; at = next_half_edge(across(at))) is_seen[at] = true;
    }
    return size_t(parts - (corners - edges / 2 + triangles) / 2);
  }

  /// Shells that were there before.
  size_t missing_shells() const {
    const auto n = uint32_t(is_gone_.size());
    DisjointSets shells(n);
    for (uint32_t edge = 0; edge < 3 * n; ++edge) shells.join(edge / 3, twins_[edge] / 3);
    std::vector<bool> is_left(n);
    for (uint32_t t = 0; t < n; ++t)
      if (!is_gone_[t]) is_left[shells.find(t)] = true;
    size_t missing = 0;
    for (uint32_t t = 0; t < n; ++t) missing += shells.find(t) == t && !is_left[t];
    return missing;
  }

 private:
  uint32_t across(uint32_t edge) const {
    uint32_t other = twins_[edge];
    // Of a triangle that is gone two edges lie on one another.
    while (is_gone_[other / 3]) {
      const uint32_t ahead = next_half_edge(other);
      other = twins_[is_short_[ahead] ? next_half_edge(ahead) : ahead];
    }
    return other;
  }

  std::vector<uint32_t> twins_;
  std::vector<bool> is_gone_;   ///< by triangle
  std::vector<bool> is_short_;  ///< by half-edge: its ends are one
};

}  // namespace

StlLoss loss_of(const SolidMesh& mesh, const std::vector<bool>& is_short) {
  std::vector<bool> is_gone(mesh.triangles.size());
  for (size_t i = 0; i < is_short.size(); ++i)
    if (is_short[i]) is_gone[i / 3] = true;
  StlLoss loss;
  loss.triangles = size_t(std::count(is_gone.begin(), is_gone.end(), true));
  if (loss.triangles == 0) return loss;
  const Rest whole(mesh, std::vector<bool>(is_gone.size()), is_short),
      rest(mesh, is_gone, is_short);
  const size_t before = whole.count_holes(), after = rest.count_holes();
  loss.holes = before > after ? before - after : 0;
  loss.shells = rest.missing_shells();
  return loss;
}

}  // namespace whittle
