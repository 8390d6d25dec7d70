#include "evaluate/convex_pieces.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "base/disjoint_sets.h"

namespace whittle {
namespace {

using Loop = std::vector<uint32_t>;

class Joiner {
 public:
  Joiner(std::span<const Vec3> points, std::span<const TriangleMesh::Triangle> triangles)
      : points_(points), joined_(triangles.size()) {
    for (const TriangleMesh::Triangle& t : triangles) {
      loops_.push_back({t.corners.begin(), t.corners.end()});
      if (t.facet >= normals_.size()) normals_.resize(t.facet + 1);
      const Vec3 a = at(t.corners[0]);
      normals_[t.facet] += cross(at(t.corners[1]) - a, at(t.corners[2]) - a);
    }
    for (Vec3& normal : normals_) normal = normalize(normal);
  }

  /// Joins what these two triangles, of one facet, have become.
  void join(uint32_t one, uint32_t other, uint32_t facet, uint32_t from, uint32_t to) {
    const uint32_t a = joined_.find(one), b = joined_.find(other);
    if (a == b || loops_[a].size() + loops_[b].size() > kMostPieceCorners) return;
    std::optional<Loop> joined = united(loops_[a], loops_[b], from, to);
    if (!joined || !is_convex(*joined, normals_[facet])) return;
    loops_[a] = std::move(*joined);
    loops_[b].clear();
    joined_.join(b, a);
  }

  std::vector<Loop> take() {
    std::erase_if(loops_, [](const Loop& loop) { return loop.empty(); });
    return std::move(loops_);
  }

 private:
  Vec3 at(uint32_t corner) const { return points_[corner]; }

  /// `a` runs from `from` to `to`, and `b` back. None if they do so no more.
  static std::optional<Loop> united(const Loop& a, const Loop& b, uint32_t from, uint32_t to) {
    const size_t i = size_t(std::find(a.begin(), a.end(), from) - a.begin());
    const size_t j = size_t(std::find(b.begin(), b.end(), to) - b.begin());
    if (i == a.size() || j == b.size()) return std::nullopt;
    if (a[(i + 1) % a.size()] != to || b[(j + 1) % b.size()] != from) return std::nullopt;
    Loop loop;
    for (size_t k = 1; k <= a.size(); ++k) loop.push_back(a[(i + k) % a.size()]);
    for (size_t k = 2; k < b.size(); ++k) loop.push_back(b[(j + k) % b.size()]);
    // Where they share more edges than one, the loop runs there and back.
    for (size_t k = 0; loop.size() > 2 && k < loop.size();) {
      const size_t n = loop.size(), after = (k + 1) % n, last = (k + n - 1) % n;
      if (loop[last] != loop[after]) {
        ++k;
        continue;
      }
      loop.erase(loop.begin() + std::ptrdiff_t(std::max(k, after)));
      loop.erase(loop.begin() + std::ptrdiff_t(std::min(k, after)));
      k = 0;
    }
    return loop;
  }

  bool is_convex(const Loop& loop, Vec3 normal) const {
    // Rounding may bend what is straight.
    constexpr double kStraight = 1e-12;
    const size_t n = loop.size();
    for (size_t k = 0; k < n; ++k) {
      const Vec3 in = at(loop[(k + 1) % n]) - at(loop[k]);
      const Vec3 out = at(loop[(k + 2) % n]) - at(loop[(k + 1) % n]);
      const double turn = dot(cross(in, out), normal), scale = length(in) * length(out);
      if (turn < -kStraight * scale) return false;
      if (turn <= kStraight * scale && dot(in, out) < 0) return false;
    }
    return n > 2;
  }

  std::span<const Vec3> points_;
  DisjointSets joined_;
  std::vector<Loop> loops_;
  std::vector<Vec3> normals_;
};

}  // namespace

std::vector<std::vector<uint32_t>> convex_pieces(
    std::span<const Vec3> points, std::span<const TriangleMesh::Triangle> triangles) {
  struct Inner {
    double length;
    uint32_t from, to, one, other;
  };
  // By facet, so that edges of several surfaces are told apart.
  std::map<std::array<uint32_t, 3>, uint32_t> halves;
  for (uint32_t i = 0; i < triangles.size(); ++i) {
    const auto& c = triangles[i].corners;
    for (size_t k = 0; k < 3; ++k)
      halves.try_emplace({triangles[i].facet, c[k], c[(k + 1) % 3]}, i);
  }
  std::vector<Inner> inner;
  for (const auto& [edge, one] : halves) {
    const auto& [facet, from, to] = edge;
    if (from > to) continue;
    const auto back = halves.find({facet, to, from});
    if (back == halves.end()) continue;
    inner.push_back({length(points[to] - points[from]), from, to, one, back->second});
  }
  std::stable_sort(inner.begin(), inner.end(),
                   [](const Inner& a, const Inner& b) { return a.length > b.length; });
  Joiner joiner(points, triangles);
  for (const Inner& edge : inner)
    joiner.join(edge.one, edge.other, triangles[edge.one].facet, edge.from, edge.to);
  return joiner.take();
}

}  // namespace whittle
