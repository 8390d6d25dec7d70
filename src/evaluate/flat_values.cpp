#include "evaluate/flat_values.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "base/printable.h"
#include "shape/fragments.h"

namespace whittle {
namespace {

double turn(Vec2 a, Vec2 b, Vec2 c) {
  return cross(b - a, c - b);
}

/// How many full turns all corners of a contour make together, each by its size.
double turns(const Contour& contour) {
  double sum = 0;
  const size_t n = contour.size();
  for (size_t i = 0; i < n; ++i) {
    const Vec2 in = contour[(i + 1) % n] - contour[i];
    const Vec2 out = contour[(i + 2) % n] - contour[(i + 1) % n];
    sum += std::fabs(std::atan2(cross(in, out), dot(in, out)));
  }
  return sum / (2 * std::numbers::pi);
}

}  // namespace

Affine flat_map(const Affine& map) {
  return {.row = {{map.row[0].x, map.row[0].y, 0}, {map.row[1].x, map.row[1].y, 0}, {0, 0, 1}},
          .translation = {map.translation.x, map.translation.y, 0}};
}

Polygons transformed(const Affine& map, Polygons polygons) {
  if (map == Affine{}) return polygons;
  const bool mirrors = map.row[0].x * map.row[1].y < map.row[0].y * map.row[1].x;
  for (Contour& contour : polygons.contours) {
    for (Vec2& p : contour) {
      const Vec3 q = map.point({p.x, p.y, 0});
      p = {q.x, q.y};
    }
    if (mirrors) std::reverse(contour.begin(), contour.end());
  }
  return polygons;
}

bool is_measurable(const Polygons& polygons) {
  constexpr double kFarthest = 1e75;
  for (const Contour& contour : polygons.contours)
    for (const Vec2 p : contour)
      if (!(std::fabs(p.x) <= kFarthest && std::fabs(p.y) <= kFarthest)) return false;
  return !polygons.is_empty();
}

uint64_t corner_count(const Polygons& polygons) {
  uint64_t count = 0;
  for (const Contour& contour : polygons.contours) count += contour.size();
  return count;
}

uint64_t corner_count(std::span<const Polygons> polygons) {
  uint64_t count = 0;
  for (const Polygons& p : polygons) count += corner_count(p);
  return count;
}

std::optional<Contour> convex_outline(const Polygons& polygons) {
  if (polygons.contours.size() != 1) return std::nullopt;
  Contour outline;
  for (const Vec2 p : polygons.contours.front()) {
    if (outline.empty() || p != outline.back()) outline.push_back(p);
  }
  while (outline.size() > 1 && outline.front() == outline.back()) outline.pop_back();
  const size_t n = outline.size();
  if (n < 3) return std::nullopt;
  bool has_left = false, has_right = false;
  // A contour that runs around more than once turns right nowhere, but changes between up and down
  // more than twice.
  int changes = 0;
  const auto is_up = [&](size_t i) {
    const Vec2 d = outline[(i + 1) % n] - outline[i % n];
    return d.y > 0 || (d.y == 0 && d.x > 0);
  };
  for (size_t i = 0; i < n; ++i) {
    const double t = turn(outline[i], outline[(i + 1) % n], outline[(i + 2) % n]);
    const Vec2 in = outline[(i + 1) % n] - outline[i];
    const Vec2 out = outline[(i + 2) % n] - outline[(i + 1) % n];
    // One that runs back on itself encloses nothing there.
    if (t == 0 && dot(in, out) < 0) return std::nullopt;
    has_left |= t > 0;
    has_right |= t < 0;
    changes += is_up(i) != is_up(i + 1);
  }
  if (has_left == has_right || changes > 2) return std::nullopt;
  if (has_right) std::reverse(outline.begin(), outline.end());
  return outline;
}

int fragment_count(double r, FragmentSettings settings, Curves curves) {
  if (curves == Curves::kOpenscad2021 && settings.fn > 0) {
    settings.fn = std::floor(std::fmax(settings.fn, 3));
  }
  return fragments(r, settings);
}

Polygons FlatLeaves::operator()(const Square& square) const {
  if (!is_size(square.size.x) || !is_size(square.size.y)) return {};
  const Vec2 lo = square.center ? square.size * -0.5 : Vec2{};
  const Vec2 hi = square.center ? square.size * 0.5 : square.size;
  return {{{lo, {hi.x, lo.y}, hi, {lo.x, hi.y}}}};
}

Polygons FlatLeaves::operator()(const Circle& c) const {
  if (!is_size(c.r)) return {};
  const int n = fragment_count(c.r, c.fragments, curves_);
  if (!budget_.work(uint64_t(n)) || !budget_.spend(uint64_t(n))) return {};
  return {{circle(c.r, n)}};
}

Polygons FlatLeaves::operator()(const Polygon& polygon) const {
  std::vector<Contour> contours;
  if (!polygon.paths) {
    contours.push_back(polygon.points);
  } else {
    for (const std::vector<uint32_t>& path : *polygon.paths) {
      Contour& contour = contours.emplace_back();
      for (const uint32_t i : path) contour.push_back(polygon.points[i]);
    }
  }
  std::erase_if(contours, [](const Contour& contour) { return contour.size() < 3; });
  if (contours.empty()) return {};
  Polygons as_written{std::move(contours)};
  if (std::optional<Contour> outline = convex_outline(as_written)) return {{std::move(*outline)}};
  if (!budget_.work(corner_count(as_written)) || !budget_.sweep(as_written.contours)) return {};
  return even_odd(as_written.contours);
}

Polygons FlatLeaves::polygons(const Leaf& leaf, SourceLocation where) {
  if (const auto* const square = std::get_if<Square>(&leaf)) return (*this)(*square);
  if (const auto* const circle = std::get_if<Circle>(&leaf)) return (*this)(*circle);
  if (const auto* const polygon = std::get_if<Polygon>(&leaf)) return (*this)(*polygon);
  if (const auto* const import = std::get_if<Import>(&leaf)) return files_.flat(*import, where);
  const auto* const text = std::get_if<Text>(&leaf);
  if (!text || !is_size(text->size) || !std::isfinite(text->spacing)) return {};
  // About the corners of a letter at OpenSCAD's finest.
  if (!budget_.work(200 * text->text.size())) return {};
  return this->text(*text, where);
}

Polygons FlatLeaves::text(const Text& text, SourceLocation where) {
  const TextOutline outline = outline_text(text, fonts_);
  if (outline.no_fonts) {
    const std::string kind = "no font is found; text is left out";
    warnings_.add_unsupported(kind, where, kind, kind);
  }
  if (outline.replacement)
    warnings_.add("a font is not there", where,
                  fmt::format("the font {} is not there; {} stands for it", printable(text.font),
                              printable(*outline.replacement)));
  std::vector<Contour> contours;
  for (const std::vector<Contour>& glyph : outline.glyphs)
    contours.insert(contours.end(), glyph.begin(), glyph.end());
  if (!budget_.sweep(contours)) return {};
  return text_polygons(outline);
}

Polygons offset_of(const Polygons& polygons, const Offset& how, Curves curves, Budget& budget) {
  if (!std::isfinite(how.delta) || polygons.is_empty()) return {};
  if (how.delta == 0) return polygons;
  const int n = fragment_count(std::fabs(how.delta), how.fragments, curves);
  double corners = 0;
  for (const Contour& contour : polygons.contours) {
    corners += double(contour.size());
    if (how.round) corners += n * turns(contour);
  }
  const auto whole = uint64_t(std::fmin(corners, 1e18));
  if (!budget.work(whole) || (how.round && !budget.spend(whole))) return {};
  const Join join = how.round ? Join::kRound : how.chamfer ? Join::kSquare : Join::kMiter;
  return offset(polygons, how.delta, join, n);
}

Affine resize_map(const Resize& how, Vec3 size) {
  int largest = 0;
  for (int axis = 1; axis < 3; ++axis) {
    if (how.size[axis] > how.size[largest]) largest = axis;
  }
  Vec3 scale{1, 1, 1};
  for (int axis = 0; axis < 3; ++axis) {
    if (how.size[axis] > 0 && size[axis] > 0) scale[axis] = how.size[axis] / size[axis];
  }
  const double proportion = scale[largest];
  for (int axis = 0; axis < 3; ++axis) {
    if (how.automatic[size_t(axis)] && !(how.size[axis] > 0)) scale[axis] = proportion;
  }
  return scaling(scale);
}

}  // namespace whittle
