#include "measure/graph_patch.h"

#include <algorithm>
#include <cmath>

namespace whittle {
double GraphPatch::Polynomial::most(double s, double t) const {
  return std::fabs(x) * s + std::fabs(y) * t + std::fabs(xx) * s * s + std::fabs(xy) * s * t +
         std::fabs(yy) * t * t;
}

GraphPatch::Reach GraphPatch::reach(double s, double t) const {
  Reach reach;
  reach.least_d = d0_ - d_.most(s, t);
  const double beta = root_ - std::fabs(beta_x_) * s - std::fabs(beta_y_) * t;
  if (!(reach.least_d > 0)) return reach;
  // The real part of sqrt(D) is at least the root of D's.
  const double divisor = beta + std::sqrt(reach.least_d);
  if (!(divisor > 0)) return reach;
  reach.is_analytic = true;
  reach.rise = phi_.most(s, t) / divisor;
  return reach;
}

std::optional<GraphPatch> GraphPatch::make(const Quadric& f, Vec3 half, int axis) {
  GraphPatch p;
  p.f_ = f, p.half_ = half;
  p.k_ = axis, p.i_ = (axis + 1) % 3, p.j_ = (axis + 2) % 3;
  const int i = p.i_, j = p.j_, k = p.k_;
  const double a = f.diag[k], slope = f.b[k];
  p.d0_ = slope * slope - a * f.c;
  if (!(p.d0_ > 0) || slope == 0) return std::nullopt;
  p.root_ = std::sqrt(p.d0_);
  p.sign_ = slope > 0 ? 1 : -1;
  p.level_ = -f.c / (slope + p.sign_ * p.root_);

  const double hi = half[i], hj = half[j], level = p.level_;
  const double ki = entry(f, k, i), kj = entry(f, k, j), ij = entry(f, i, j);
  p.beta_x_ = ki * hi, p.beta_y_ = kj * hj;
  p.phi_ = {2 * (f.b[i] + ki * level) * hi, 2 * (f.b[j] + kj * level) * hj, f.diag[i] * hi * hi,
            2 * ij * hi * hj, f.diag[j] * hj * hj};
  const double beta = p.sign_ * p.root_;
  p.d_ = {2 * beta * p.beta_x_ - a * p.phi_.x, 2 * beta * p.beta_y_ - a * p.phi_.y,
          p.beta_x_ * p.beta_x_ - a * p.phi_.xx, 2 * p.beta_x_ * p.beta_y_ - a * p.phi_.xy,
          p.beta_y_ * p.beta_y_ - a * p.phi_.yy};
  // f's slope along the axis is 2 (a (z - level) + beta): nowhere 0 in the box.
  const double height = half[k] + std::fabs(level);
  const double least = p.root_ - std::fabs(p.beta_x_) - std::fabs(p.beta_y_);
  const Reach real = p.reach(1, 1);
  if (!(least > std::fabs(a) * height) || !real.is_analytic) return std::nullopt;
  p.spread_ = real.rise;
  for (size_t e = 0; e < kEllipses.size(); ++e) {
    const double r = ellipse_reach(kEllipses[e]);
    p.reaches_[0][e] = p.reach(r, 1);
    p.reaches_[1][e] = p.reach(1, r);
  }
  return p;
}

double GraphPatch::at(Vec3 p) const {
  const double s = half_[i_] > 0 ? p[i_] / half_[i_] : 0, t = half_[j_] > 0 ? p[j_] / half_[j_] : 0;
  const double beta = root_ + sign_ * (beta_x_ * s + beta_y_ * t);
  return level_ - sign_ * phi_.at(s, t) / (beta + std::sqrt(d0_ + d_.at(s, t)));
}

double GraphPatch::norm() const {
  double sum = 0;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) sum += entry(f_, r, c) * entry(f_, r, c);
  return std::sqrt(sum);
}

GraphPatch::Bound GraphPatch::bound(const GaussTable& gauss, size_t n) const {
  Bound bound;
  bound.points = n;
  double worst = -1;
  for (size_t axis = 0; axis < 2; ++axis) {
    double least = kInfinity;
    for (size_t e = 0; e < kEllipses.size() && reaches_[axis][e].is_analytic; ++e) {
      // The level is a constant, and the rule is exact for constants.
      const double error = gauss.error(n, e) * reaches_[axis][e].rise;
      if (error < least) least = error, bound.ellipses[axis] = e;
    }
    // Along the other axis there is a length of 2, or weights of that sum.
    bound.volume += 2 * half_[i_] * half_[j_] * least;
    if (least > worst) worst = least, bound.worst_axis = axis == 0 ? i_ : j_;
  }
  return bound;
}

Moments GraphPatch::moments(const GaussRule& rule) const {
  const int i = i_, j = j_, k = k_;
  const double hk = half_[k];
  Moments below{};
  for (size_t u = 0; u < rule.size; ++u) {
    for (size_t v = 0; v < rule.size; ++v) {
      const double s = rule.at[u], t = rule.at[v];
      const double weight = rule.weight[u] * rule.weight[v] * half_[i] * half_[j];
      const double root = std::sqrt(d0_ + d_.at(s, t));
      const double beta = root_ + sign_ * (beta_x_ * s + beta_y_ * t);
      Vec3 p;
      p[i] = s * half_[i], p[j] = t * half_[j];
      p[k] = level_ - sign_ * phi_.at(s, t) / (beta + root);
      const double z = p[k];
      const double height = weight * (z + hk);
      const double square = weight * (z * z - hk * hk) / 2;
      below[kVolume] += height;
      below[first_of(i)] += height * p[i];
      below[first_of(j)] += height * p[j];
      below[first_of(k)] += square;
      below[product_of(i, i)] += height * p[i] * p[i];
      below[product_of(j, j)] += height * p[j] * p[j];
      below[product_of(i, j)] += height * p[i] * p[j];
      below[product_of(i, k)] += square * p[i];
      below[product_of(j, k)] += square * p[j];
      below[product_of(k, k)] += weight * (z * z * z + hk * hk * hk) / 3;
      below[kArea] += weight * length(Kernels<double>::quadric_half_gradient(f_, p)) / root;
    }
  }
  if (sign_ > 0) return below;
  Moments above = box_moments(half_);
  for (size_t m = 0; m < kArea; ++m) above[m] -= below[m];
  above[kArea] = below[kArea];
  return above;
}

Moments GraphPatch::bounds(const GaussTable& gauss, const Bound& bound, Vec3 center) const {
  Moments sum{};
  const double base = 2 * half_[i_] * half_[j_];
  Vec3 middle;
  middle[k_] = level_;
  const double steep = length(Kernels<double>::quadric_half_gradient(f_, middle));
  for (size_t axis = 0; axis < 2; ++axis) {
    const int along = axis == 0 ? i_ : j_;
    // For complex coordinates: how large they are, and the height of what lies below.
    const size_t ellipse = bound.ellipses[axis];
    const Reach& complex = reaches_[axis][ellipse];
    Vec3 reach = half_;
    reach[along] *= ellipse_reach(kEllipses[ellipse]);
    reach[k_] = std::max(half_[k_], std::fabs(level_) + complex.rise);
    const double height = std::fabs(level_ + half_[k_]) + complex.rise;
    const double error = gauss.error(bound.points, ellipse) * base;
    const Moments part = weighted(error * height, center, reach);
    for (size_t m = 0; m < kArea; ++m) sum[m] += part[m];
    // The area's own ellipse: the gradient's square must stay away from zero, too.
    double least = kInfinity;
    for (size_t e = 0; e < kEllipses.size() && reaches_[axis][e].is_analytic; ++e) {
      Vec3 way = half_;
      way[along] *= ellipse_reach(kEllipses[e]);
      way[k_] = reaches_[axis][e].rise;
      const double turn = norm() * length(way);
      const double change = (2 * steep + turn) * turn, square = steep * steep;
      if (!(change < square)) break;
      const double most = std::sqrt((square + change) / reaches_[axis][e].least_d);
      least = std::min(least, gauss.error(bound.points, e) * most);
    }
    sum[kArea] += least * base;
  }
  sum[kVolume] = bound.volume;
  if (!(sum[kArea] < most_area(half_))) sum[kArea] = most_area(half_);
  return sum;
}

}  // namespace whittle
