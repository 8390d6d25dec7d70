#include "flat/grid.h"

#include <cmath>
#include <cstdint>
#include <exception>

#include "flat/snap.h"

namespace whittle {

namespace {

/// Clipper keeps integers below 2^62, but finds where edges cross in doubles. With 34 bits that is
/// right to a step or two, and the corners of an offset's miters still fit.
constexpr int kGridBits = 34;

}  // namespace

size_t Grid::Hash::operator()(const ClipperLib::IntPoint& p) const {
  uint64_t h = uint64_t(p.X) * 0x9e3779b97f4a7c15u ^ uint64_t(p.Y);
  h = (h ^ (h >> 32)) * 0xd6e8feb86659fd93u;
  return size_t(h ^ (h >> 32));
}

Grid::Grid(double reach) : exponent_(reach > 0 ? kGridBits - 1 - std::ilogb(reach) : 0) {}

ClipperLib::Path Grid::to_grid(const Contour& contour) {
  ClipperLib::Path path;
  path.reserve(contour.size());
  constexpr double kLimit = double(int64_t{1} << (kGridBits + 1));
  for (const Vec2 corner : contour) {
    const Vec2 scaled = {std::ldexp(corner.x, exponent_), std::ldexp(corner.y, exponent_)};
    if (!(std::abs(scaled.x) <= kLimit && std::abs(scaled.y) <= kLimit)) continue;
    path.emplace_back(ClipperLib::cInt(std::llround(scaled.x)),
                      ClipperLib::cInt(std::llround(scaled.y)));
    written_.emplace(path.back(), corner);
  }
  return path;
}

ClipperLib::Paths Grid::to_grid(const Polygons& polygons) {
  ClipperLib::Paths paths;
  paths.reserve(polygons.contours.size());
  for (const Contour& contour : polygons.contours) paths.push_back(to_grid(contour));
  return paths;
}

double Grid::steps(double length) const {
  return std::ldexp(length, exponent_);
}

Vec2 Grid::place(const ClipperLib::IntPoint& point) const {
  return {std::ldexp(double(point.X), -exponent_), std::ldexp(double(point.Y), -exponent_)};
}

Polygons Grid::from_grid(ClipperLib::Paths rough) const {
  const ClipperLib::Paths paths = snapped(
      std::move(rough), [&](const ClipperLib::IntPoint& p) { return written_.contains(p); });
  Polygons polygons;
  polygons.contours.reserve(paths.size());
  for (const ClipperLib::Path& path : paths) {
    if (path.size() < 3) continue;
    Contour& contour = polygons.contours.emplace_back();
    contour.reserve(path.size());
    for (const ClipperLib::IntPoint& point : path) {
      const auto found = written_.find(point);
      contour.push_back(found == written_.end() ? place(point) : found->second);
    }
  }
  return polygons;
}

double reach(std::span<const Contour> contours) {
  double most = 0;
  for (const Contour& contour : contours)
    for (const Vec2 corner : contour)
      if (is_finite(corner)) most = std::max({most, std::abs(corner.x), std::abs(corner.y)});
  return most;
}

double reach(std::span<const Polygons> operands) {
  double most = 0;
  for (const Polygons& operand : operands) most = std::max(most, reach(operand.contours));
  return most;
}

ClipperLib::Paths clip(ClipperLib::ClipType operation, const ClipperLib::Paths& subject,
                       const ClipperLib::Paths& clips, ClipperLib::PolyFillType rule) {
  ClipperLib::Paths result;
  // Clipper throws where its own bookkeeping fails.
  try {
    ClipperLib::Clipper clipper;
    clipper.AddPaths(subject, ClipperLib::ptSubject, true);
    clipper.AddPaths(clips, ClipperLib::ptClip, true);
    if (!clipper.Execute(operation, result, rule, rule)) result.clear();
  } catch (const std::exception&) {
    result.clear();
  }
  return result;
}

ClipperLib::Paths sanitized(const ClipperLib::Paths& paths) {
  return clip(ClipperLib::ctUnion, paths, {}, ClipperLib::pftEvenOdd);
}

}  // namespace whittle
