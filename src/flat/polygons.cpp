#include "flat/polygons.h"

#include <algorithm>
#include <cmath>
#include <exception>

#include "base/degrees.h"
#include "flat/grid.h"
#include "shape/fragments.h"

namespace whittle {

namespace {

using ClipperLib::Paths;

/// The operands on one grid, each without crossings and with its outer contours counter-clockwise.
std::vector<Paths> on_grid(Grid& grid, std::span<const Polygons> operands) {
  std::vector<Paths> all;
  all.reserve(operands.size());
  for (const Polygons& operand : operands) all.push_back(sanitized(grid.to_grid(operand)));
  return all;
}

Paths on_grid(Grid& grid, std::span<const Contour> contours) {
  Paths paths;
  paths.reserve(contours.size());
  for (const Contour& contour : contours) paths.push_back(grid.to_grid(contour));
  return paths;
}

Paths joined(std::span<const Paths> operands) {
  Paths all;
  for (const Paths& paths : operands) all.insert(all.end(), paths.begin(), paths.end());
  return all;
}

/// How far an arc of `fragments` to the circle stays inside it, for a radius of 1.
double arc_tolerance(int fragments) {
  return 1 - cos_degrees(180.0 / std::clamp(fragments, 3, kMaxFacets));
}

}  // namespace

Rect bounds(const Polygons& polygons) {
  Rect box{polygons.contours.front().front(), polygons.contours.front().front()};
  for (const Contour& contour : polygons.contours) {
    for (const Vec2 corner : contour) {
      box.lo = {std::min(box.lo.x, corner.x), std::min(box.lo.y, corner.y)};
      box.hi = {std::max(box.hi.x, corner.x), std::max(box.hi.y, corner.y)};
    }
  }
  return box;
}

Polygons even_odd(std::span<const Contour> contours) {
  Grid grid(reach(contours));
  return grid.from_grid(sanitized(on_grid(grid, contours)));
}

Polygons nonzero(std::span<const Contour> contours) {
  Grid grid(reach(contours));
  return grid.from_grid(
      clip(ClipperLib::ctUnion, on_grid(grid, contours), {}, ClipperLib::pftNonZero));
}

Polygons unite(std::span<const Polygons> operands) {
  Grid grid(reach(operands));
  const std::vector<Paths> paths = on_grid(grid, operands);
  if (paths.size() == 1) return grid.from_grid(paths.front());
  return grid.from_grid(clip(ClipperLib::ctUnion, joined(paths), {}, ClipperLib::pftNonZero));
}

Polygons intersect(std::span<const Polygons> operands) {
  if (operands.empty()) return {};
  Grid grid(reach(operands));
  const std::vector<Paths> paths = on_grid(grid, operands);
  Paths common = paths.front();
  for (size_t i = 1; i < paths.size() && !common.empty(); ++i)
    common = clip(ClipperLib::ctIntersection, common, paths[i], ClipperLib::pftNonZero);
  return grid.from_grid(common);
}

Polygons subtract(std::span<const Polygons> operands) {
  if (operands.empty()) return {};
  Grid grid(reach(operands));
  const std::vector<Paths> paths = on_grid(grid, operands);
  if (paths.size() == 1) return grid.from_grid(paths.front());
  return grid.from_grid(clip(ClipperLib::ctDifference, paths.front(),
                             joined(std::span(paths).subspan(1)), ClipperLib::pftNonZero));
}

Polygons offset(const Polygons& polygons, double delta, Join join, int fragments) {
  if (!std::isfinite(delta)) return {};
  Grid grid(reach(std::span(&polygons, 1)) + std::abs(delta));
  const Paths paths = sanitized(grid.to_grid(polygons));
  const double steps = grid.steps(delta);
  if (std::abs(steps) < 0.5) return grid.from_grid(paths);
  constexpr double kMiterLimit = 1e6;
  const ClipperLib::JoinType type = join == Join::kRound   ? ClipperLib::jtRound
                                    : join == Join::kMiter ? ClipperLib::jtMiter
                                                           : ClipperLib::jtSquare;
  Paths moved;
  try {
    ClipperLib::ClipperOffset clipper(kMiterLimit, std::abs(steps) * arc_tolerance(fragments));
    clipper.AddPaths(paths, type, ClipperLib::etClosedPolygon);
    clipper.Execute(moved, steps);
  } catch (const std::exception&) {
    moved.clear();
  }
  return grid.from_grid(moved);
}

Polygons filled(const Polygons& polygons) {
  Grid grid(reach(std::span(&polygons, 1)));
  Paths outer;
  for (ClipperLib::Path& path : sanitized(grid.to_grid(polygons)))
    if (ClipperLib::Orientation(path)) outer.push_back(std::move(path));
  return grid.from_grid(clip(ClipperLib::ctUnion, outer, {}, ClipperLib::pftNonZero));
}

Contour circle(double r, int n) {
  Contour corners;
  corners.reserve(size_t(n));
  for (int k = 0; k < n; ++k)
    corners.push_back({r * cos_degrees(360.0 * k / n), r * sin_degrees(360.0 * k / n)});
  return corners;
}

}  // namespace whittle
