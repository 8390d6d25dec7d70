#include "flat/sweep_work.h"

#include <algorithm>
#include <random>
#include <vector>

namespace whittle {
namespace {

/// Pairs that are looked at, for each edge and in all.
constexpr uint64_t kSamplesOfEdge = 16, kMostSamples = 2'000'000;

/// Steps for each crossing.
constexpr uint64_t kCrossing = 2'500;

/// Fewer crossings are chance.
constexpr uint64_t kFewestHits = 4;

struct Edge {
  Vec2 a, b;
};

/// On either side of its line; on the line is neither.
bool are_apart(const Edge& e, Vec2 p, Vec2 q) {
  const double at_p = cross(e.b - e.a, p - e.a), at_q = cross(e.b - e.a, q - e.a);
  return (at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0);
}

bool do_cross(const Edge& e, const Edge& f) {
  return are_apart(e, f.a, f.b) && are_apart(f, e.a, e.b);
}

bool are_level(const Edge& e, const Edge& f) {
  return std::max(std::min(e.a.y, e.b.y), std::min(f.a.y, f.b.y)) <
         std::min(std::max(e.a.y, e.b.y), std::max(f.a.y, f.b.y));
}

/// What was found among some pairs.
struct Found {
  uint64_t level = 0, crossings = 0;

  void look_at(const Edge& e, const Edge& f) {
    if (are_level(e, f)) ++level;
    if (do_cross(e, f)) ++crossings;
  }
};

}  // namespace

uint64_t estimate_sweep_work(std::span<const Contour> contours) {
  std::vector<Edge> edges;
  for (const Contour& contour : contours)
    for (size_t i = 0; i < contour.size(); ++i)
      edges.push_back({contour[i], contour[(i + 1) % contour.size()]});
  if (edges.empty()) return 0;
  const uint64_t count = edges.size(), pairs = count * (count - 1) / 2;
  const uint64_t samples = std::min(kSamplesOfEdge * count, kMostSamples);
  Found found;
  if (pairs <= samples) {
    for (size_t i = 0; i < count; ++i)
      for (size_t k = 0; k < i; ++k) found.look_at(edges[i], edges[k]);
    return found.level + kCrossing * found.crossings;
  }
  std::minstd_rand random;  // of the same seed always
  for (uint64_t i = 0; i < samples; ++i) {
    const uint64_t first = random() % count, second = random() % count;
    if (first != second) found.look_at(edges[first], edges[second]);
  }
  if (found.crossings < kFewestHits) found.crossings = 0;
  const double whole = double(pairs) / double(samples);
  return uint64_t(whole * double(found.level + kCrossing * found.crossings));
}

}  // namespace whittle
