#include "slice/slicer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "base/box.h"
#include "base/result.h"

namespace whittle {
namespace {

/// Triangles that are looked at one by one.
constexpr size_t kBlock = 16;

/// A mesh's edge that crosses the plane: its corner below, then the one above.
uint64_t edge_name(uint32_t below, uint32_t above) {
  return uint64_t(below) << 32 | above;
}

/// What a triangle has in the plane. Of an edge's two triangles one ends there and one begins.
struct Segment {
  uint64_t from, to;
  uint32_t face;
};

/// The same in coordinates.
struct Side {
  Vec2 from, to;
  uint32_t face;
};

bool is_on_line(Vec2 p, Vec2 a, Vec2 b, double rounding) {
  return std::fabs(cross(p - a, b - a)) <= rounding * length(b - a);
}

/// Leaves out sides without length, and ways there and back, which enclose nothing.
std::vector<Side> without_spikes(const std::vector<Side>& sides) {
  std::vector<Side> kept;
  for (const Side& side : sides) {
    if (side.from == side.to) continue;
    if (!kept.empty() && kept.back().from == side.to)
      kept.pop_back();
    else
      kept.push_back(side);
  }
  size_t first = 0, last = kept.size();
  while (last - first >= 2 && kept[first].to == kept[last - 1].from) ++first, --last;
  return {kept.begin() + std::ptrdiff_t(first), kept.begin() + std::ptrdiff_t(last)};
}

/// Sides of one face that go on from one another become one.
Contour corners_of(const std::vector<Side>& sides, double rounding) {
  const auto go_on = [rounding](const Side& a, const Side& b) {
    return a.face == b.face && is_on_line(b.from, a.from, b.to, rounding);
  };
  std::vector<Side> joined;
  for (const Side& side : sides) {
    if (!joined.empty() && go_on(joined.back(), side))
      joined.back().to = side.to;
    else
      joined.push_back(side);
  }
  if (joined.size() > 1 && go_on(joined.back(), joined.front())) {
    joined.front().from = joined.back().from;
    joined.pop_back();
  }
  Contour contour;
  for (const Side& side : joined) contour.push_back(side.from);
  return contour;
}

}  // namespace

Slicer::Slicer(const SolidMesh& mesh) : mesh_(mesh) {
  double farthest = 0;
  for (const Vec3& c : mesh.corners)
    farthest = std::max({farthest, std::fabs(c.x), std::fabs(c.y), std::fabs(c.z)});
  constexpr double kManyUnitsOfTheLastPlace = 1e-12;
  rounding_ = kManyUnitsOfTheLastPlace * farthest;

  std::vector<std::pair<double, uint32_t>> by_lowest;
  const auto heights = [&](uint32_t triangle) {
    const auto& [a, b, c] = mesh.triangles[triangle].corners;
    return std::minmax({mesh.corners[a].z, mesh.corners[b].z, mesh.corners[c].z});
  };
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::pair<double, double> z = heights(t);
    if (z.first < z.second) by_lowest.emplace_back(z.first, t);
  }
  std::ranges::sort(by_lowest);
  const size_t blocks = (by_lowest.size() + kBlock - 1) / kBlock, leaves = std::bit_ceil(blocks);
  triangles_.reserve(by_lowest.size());
  lowest_.reserve(blocks);
  highest_.assign(2 * leaves, -kInfinity);
  for (size_t i = 0; i < by_lowest.size(); ++i) {
    const auto [low, triangle] = by_lowest[i];
    triangles_.push_back(triangle);
    if (i % kBlock == 0) lowest_.push_back(low);
    double& highest = highest_[leaves + i / kBlock];
    highest = std::max(highest, heights(triangle).second);
  }
  for (size_t node = leaves - 1; node > 0; --node)
    highest_[node] = std::max(highest_[2 * node], highest_[2 * node + 1]);
}

std::vector<uint32_t> Slicer::crossed(double z) const {
  std::vector<uint32_t> found;
  const size_t leaves = highest_.size() / 2;
  const auto blocks = size_t(std::ranges::upper_bound(lowest_, z) - lowest_.begin());
  std::vector<size_t> open{1};
  while (!open.empty()) {
    const size_t node = open.back();
    open.pop_back();
    if (highest_[node] <= z) continue;
    // The first block below it: down to the left as far as it goes.
    const int levels = std::countl_zero(node) - std::countl_zero(leaves);
    if ((node << levels) - leaves >= blocks) continue;
    if (node < leaves) {
      open.insert(open.end(), {2 * node + 1, 2 * node});
      continue;
    }
    const size_t first = (node - leaves) * kBlock;
    for (size_t i = first; i < std::min(first + kBlock, triangles_.size()); ++i) {
      const auto& corners = mesh_.triangles[triangles_[i]].corners;
      const auto below =
          std::ranges::count_if(corners, [&](uint32_t corner) { return is_below(corner, z); });
      if (below == 1 || below == 2) found.push_back(triangles_[i]);
    }
  }
  return found;
}

std::vector<Contour> Slicer::at(double z) const {
  const double limit = z + rounding_;
  std::vector<Segment> segments;
  for (const uint32_t t : crossed(limit)) {
    const SolidMesh::Triangle& triangle = mesh_.triangles[t];
    Segment segment{0, 0, triangle.face};
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t a = triangle.corners[i], b = triangle.corners[(i + 1) % 3];
      // With the triangle's outside before one, its boundary goes down on the left.
      if (is_below(a, limit) && !is_below(b, limit)) segment.to = edge_name(a, b);
      if (!is_below(a, limit) && is_below(b, limit)) segment.from = edge_name(b, a);
    }
    segments.push_back(segment);
  }
  std::ranges::sort(segments, {}, &Segment::from);

  // From the corner below, so that both triangles of an edge have the same point there.
  const auto point = [&](uint64_t edge) {
    const Vec3 a = mesh_.corners[edge >> 32], b = mesh_.corners[uint32_t(edge)];
    const double share = a.z >= z - rounding_ ? 0 : (z - a.z) / (b.z - a.z);
    return Vec2{a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
  };
  std::vector<Contour> loops;
  std::vector<bool> is_done(segments.size());
  std::vector<Side> sides;
  for (size_t start = 0; start < segments.size(); ++start) {
    if (is_done[start]) continue;
    sides.clear();
    size_t at = start;
    do {
      is_done[at] = true;
      const Segment& segment = segments[at];
      sides.push_back({point(segment.from), point(segment.to), segment.face});
      const auto next = std::ranges::lower_bound(segments, segment.to, {}, &Segment::from);
      WHITTLE_CHECK(next != segments.end() && next->from == segment.to);
      at = size_t(next - segments.begin());
    } while (at != start);
    Contour contour = corners_of(without_spikes(sides), rounding_);
    if (contour.size() >= 3) loops.push_back(std::move(contour));
  }
  return loops;
}

}  // namespace whittle
