#include "numbers/known.h"

#include <algorithm>
#include <cmath>

namespace whittle {
namespace {

ExactVec scaled(ExactVec v, ExactVec by) {
  return {v.x / by.x, v.y / by.y, v.z / by.z};
}

/// What two convex bodies share, as if it were one whose ends belong to the one or the other.
struct Ends {
  Exact t0 = -kExactInfinity, t1 = kExactInfinity;
  ExactVec n0, n1;
  uint32_t id0 = 0, id1 = 0;

  void cut(const ExactSpan& span) {
    if (span.is_empty()) t0 = kExactInfinity, t1 = -kExactInfinity;
    if (span.t0 > t0) t0 = span.t0, n0 = span.n0, id0 = span.id;
    if (span.t1 < t1) t1 = span.t1, n1 = span.n1, id1 = span.id;
  }
};

/// The roots of a t^2 + 2 b t + c, in order; an empty pair if there are none.
struct Roots {
  Exact low = kExactInfinity, high = -kExactInfinity;
};
Roots roots(Exact a, Exact b, Exact c) {
  const Exact discriminant = b * b - a * c;
  if (!(discriminant > 0)) return {};
  // The sum that does not cancel gives one root, the product of both the other.
  const Exact q = -(b + std::copysign(std::sqrt(discriminant), b));
  return {std::min(q / a, c / q), std::max(q / a, c / q)};
}

/// Every t at which some body begins or ends, with the body and its normal there.
struct Event {
  Exact t;
  size_t body;
  bool enters;
};

/// Walks along the ray; `solid` tells from the bodies that the ray is in whether it is in the
/// solid.
template <class Solid>
Known first_change(const ExactRay& ray, const std::vector<ExactSpan>& bodies, const Solid& solid) {
  std::vector<Event> events;
  for (size_t i = 0; i < bodies.size(); ++i)
    if (!bodies[i].is_empty()) {
      events.push_back({bodies[i].t0, i, true});
      events.push_back({bodies[i].t1, i, false});
    }
  std::stable_sort(events.begin(), events.end(),
                   [](const Event& a, const Event& b) { return a.t < b.t; });
  std::vector<bool> in(bodies.size(), false);
  bool before = solid(in);
  for (size_t i = 0; i < events.size();) {
    // What happens together belongs to the first body that it happens to.
    size_t first = i;
    const Exact t = events[i].t;
    for (; i < events.size() && events[i].t == t; ++i) {
      in[events[i].body] = events[i].enters;
      if (events[i].body < events[first].body) first = i;
    }
    const bool after = solid(in);
    const bool changed = after != before;
    before = after;
    if (!changed || t <= ray.t_min) continue;
    const ExactSpan& body = bodies[events[first].body];
    const ExactVec n = events[first].enters ? body.n0 : body.n1;
    return {body.id, t, after == events[first].enters ? n : -n};
  }
  return {};
}

}  // namespace

ExactRay exact_ray(const Camera& camera, Exact px, Exact py) {
  const Exact s = 2 * Exact(camera.half_height) / camera.height;
  const Exact x = (px - Exact(camera.width) / 2) * s, y = (Exact(camera.height) / 2 - py) * s;
  const ExactVec across = exact(camera.right) * x + exact(camera.up) * y;
  const ExactVec eye = exact(camera.eye), forward = exact(camera.forward);
  if (camera.orthographic) return {eye + across, normalize(forward), -Exact(camera.ortho_reach)};
  return {eye, normalize(forward + across), 0};
}

ExactSpan slab(uint32_t id, const ExactRay& ray, int axis, Exact low, Exact high) {
  ExactVec up;
  up[axis] = 1;
  const Exact o = ray.origin[axis], d = ray.direction[axis];
  if (d == 0 && (o < low || o > high)) return {};
  if (d == 0) return {id, -kExactInfinity, kExactInfinity, {}, {}};
  const Exact a = (low - o) / d, b = (high - o) / d;
  return d > 0 ? ExactSpan{id, a, b, -up, up} : ExactSpan{id, b, a, up, -up};
}

ExactSpan box(uint32_t id, const ExactRay& ray, ExactVec low, ExactVec high) {
  Ends ends;
  for (int axis = 0; axis < 3; ++axis) ends.cut(slab(id, ray, axis, low[axis], high[axis]));
  return {id, ends.t0, ends.t1, ends.n0, ends.n1};
}

ExactSpan ellipsoid(uint32_t id, const ExactRay& ray, ExactVec center, ExactVec semi_axes) {
  const ExactVec o = scaled(ray.origin - center, semi_axes), d = scaled(ray.direction, semi_axes);
  // From the point nearest to the middle, so that a far eye costs no digits.
  const Exact a = dot(d, d), nearest = -dot(o, d) / a;
  const ExactVec p = o + d * nearest;
  const Roots r = roots(a, dot(p, d), dot(p, p) - 1);
  if (!(r.low < r.high)) return {};
  const auto normal = [&](Exact t) { return normalize(scaled(p + d * t, semi_axes)); };
  return {id, nearest + r.low, nearest + r.high, normal(r.low), normal(r.high)};
}

ExactSpan sphere(uint32_t id, const ExactRay& ray, ExactVec center, Exact r) {
  return ellipsoid(id, ray, center, {r, r, r});
}

ExactSpan cylinder(uint32_t id, const ExactRay& ray, int axis, ExactVec foot, Exact r,
                   Exact height) {
  ExactVec o = ray.origin - foot, d = ray.direction;
  o[axis] = d[axis] = 0;
  Ends ends;
  ends.cut(slab(id, ray, axis, foot[axis], foot[axis] + height));
  const Exact a = dot(d, d);
  if (a > 0) {
    const Exact nearest = -dot(o, d) / a;
    const ExactVec p = o + d * nearest;
    const Roots w = roots(a, dot(p, d), dot(p, p) - r * r);
    const auto normal = [&](Exact t) { return normalize(p + d * t); };
    ends.cut({id, nearest + w.low, nearest + w.high, normal(w.low), normal(w.high)});
  } else if (dot(o, o) > r * r) {
    return {};
  }
  return {id, ends.t0, ends.t1, ends.n0, ends.n1};
}

ExactSpan cone(uint32_t id, const ExactRay& ray, ExactVec foot, Exact r, Exact height) {
  // About the tip: x^2 + y^2 = (slope z)^2, the body where z runs from the tip to the base.
  const ExactVec tip = foot + ExactVec{0, 0, height};
  const Exact slope = r / height;
  const Exact nearest = dot(tip - ray.origin, ray.direction);
  const ExactVec o = ray.at(nearest) - tip, d = ray.direction;
  const auto product = [&](ExactVec p, ExactVec q) {
    return p.x * q.x + p.y * q.y - slope * slope * p.z * q.z;
  };
  const auto normal = [&](Exact t) {
    const ExactVec p = o + d * t;
    const ExactVec n = normalize(ExactVec{p.x, p.y, -slope * slope * p.z});
    return n == ExactVec{} ? ExactVec{0, 0, height > 0 ? Exact(1) : Exact(-1)} : n;
  };
  Ends ends;
  ends.cut(slab(id, ray, 2, std::min(foot.z, tip.z), std::max(foot.z, tip.z)));
  const Exact a = product(d, d), b = product(o, d), c = product(o, o);
  const Roots w = roots(a > 0 ? a : -std::fabs(a), b, c);  // one root of 0 is far away, not gone
  if (a > 0) {
    ends.cut({id, nearest + w.low, nearest + w.high, normal(w.low), normal(w.high)});
  } else {
    // Steeper than the side: it passes both nappes, and is in ours from its root on, or up to it.
    const bool to_base = (d.z < 0) == (height > 0);
    const Exact t = w.low < w.high ? (to_base ? w.high : w.low) : 0;  // 0: through the tip
    if (to_base)
      ends.cut({id, nearest + t, kExactInfinity, normal(t), {}});
    else
      ends.cut({id, -kExactInfinity, nearest + t, {}, normal(t)});
  }
  return {id, ends.t0, ends.t1, ends.n0, ends.n1};
}

Known seen_of_union(const ExactRay& ray, const std::vector<ExactSpan>& bodies) {
  return first_change(ray, bodies, [](const std::vector<bool>& in) {
    return std::find(in.begin(), in.end(), true) != in.end();
  });
}

Known seen_of_intersection(const ExactRay& ray, const std::vector<ExactSpan>& bodies) {
  return first_change(ray, bodies, [](const std::vector<bool>& in) {
    return std::find(in.begin(), in.end(), false) == in.end();
  });
}

Known seen_of_difference(const ExactRay& ray, const std::vector<ExactSpan>& bodies) {
  return first_change(ray, bodies, [](const std::vector<bool>& in) {
    return in[0] && std::find(in.begin() + 1, in.end(), true) == in.end();
  });
}

}  // namespace whittle
