#include "measure/cut_patch.h"

#include <algorithm>
#include <cmath>

namespace whittle {

std::optional<CutPatch> CutPatch::make(const GraphPatch& surface, int axis) {
  const int k = surface.k_;
  const double half = surface.half_[k];
  const bool leaves_above = surface.high() >= half, leaves_below = surface.low() <= -half;
  if (leaves_above == leaves_below) return std::nullopt;
  // The surface in the end, about the end's middle.
  const double end = leaves_above ? half : -half;
  Vec3 middle, flat = surface.half_;
  middle[k] = end, flat[k] = 0;
  using K = Kernels<double>;
  const Quadric& f = surface.f_;
  const Quadric in_end{f.diag, f.off, K::quadric_half_gradient(f, middle),
                       K::quadric_value(f, middle)};
  const std::optional<GraphPatch> curve = GraphPatch::make(in_end, flat, axis);
  if (!curve || !curve->is_within()) return std::nullopt;
  CutPatch patch(surface, *curve);
  patch.along_ = axis;
  patch.across_ = 3 - k - axis;
  patch.end_ = end;
  // Where f in the upper end is positive, and f rises along the axis, the surface is below.
  patch.side_ = surface.sign_ * curve->sign_ * (leaves_above ? 1 : -1);
  return patch;
}

double CutPatch::curve_reach(size_t ellipse) const {
  const auto& reaches = c_.reaches_[across_ == c_.i_ ? 0 : 1];
  if (!reaches[ellipse].is_analytic) return kInfinity;
  return (std::fabs(c_.level_) + reaches[ellipse].rise) / s_.half_[along_];
}

CutPatch::Bound CutPatch::bound(const GaussTable& gauss, size_t n) const {
  Bound bound;
  bound.points = n;
  double along = kInfinity, across = kInfinity;
  const double height = std::fabs(s_.level_ - end_);
  for (size_t e = 0; e < kEllipses.size(); ++e) {
    const double r = ellipse_reach(kEllipses[e]);
    // Lines are no longer than the box, so coordinates on them no larger than on its axis.
    if (const GraphPatch::Reach on_line = reach(r, 1); on_line.is_analytic) {
      const double error = gauss.error(n, e) * on_line.rise;
      if (error < along) along = error, bound.ellipses[0] = e;
    }
    const double curve = curve_reach(e);
    if (!(curve < kInfinity)) continue;
    const GraphPatch::Reach beside = reach(std::max(1.0, curve), r);
    if (!beside.is_analytic) continue;
    const double error = gauss.error(n, e) * (1 + curve) * (height + beside.rise);
    if (error < across) across = error, bound.ellipses[1] = e;
  }
  bound.worst_axis = along >= across ? along_ : across_;
  // Lines have a length of 2 at most, and the weights across them that sum; of what is across, the
  // length is in the bound.
  bound.volume = s_.half_[s_.i_] * s_.half_[s_.j_] * (2 * along + across);
  return bound;
}

Moments CutPatch::moments(const GaussRule& rule) const {
  const int k = s_.k_, a = along_, b = across_;
  const double hk = s_.half_[k];
  // Below the surface, to begin with: all of the box if it leaves through the upper end, and what
  // lies between that end and the surface is taken away.
  Moments below{};
  if (end_ > 0) below = box_moments(s_.half_);
  for (size_t v = 0; v < rule.size; ++v) {
    Vec3 p;
    p[b] = rule.at[v] * s_.half_[b];
    const double curve = c_.at(p);
    const double to = side_ * s_.half_[a];
    const double half_length = std::fabs(to - curve) / 2;
    for (size_t u = 0; u < rule.size; ++u) {
      p[a] = (curve + to) / 2 + (to - curve) / 2 * rule.at[u];
      const double weight = rule.weight[u] * rule.weight[v] * half_length * s_.half_[b];
      p[k] = 0;
      const double z = s_.at(p);
      p[k] = z;
      const double height = weight * (z - end_);
      const double square = weight * (z * z - hk * hk) / 2;
      below[kVolume] += height;
      below[first_of(a)] += height * p[a];
      below[first_of(b)] += height * p[b];
      below[first_of(k)] += square;
      below[product_of(a, a)] += height * p[a] * p[a];
      below[product_of(b, b)] += height * p[b] * p[b];
      below[product_of(a, b)] += height * p[a] * p[b];
      below[product_of(a, k)] += square * p[a];
      below[product_of(b, k)] += square * p[b];
      below[product_of(k, k)] += weight * (z * z * z - end_ * end_ * end_) / 3;
      const Vec3 slope = Kernels<double>::quadric_half_gradient(s_.f_, p);
      below[kArea] += weight * length(slope) / std::fabs(slope[k]);
    }
  }
  if (s_.sign_ > 0) return below;
  Moments above = box_moments(s_.half_);
  for (size_t m = 0; m < kArea; ++m) above[m] -= below[m];
  above[kArea] = below[kArea];
  return above;
}

double CutPatch::most_lean(Vec3 way, const GraphPatch::Reach& reach) const {
  Vec3 middle;
  middle[s_.k_] = s_.level_;
  const double steep = length(Kernels<double>::quadric_half_gradient(s_.f_, middle));
  const double turn = s_.norm() * length(way);
  const double change = (2 * steep + turn) * turn, square = steep * steep;
  return change < square ? std::sqrt((square + change) / reach.least_d) : kInfinity;
}

Moments CutPatch::bounds(const GaussTable& gauss, const Bound& bound, Vec3 center) const {
  Moments sum{};
  const double base = s_.half_[s_.i_] * s_.half_[s_.j_];
  const double height = std::fabs(s_.level_ - end_);
  // Coordinates of those moduli, and how far they lead from the middle of the surface.
  const auto add = [&](double along, double across, const GraphPatch::Reach& reach, double factor) {
    Vec3 way = s_.half_;
    way[along_] *= along, way[across_] *= across;
    Vec3 far = way;
    far[s_.k_] = std::max(s_.half_[s_.k_], std::fabs(s_.level_) + reach.rise);
    const Moments part = weighted(factor * base * (height + reach.rise), center, far);
    for (size_t m = 0; m < kArea; ++m) sum[m] += part[m];
  };
  double least_along = kInfinity, least_across = kInfinity;
  for (size_t e = 0; e < kEllipses.size(); ++e) {
    const double r = ellipse_reach(kEllipses[e]), error = gauss.error(bound.points, e);
    const double curve = curve_reach(e), beside = std::max(1.0, curve);
    const auto lean = [&](double along, double across) {
      const GraphPatch::Reach its = reach(along, across);
      if (!its.is_analytic) return kInfinity;
      Vec3 way = s_.half_;
      way[along_] *= along, way[across_] *= across, way[s_.k_] = its.rise;
      return most_lean(way, its);
    };
    least_along = std::min(least_along, 2 * error * lean(r, 1));
    if (curve < kInfinity)
      least_across = std::min(least_across, (1 + curve) * error * lean(beside, r));
    if (e == bound.ellipses[0]) add(r, 1, reach(r, 1), 2 * error);
    if (e == bound.ellipses[1]) add(beside, r, reach(beside, r), (1 + curve) * error);
  }
  sum[kVolume] = bound.volume;
  sum[kArea] = std::min(most_area(s_.half_), base * (least_along + least_across));
  return sum;
}

}  // namespace whittle
