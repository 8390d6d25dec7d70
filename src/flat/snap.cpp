#include "flat/snap.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "flat/point_tree.h"
#include "flat/regularize.h"

namespace whittle {

namespace {

using ClipperLib::cInt;
using ClipperLib::IntPoint;
using ClipperLib::Path;
using ClipperLib::Paths;

/// In steps. Corners may come to stand 0.71 away from their places on the grid, so edges and
/// corners that are farther than twice that keep their sides.
constexpr double kCornersMeet = 1.5;
constexpr double kEdgeMeets = 2;

/// Edges that go through a corner come nearer to others; three rounds are seen in random shapes.
constexpr int kMostRounds = 8;

Vec2 place(const IntPoint& p) {
  return {double(p.X), double(p.Y)};
}

struct Hash {
  size_t operator()(const IntPoint& p) const {
    const uint64_t h = (uint64_t(p.X) * 0x9e3779b97f4a7c15u) ^ uint64_t(p.Y);
    return size_t((h ^ (h >> 31)) * 0xd6e8feb86659fd93u);
  }
};

/// Corners that are near to one another have one place.
class MeetingPlaces {
 public:
  void add(const IntPoint& p) { places_.try_emplace(p, nearest(p)); }
  IntPoint operator[](const IntPoint& p) const { return places_.at(p); }

 private:
  static constexpr cInt kCell = 2;

  static cInt cell(cInt x) { return x >= 0 ? x / kCell : -((kCell - 1 - x) / kCell); }

  /// An earlier place that is near; if there is none, this is a place.
  IntPoint nearest(const IntPoint& p) {
    for (cInt dx = -1; dx <= 1; ++dx) {
      for (cInt dy = -1; dy <= 1; ++dy) {
        const auto found = cells_.find({cell(p.X) + dx, cell(p.Y) + dy});
        if (found == cells_.end()) continue;
        for (const IntPoint& other : found->second)
          if (length(place(other) - place(p)) <= kCornersMeet) return other;
      }
    }
    cells_[{cell(p.X), cell(p.Y)}].push_back(p);
    return p;
  }

  std::unordered_map<IntPoint, std::vector<IntPoint>, Hash> cells_;
  std::unordered_map<IntPoint, IntPoint, Hash> places_;
};

/// Without corners that follow themselves.
Path without_repeats(Path path) {
  path.erase(std::unique(path.begin(), path.end()), path.end());
  while (path.size() > 1 && path.front() == path.back()) path.pop_back();
  return path;
}

void meet(Paths& paths, const std::function<bool(const IntPoint&)>& is_fixed) {
  MeetingPlaces places;
  for (const bool fixed : {true, false})
    for (const Path& path : paths)
      for (const IntPoint& p : path)
        if (is_fixed(p) == fixed) places.add(p);
  for (Path& path : paths) {
    bool moved = false;
    for (IntPoint& p : path) {
      const IntPoint to = places[p];
      moved |= !(to == p);
      p = to;
    }
    if (moved) path = without_repeats(std::move(path));
  }
}

/// Takes edges through the corners that they pass. Whether there were any.
bool bend(Paths& paths) {
  std::vector<Vec2> corners;
  for (const Path& path : paths)
    for (const IntPoint& p : path) corners.push_back(place(p));
  const PointTree tree(corners);
  std::vector<uint32_t> found;
  std::vector<std::pair<double, IntPoint>> between;
  bool bent = false;
  for (Path& path : paths) {
    Path result;
    result.reserve(path.size());
    for (size_t i = 0; i < path.size(); ++i) {
      const IntPoint a = path[i], b = path[(i + 1) % path.size()];
      result.push_back(a);
      tree.near_segment(place(a), place(b), kEdgeMeets, found);
      between.clear();
      for (const uint32_t number : found) {
        const IntPoint p(cInt(corners[number].x), cInt(corners[number].y));
        if (!(p == a) && !(p == b))
          between.emplace_back(dot(place(p) - place(a), place(b) - place(a)), p);
      }
      std::sort(between.begin(), between.end(), [](const auto& p, const auto& q) {
        return p.first != q.first         ? p.first < q.first
               : p.second.X != q.second.X ? p.second.X < q.second.X
                                          : p.second.Y < q.second.Y;
      });
      for (const auto& [along, p] : between)
        if (!(result.back() == p)) result.push_back(p), bent = true;
    }
    path = std::move(result);
  }
  return bent;
}

}  // namespace

Paths snapped(Paths paths, const std::function<bool(const IntPoint&)>& is_fixed) {
  meet(paths, is_fixed);
  for (int round = 0; round < kMostRounds && bend(paths); ++round) {
  }
  return regularized(std::move(paths));
}

}  // namespace whittle
