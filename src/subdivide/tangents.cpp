#include "subdivide/tangents.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/box.h"
#include "base/result.h"

namespace whittle {
namespace {

/// Half-gradients shorter than this say nothing about where the surface is.
constexpr double kNoDirection = 1e-6;
/// Normals whose parallelepiped is smaller than this are taken for dependent.
constexpr double kDependent = 1e-9;

/// The least that q.Bq can be in the cell, or less.
double least_bend(Vec3 diag, Vec3 off, Vec3 half) {
  double least = -2 * (std::fabs(off.x) * half.y * half.z + std::fabs(off.y) * half.x * half.z +
                       std::fabs(off.z) * half.x * half.y);
  for (int k = 0; k < 3; ++k) least += std::min(diag[k], 0.0) * half[k] * half[k];
  return least;
}

/// Eigenvalues of the symmetric matrix a, and its unit eigenvectors as the columns of v: Jacobi's
/// rotations. `a` ends as the diagonal.
void diagonalise(double a[3][3], double v[3][3]) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) v[i][j] = i == j;
  constexpr int kSweeps = 6;  // converges quadratically
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    if (a[0][1] == 0 && a[0][2] == 0 && a[1][2] == 0) return;
    for (const auto& [p, q] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)}) {
      if (a[p][q] == 0) continue;
      const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
      const double t = (theta < 0 ? -1 : 1) / (std::fabs(theta) + std::hypot(theta, 1));
      const double c = 1 / std::hypot(t, 1), s = t * c;
      for (int k = 0; k < 3; ++k) {
        const double kp = a[k][p], kq = a[k][q];
        a[k][p] = c * kp - s * kq, a[k][q] = s * kp + c * kq;
      }
      for (int k = 0; k < 3; ++k) {
        const double pk = a[p][k], qk = a[q][k];
        a[p][k] = c * pk - s * qk, a[q][k] = s * pk + c * qk;
        const double vp = v[k][p], vq = v[k][q];
        v[k][p] = c * vp - s * vq, v[k][q] = s * vp + c * vq;
      }
      a[p][q] = a[q][p] = 0;
    }
  }
}

/// The largest g x - a x^2 for |x| <= h.
double largest(double g, double a, double h) {
  return a > 0 && std::fabs(g) < 2 * a * h ? g * g / (4 * a) : std::fabs(g) * h - a * h * h;
}

/// No point q of the cell has a larger g.q - q.Bq: along the axes of B, each by itself.
double largest(Vec3 g, Vec3 diag, Vec3 off, Vec3 half) {
  double b[3][3] = {{diag.x, off.z, off.y}, {off.z, diag.y, off.x}, {off.y, off.x, diag.z}};
  double axes[3][3];
  diagonalise(b, axes);
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const Vec3 axis{axes[0][k], axes[1][k], axes[2][k]};
    sum += largest(dot(g, axis), b[k][k], dot(abs(axis), half));
  }
  return sum;
}

/// Solves G x = b for n <= 3 unknowns, G symmetric and positive. False if it is nearly singular.
bool solve(double g[3][3], double b[3], size_t n, double x[3]) {
  for (size_t i = 0; i < n; ++i) {
    if (g[i][i] < kDependent) return false;
    for (size_t j = i + 1; j < n; ++j) {
      const double share = g[j][i] / g[i][i];
      for (size_t k = i; k < n; ++k) g[j][k] -= share * g[i][k];
      b[j] -= share * b[i];
    }
  }
  for (size_t i = n; i-- > 0;) {
    x[i] = b[i];
    for (size_t k = i + 1; k < n; ++k) x[i] -= g[i][k] * x[k];
    x[i] /= g[i][i];
  }
  return true;
}

}  // namespace

std::optional<Tangent> tangent(const Scene& scene, Literal literal, Vec3 center) {
  using K = Kernels<double>;
  const HalfSpace& h = scene.half_spaces[literal >> 1];
  const Vec3 q = center - h.center;
  const auto half_gradient = K::quadric_half_gradient(h.f, q);
  const double side = literal & 1 ? -1 : 1;
  const Vec3 gradient = Vec3{half_gradient.x, half_gradient.y, half_gradient.z} * (2 * side);
  const double steepness = length(gradient);
  if (!(steepness > kNoDirection)) return std::nullopt;
  const double scale = side / steepness;
  return Tangent{{gradient / steepness, -scale * K::quadric_value(h.f, q)},
                 Vec3{h.f.diag.x, h.f.diag.y, h.f.diag.z} * scale,
                 Vec3{h.f.off.x, h.f.off.y, h.f.off.z} * scale};
}

Constraint outer_plane(const Tangent& tangent, Vec3 half) {
  return {tangent.plane.n, tangent.plane.d - least_bend(tangent.diag, tangent.off, half)};
}

double combined_reach(std::span<const Tangent* const> tangents, Vec3 objective, Vec3 half) {
  const size_t n = tangents.size();
  WHITTLE_CHECK(n <= 3);
  double gram[3][3], right[3], weight[3];
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = 0; j < n; ++j) gram[i][j] = dot(tangents[i]->plane.n, tangents[j]->plane.n);
    right[i] = dot(tangents[i]->plane.n, objective);
  }
  if (!solve(gram, right, n, weight)) return kInfinity;
  Vec3 rest = objective, diag{}, off{};
  double reach = 0;
  for (size_t i = 0; i < n; ++i) {
    if (weight[i] < 0) return kInfinity;
    rest -= tangents[i]->plane.n * weight[i];
    diag += tangents[i]->diag * weight[i];
    off += tangents[i]->off * weight[i];
    reach += tangents[i]->plane.d * weight[i];
  }
  return reach + largest(rest, diag, off, half);
}

}  // namespace whittle
