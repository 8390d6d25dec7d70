#include "evaluate/revolution.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "evaluate/extrusions.h"
#include "flat/grid.h"
#include "model/facets.h"

namespace whittle {
namespace {

/// A side of the profile that is not level, from its lower to its upper end.
struct Side {
  Vec2 lower, upper;
  double x_at(double y) const {
    if (y <= lower.y) return lower.x;
    if (y >= upper.y) return upper.x;
    const double t = (y - lower.y) / (upper.y - lower.y);
    return lower.x + (upper.x - lower.x) * t;
  }
};

/// Between two neighbouring sides, since some height.
struct Span {
  size_t inner, outer;
  double since;
  bool operator==(const Span& o) const { return inner == o.inner && outer == o.outer; }
};

Ring ring_of(const Side& inner, const Side& outer, double z0, double z1) {
  Ring ring;
  ring.z = z0;
  ring.outer = {.h = z1 - z0, .r1 = outer.x_at(z0), .r2 = outer.x_at(z1)};
  ring.inner = {.h = z1 - z0, .r1 = inner.x_at(z0), .r2 = inner.x_at(z1)};
  return ring;
}

/// Heights that differ by no more than this are one, as a share of the largest coordinate: a few
/// steps of the grid that corners are rounded to. A side between two of them would be a cone that
/// is all but a plane, around a film.
constexpr double kLevel = 0x1p-31;

/// The heights of all corners in order, each the first of those that are one.
std::vector<double> levels_of(const Polygons& profile) {
  std::vector<double> heights;
  for (const Contour& contour : profile.contours)
    for (const Vec2 p : contour) heights.push_back(p.y);
  std::sort(heights.begin(), heights.end());
  const double apart = kLevel * reach(profile.contours);
  std::vector<double> levels;
  for (const double y : heights)
    if (levels.empty() || y - levels.back() > apart) levels.push_back(y);
  return levels;
}

std::vector<Side> sides_of(const Polygons& profile, const std::vector<double>& levels) {
  const auto level = [&](Vec2 p) {
    return Vec2{p.x, *std::prev(std::upper_bound(levels.begin(), levels.end(), p.y))};
  };
  std::vector<Side> sides;
  for (const Contour& contour : profile.contours) {
    for (size_t i = 0; i < contour.size(); ++i) {
      const Vec2 a = level(contour[i]), b = level(contour[(i + 1) % contour.size()]);
      if (a.y < b.y) sides.push_back({a, b});
      if (b.y < a.y) sides.push_back({b, a});
    }
  }
  std::sort(sides.begin(), sides.end(),
            [](const Side& a, const Side& b) { return a.lower.y < b.lower.y; });
  return sides;
}

}  // namespace

std::vector<Ring> rings(const Polygons& profile, Budget& budget) {
  const std::vector<double> heights = levels_of(profile);
  const std::vector<Side> sides = sides_of(profile, heights);

  std::vector<Ring> rings;
  std::vector<size_t> active;
  std::vector<Span> spans, now;
  size_t next = 0;
  const auto finish = [&](const std::vector<Span>& which, double z) {
    for (const Span& span : which) {
      rings.push_back(ring_of(sides[span.inner], sides[span.outer], span.since, z));
    }
  };
  for (size_t k = 0; k + 1 < heights.size(); ++k) {
    const double z = heights[k], middle = 0.5 * (z + heights[k + 1]);
    std::erase_if(active, [&](size_t s) { return sides[s].upper.y <= z; });
    for (; next < sides.size() && sides[next].lower.y <= z; ++next) active.push_back(next);
    if (!budget.work(active.size())) return {};
    std::sort(active.begin(), active.end(), [&](size_t a, size_t b) {
      const double xa = sides[a].x_at(middle), xb = sides[b].x_at(middle);
      return xa != xb ? xa < xb : a < b;
    });
    now.clear();
    for (size_t i = 0; i + 1 < active.size(); i += 2) {
      now.push_back({active[i], active[i + 1], z});
    }
    // What goes on between the same sides stays open.
    std::vector<Span> ended;
    const auto less = [](const Span& a, const Span& b) {
      return std::pair(a.inner, a.outer) < std::pair(b.inner, b.outer);
    };
    std::sort(now.begin(), now.end(), less);
    for (const Span& span : spans) {
      const auto same = std::lower_bound(now.begin(), now.end(), span, less);
      if (same != now.end() && *same == span) {
        same->since = span.since;
      } else {
        ended.push_back(span);
      }
    }
    finish(ended, z);
    std::swap(spans, now);
  }
  if (!heights.empty()) finish(spans, heights.back());
  return rings;
}

std::vector<Polyhedron> wedges(const RotateExtrude& how, double radius, double z0, double z1) {
  const double margin = 0.1 * (radius + (z1 - z0));
  const double from = std::fmin(how.start_degrees, how.start_degrees + how.angle_degrees);
  const double whole = std::fabs(how.angle_degrees);
  const int parts = whole > 180 ? 2 : 1;
  std::vector<Polyhedron> all;
  for (int part = 0; part < parts; ++part) {
    const double start = from + whole * part / parts, turn = whole / parts;
    // Chords of at most 60 degrees stay outside of the radius.
    const int steps = int(std::ceil(turn / 60));
    Contour outline{{0, 0}};
    for (int k = 0; k <= steps; ++k) {
      const double degrees = start + turn * k / steps;
      outline.push_back(Vec2{cos_degrees(degrees), sin_degrees(degrees)} * (2 * radius));
    }
    all.push_back(prism(outline, z0 - margin, z1 + margin));
  }
  return all;
}

}  // namespace whittle
