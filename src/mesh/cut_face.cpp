#include "mesh/cut_face.h"

#include <algorithm>
#include <cmath>

#include "flat/triangulation.h"

namespace whittle {
namespace {

struct Corner {
  Vec2 at;
  uint32_t number;
};

/// The loop seen along its normal (Newell's: the sum of its areas along the axes),
/// counter-clockwise.
std::vector<Corner> flattened(std::span<const Vec3> points, std::span<const uint32_t> loop) {
  Vec3 normal;
  for (size_t i = 0; i < loop.size(); ++i) {
    const Vec3 a = points[loop[i]] - points[loop[0]],
               b = points[loop[(i + 1) % loop.size()]] - points[loop[0]];
    normal += cross(a, b);
  }
  const Vec3 size = abs(normal);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const double sign = normal[axis] < 0 ? -1 : 1;
  std::vector<Corner> flat;
  flat.reserve(loop.size());
  for (const uint32_t corner : loop)
    flat.push_back({{sign * points[corner][u], points[corner][v]}, corner});
  return flat;
}

double area(Vec2 a, Vec2 b, Vec2 c) {
  return cross(b - a, c - a);
}

/// Whether p lies in the triangle, its sides included but for its corners.
bool holds(Vec2 a, Vec2 b, Vec2 c, Vec2 p) {
  if (p == a || p == b || p == c) return false;
  return area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0;
}

using Triangles = std::vector<std::array<uint32_t, 3>>;

/// Ear clipping (Meisters 1975). The corner that is cut off is the best shaped one of those that
/// are ears; where there is none, because the loop crosses itself, any.
void clip_ears(std::vector<Corner> rest, Triangles& out) {
  while (rest.size() > 3) {
    const size_t n = rest.size();
    size_t best = 0;
    double best_worth = -1;
    for (size_t i = 0; i < n; ++i) {
      const Corner &a = rest[(i + n - 1) % n], &b = rest[i], &c = rest[(i + 1) % n];
      const double twice = area(a.at, b.at, c.at);
      if (!(twice >= 0)) continue;
      const double longest =
          std::fmax(length(c.at - a.at), std::fmax(length(b.at - a.at), length(c.at - b.at)));
      const double worth = longest > 0 ? twice / (longest * longest) : 0;
      if (worth <= best_worth) continue;
      bool is_ear = true;
      for (size_t k = 0; k < n && is_ear; ++k)
        if (k != i && k != (i + 1) % n && k != (i + n - 1) % n)
          is_ear = !holds(a.at, b.at, c.at, rest[k].at);
      if (!is_ear) continue;
      best = i;
      best_worth = worth;
    }
    out.push_back(
        {rest[(best + n - 1) % n].number, rest[best].number, rest[(best + 1) % n].number});
    rest.erase(rest.begin() + std::ptrdiff_t(best));
  }
  out.push_back({rest[0].number, rest[1].number, rest[2].number});
}

/// By a sweep. False if different corners are seen at one place, where it knows but one.
bool sweep(const std::vector<Corner>& loop, Triangles& out) {
  Polygons polygons{{Contour{}}};
  for (const Corner& corner : loop) polygons.contours[0].push_back(corner.at);
  const WeldedPolygons welded = weld(polygons);
  constexpr uint32_t kNone = UINT32_MAX;
  std::vector<uint32_t> number(welded.points.size(), kNone);
  for (const Corner& corner : loop) {
    const auto found = std::ranges::lower_bound(welded.points, corner.at, [](Vec2 a, Vec2 b) {
      return a.x < b.x || (a.x == b.x && a.y < b.y);
    });
    uint32_t& own = number[size_t(found - welded.points.begin())];
    if (own != kNone && own != corner.number) return false;
    own = corner.number;
  }
  for (const auto& [a, b, c] : triangulate(welded))
    out.push_back({number[a], number[b], number[c]});
  return true;
}

}  // namespace

void cut_face(std::span<const Vec3> points, std::span<const uint32_t> loop, Triangles& out) {
  if (loop.size() < 3) return;
  if (loop.size() == 3) {
    out.push_back({loop[0], loop[1], loop[2]});
    return;
  }
  // Clipping the best of all ears takes the third power of the corners.
  constexpr size_t kFewCorners = 32;
  std::vector<Corner> flat = flattened(points, loop);
  if (loop.size() <= kFewCorners)
    clip_ears(std::move(flat), out);
  else if (!sweep(flat, out))
    for (size_t i = 2; i < loop.size(); ++i) out.push_back({loop[0], loop[i - 1], loop[i]});
}

}  // namespace whittle
