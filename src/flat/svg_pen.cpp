#include "flat/svg_pen.h"

#include <algorithm>
#include <clipper.hpp>
#include <cmath>
#include <exception>
#include <numbers>
#include <utility>

#include "base/degrees.h"

namespace whittle {
namespace {

/// OpenSCAD's, whatever $fn says.
constexpr int kCurveSteps = 20, kEllipseSteps = 40;

/// Ends that are no farther apart close a contour.
constexpr double kClosed = 0.1;

/// Strokes are made on a grid of this many steps to the unit.
constexpr double kStrokeGrid = 10'000;

/// Strokes farther out or wider than this are left out; beyond, the grid would overflow.
constexpr double kFarthest = 1e9, kWidest = 1e6;

ClipperLib::EndType end_type(SvgCap cap) {
  switch (cap) {
    case SvgCap::kButt:
      return ClipperLib::etOpenButt;
    case SvgCap::kRound:
      return ClipperLib::etOpenRound;
    case SvgCap::kSquare:
      break;
  }
  return ClipperLib::etOpenSquare;
}

/// From the direction u to v, 0 to a full turn.
double turn_between(Vec2 u, Vec2 v) {
  const double turn = std::atan2(v.y, v.x) - std::atan2(u.y, u.x);
  return turn < 0 ? turn + 2 * std::numbers::pi : turn;
}

}  // namespace

void SvgPen::add(Vec2 p) {
  at_ = p;
  if (!std::isfinite(p.x) || !std::isfinite(p.y)) return;
  if (left_ == 0) {
    is_full_ = true;
    return;
  }
  --left_;
  contour_.push_back(p);
}

void SvgPen::keep(Contour contour) {
  if (!contour.empty()) contours_.push_back(std::move(contour));
}

void SvgPen::move_to(Vec2 to) {
  keep_stroke_if_open();
  add(to);
}

void SvgPen::line_to(Vec2 to) {
  add(to);
}

void SvgPen::quadratic_to(Vec2 control, Vec2 to) {
  const Vec2 from = at_;
  for (int i = 1; i <= kCurveSteps; ++i) {
    const double t = double(i) / kCurveSteps, s = 1 - t;
    add(from * (s * s) + control * (2 * s * t) + to * (t * t));
  }
}

void SvgPen::cubic_to(Vec2 first, Vec2 second, Vec2 to) {
  const Vec2 from = at_;
  for (int i = 1; i <= kCurveSteps; ++i) {
    const double t = double(i) / kCurveSteps, s = 1 - t;
    add(from * (s * s * s) + first * (3 * s * s * t) + second * (3 * s * t * t) + to * (t * t * t));
  }
}

void SvgPen::arc_to(const Arc& arc, Vec2 to) {
  const Vec2 from = at_;
  double rx = std::fabs(arc.radii.x), ry = std::fabs(arc.radii.y);
  if (from == to) return;
  if (rx == 0 || ry == 0) return line_to(to);
  const double cosine = cos_degrees(arc.turn_degrees), sine = sin_degrees(arc.turn_degrees);
  // In the axes of the ellipse, from the middle between the ends.
  const Vec2 half = (from - to) * 0.5;
  const Vec2 p{cosine * half.x + sine * half.y, cosine * half.y - sine * half.x};
  // The terms stand as the appendix has them: the number of steps may hang on a rounding.
  const double too_short = p.x * p.x / (rx * rx) + p.y * p.y / (ry * ry);
  if (too_short > 1) {
    rx *= std::sqrt(too_short);
    ry *= std::sqrt(too_short);
  }
  const double rest = rx * rx * ry * ry - rx * rx * p.y * p.y - ry * ry * p.x * p.x;
  const double across = rx * rx * p.y * p.y + ry * ry * p.x * p.x;
  const double side =
      (arc.is_large == arc.is_positive ? -1 : 1) * std::sqrt(std::max(rest, 0.0) / across);
  const Vec2 c{side * rx * p.y / ry, -side * ry * p.x / rx};
  const Vec2 begin{(p.x - c.x) / rx, (p.y - c.y) / ry}, end{(-p.x - c.x) / rx, (-p.y - c.y) / ry};
  const Vec2 center =
      Vec2{cosine * c.x - sine * c.y, sine * c.x + cosine * c.y} + (from + to) * 0.5;
  double turn = turn_between(begin, end);
  if (!arc.is_positive) turn -= 2 * std::numbers::pi;
  if (!std::isfinite(turn + center.x + center.y)) return line_to(to);
  const double start = turn_between({1, 0}, begin);
  const int steps = int(std::fabs(turn) * 10 / std::numbers::pi + 4);
  for (int i = 1; i < steps; ++i) {
    const double phi = start + turn * i / steps;
    const double x = rx * std::cos(phi), y = ry * std::sin(phi);
    add(center + Vec2{cosine * x - sine * y, sine * x + cosine * y});
  }
  add(to);
}

void SvgPen::close() {
  if (!contour_.empty()) at_ = contour_.front();
  keep(std::exchange(contour_, {}));
  was_closed_ = true;
}

void SvgPen::end_path() {
  if (!was_closed_) keep_stroke_if_open();
  keep(std::exchange(contour_, {}));
  was_closed_ = false;
}

void SvgPen::end_line() {
  keep_stroke();
}

void SvgPen::ellipse(Vec2 center, Vec2 radii) {
  for (int i = 1; i <= kEllipseSteps; ++i) {
    const double angle = i * (2 * std::numbers::pi / kEllipseSteps);
    add({center.x + radii.x * std::sin(angle), center.y + radii.y * std::cos(angle)});
  }
  keep(std::exchange(contour_, {}));
}

void SvgPen::keep_stroke_if_open() {
  if (contour_.empty()) return;
  const Vec2 gap = contour_.front() - contour_.back();
  if (std::hypot(gap.x, gap.y) > kClosed) return keep_stroke();
  keep(std::exchange(contour_, {}));
}

void SvgPen::keep_stroke() {
  const Contour line = std::exchange(contour_, {});
  if (line.empty() || is_full_ || !(stroke_.width < kWidest)) return;
  ClipperLib::Path path;
  path.reserve(line.size());
  for (const Vec2 p : line) {
    if (std::fabs(p.x) > kFarthest || std::fabs(p.y) > kFarthest) return;
    path.emplace_back(ClipperLib::cInt(p.x * kStrokeGrid), ClipperLib::cInt(p.y * kStrokeGrid));
  }
  ClipperLib::Paths outlines;
  try {
    ClipperLib::ClipperOffset offset;
    offset.AddPath(path, ClipperLib::jtMiter, end_type(stroke_.cap));
    offset.Execute(outlines, stroke_.width * kStrokeGrid / 2);
  } catch (const std::exception&) {
    return;
  }
  for (const ClipperLib::Path& outline : outlines) {
    for (const ClipperLib::IntPoint& p : outline)
      add({double(p.X) / kStrokeGrid, double(p.Y) / kStrokeGrid});
    keep(std::exchange(contour_, {}));
  }
}

}  // namespace whittle
