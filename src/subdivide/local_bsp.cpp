#include "subdivide/local_bsp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace whittle {
namespace {

/// Places in a cell, as shares of its half size, that no model favours: the first sixteen of the
/// Halton sequence in bases 2, 3 and 5, moved a little.
constexpr std::array<Vec3, 16> kProbes = [] {
  std::array<Vec3, 16> all{};
  const auto radical_inverse = [](int i, int base) {
    double result = 0, digit = 1;
    for (; i > 0; i /= base) result += (digit /= base) * (i % base);
    return result;
  };
  for (int i = 0; i < 16; ++i) {
    Vec3 p{radical_inverse(i + 1, 2) + 0.0137, radical_inverse(i + 1, 3) - 0.0211,
           radical_inverse(i + 1, 5) + 0.0173};
    for (int axis = 0; axis < 3; ++axis)
      all[std::size_t(i)][axis] = 1.9 * (p[axis] - (p[axis] >= 1 ? 1 : 0)) - 0.95;
  }
  return all;
}();

/// Weights of a polygon's corners that give points inside of it.
constexpr double kWeights[][3] = {
    {1.1, 0.9, 1.3}, {2.3, 0.7, 0.4}, {0.5, 2.1, 0.8}, {0.6, 0.5, 2.7}};

/// So many planes are tried before one of them divides a part.
constexpr size_t kCandidates = 8;

Vec3 times(Vec3 a, Vec3 b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}

}  // namespace

uint32_t LocalBsp::count(const Unit& unit, const CellBox& cell) {
  constexpr uint32_t kMostTriangles = 64;
  const Boundary& boundary = scene_.boundaries[unit.boundary];
  const double slack = boundary.slack();
  counted_.clear();
  uint32_t triangles = 0;
  bool too_many = false;
  boundary.visit_in(cell.center, cell.half + Vec3{slack, slack, slack}, [&](uint32_t i) {
    const uint32_t number = scene_.faces[boundary.triangles()[i].face].literal >> 1;
    if (std::find(counted_.begin(), counted_.end(), number) == counted_.end())
      counted_.push_back(number);
    too_many = ++triangles > kMostTriangles || counted_.size() > kMostCounted;
    return !too_many;
  });
  return too_many ? kTooMany : uint32_t(counted_.size());
}

bool LocalBsp::is_inside(const Unit& unit, const CellBox& cell) const {
  return scene_.boundaries[unit.boundary].winding(cell.center + times(kProbes[0], cell.half)) != 0;
}

/// The number of the plane of a face's polygon in this cell. Planes that cannot be told apart on
/// the polygon are one here.
uint32_t LocalBsp::plane_of(uint32_t face, std::span<const Vec3> polygon, const CellBox& cell) {
  const uint32_t number = scene_.faces[face].literal >> 1;
  const HalfSpace& h = scene_.half_spaces[number];
  const Vec3 n = h.f.b * 2.0;
  for (uint32_t i = 0; i < planes_.size(); ++i) {
    if (planes_[i].half_space == number) return i;
    const auto is_on = [&](Vec3 q) { return std::fabs(planes_[i].at(q)) <= 2 * slack_; };
    if (std::fabs(dot(n, planes_[i].n)) > 0.9 && std::ranges::all_of(polygon, is_on)) return i;
  }
  planes_.push_back({n, dot(n, cell.center - h.center) + h.f.c, number, face});
  return uint32_t(planes_.size() - 1);
}

/// About the thickness of a thin polygon: twice its area over its circumference.
double LocalBsp::width_of(std::span<const Vec3> polygon) const {
  Vec3 area;
  double around = 0;
  for (size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 a = polygon[k] - polygon[0], b = polygon[(k + 1) % polygon.size()] - polygon[0];
    area += cross(a, b);
    around += length(b - a);
  }
  return around > 0 ? length(area) / around : 0;
}

/// Keeps of the polygon that `cut_` holds what is at sign * q[axis] <= limit.
void LocalBsp::clip(uint32_t axis, int sign, double limit) {
  const size_t n = cut_.size();
  for (size_t i = 0; i < n; ++i) {
    const Vec3 p = cut_[i], q = cut_[(i + 1) % n];
    const double at_p = sign * p[int(axis)] - limit, at_q = sign * q[int(axis)] - limit;
    if (at_p <= 0) cut_.push_back(p);
    if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0))
      cut_.push_back(p + (q - p) * (at_p / (at_p - at_q)));
  }
  cut_.erase(cut_.begin(), cut_.begin() + std::ptrdiff_t(n));
}

/// How far the corners of the triangles in the cell are from their planes. Of the whole boundary
/// that may be much more, and here it would hide what is small.
void LocalBsp::measure_slack(const Boundary& boundary, const CellBox& cell) {
  slack_ = boundary.rounding();
  boundary.visit_in(cell.center, cell.half, [&](uint32_t i) {
    const Boundary::Triangle& triangle = boundary.triangles()[i];
    const HalfSpace& h = scene_.half_spaces[scene_.faces[triangle.face].literal >> 1];
    for (const uint32_t corner : triangle.corners)
      slack_ = std::max(slack_, std::fabs(2 * dot(h.f.b, boundary.point(corner) - h.center)));
    return true;
  });
}

/// The triangles of the boundary, as far as they are in the cell, and their planes.
void LocalBsp::collect(const Boundary& boundary, const CellBox& cell, Vec3 reach) {
  planes_.clear();
  corners_.clear();
  polygons_.clear();
  boundary.visit_in(cell.center, reach, [&](uint32_t i) {
    const Boundary::Triangle& triangle = boundary.triangles()[i];
    const Literal literal = scene_.faces[triangle.face].literal;
    // What does not cross the cell parts nothing in it.
    if (classify(scene_.half_spaces[literal >> 1], cell) != Side::kCrosses) return true;
    cut_.clear();
    for (const uint32_t corner : triangle.corners)
      cut_.push_back(boundary.point(corner) - cell.center);
    const Vec3 normal = cross(cut_[1] - cut_[0], cut_[2] - cut_[0]);
    for (uint32_t axis = 0; axis < 3 && !cut_.empty(); ++axis) {
      clip(axis, 1, reach[int(axis)]);
      clip(axis, -1, reach[int(axis)]);
    }
    if (cut_.size() < 3 || !(width_of(cut_) > 4 * slack_)) return true;
    const uint32_t plane = plane_of(triangle.face, cut_, cell);
    const int outward = dot(normal, planes_[plane].n) < 0 ? -1 : 1;
    polygons_.push_back({uint32_t(corners_.size()), uint32_t(cut_.size()), plane, outward});
    corners_.insert(corners_.end(), cut_.begin(), cut_.end());
    return true;
  });
}

/// Of the planes of some polygons, the one that cuts the fewest others and leaves as little as can
/// be on one of its sides: with nothing there, it is one literal beside the rest.
uint32_t LocalBsp::choose(std::span<const uint32_t> polygons) {
  uint32_t best = polygons_[polygons[0]].plane;
  size_t least = SIZE_MAX, tried = 0;
  uint32_t last = UINT32_MAX;
  const size_t step = std::max<size_t>(1, polygons.size() / (4 * kCandidates));
  for (size_t i = 0; i < polygons.size() && tried < kCandidates; i += step) {
    const uint32_t plane = polygons_[polygons[i]].plane;
    if (plane == last) continue;
    last = plane;
    ++tried;
    size_t front = 0, back = 0, cut = 0;
    for (const uint32_t number : polygons) {
      const Polygon& polygon = polygons_[number];
      if (polygon.plane == plane) continue;
      bool has_front = false, has_back = false;
      for (uint32_t k = polygon.first; k < polygon.first + polygon.count; ++k) {
        const double f = planes_[plane].at(corners_[k]);
        has_front |= f > slack_;
        has_back |= f < -slack_;
      }
      cut += has_front && has_back;
      front += has_front && !has_back;
      back += has_back && !has_front;
    }
    const size_t cost = 8 * cut + std::min(front, back);
    if (cost < least) least = cost, best = plane;
    if (cost == 0) break;
  }
  return best;
}

/// Cuts a polygon by a plane, its corners on the plane going to both sides.
void LocalBsp::split(const Polygon& polygon, uint32_t plane, Polygon& front, Polygon& back) {
  const CellPlane& at = planes_[plane];
  front = back = polygon;
  const auto half = [&](Polygon& part, double sign) {
    part.first = uint32_t(corners_.size());
    for (uint32_t k = 0; k < polygon.count; ++k) {
      const Vec3 p = corners_[polygon.first + k],
                 q = corners_[polygon.first + (k + 1) % polygon.count];
      const double at_p = sign * at.at(p), at_q = sign * at.at(q);
      if (at_p >= 0) corners_.push_back(p);
      if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0))
        corners_.push_back(p + (q - p) * (at_p / (at_p - at_q)));
    }
    part.count = uint32_t(corners_.size()) - part.first;
  };
  half(front, 1);
  half(back, -1);
}

/// Sorts polygons to the sides of a plane, into front_ and back_, and finds a point of one that
/// lies in the plane, as far from all others as can be.
void LocalBsp::divide(std::span<const uint32_t> polygons, uint32_t plane, Node& node) {
  front_.clear();
  back_.clear();
  double best = -1;
  const double good_enough = 16 * slack_;
  for (const uint32_t number : polygons) {
    const Polygon polygon = polygons_[number];
    if (polygon.plane == plane) {
      for (const auto& weights : kWeights) {
        if (best > good_enough) break;
        Vec3 sum;
        double all = 0;
        for (uint32_t k = 0; k < polygon.count; ++k) {
          const double weight = weights[k % 3] + 0.01 * k;
          sum += corners_[polygon.first + k] * weight;
          all += weight;
        }
        const Vec3 p = sum / all;
        double nearest = kInfinity;
        for (const uint32_t other : polygons)
          if (const uint32_t its = polygons_[other].plane; its != plane)
            nearest = std::min(nearest, std::fabs(planes_[its].at(p)));
        // A point well inside of its polygon says more than one of a sliver.
        double width = kInfinity;
        for (uint32_t k = 0; k < polygon.count; ++k) {
          const Vec3 a = corners_[polygon.first + k],
                     b = corners_[polygon.first + (k + 1) % polygon.count];
          const double l = length(b - a);
          if (l > 0) width = std::min(width, length(cross(b - a, p - a)) / l);
        }
        const double worth = std::min(nearest, width);
        if (worth > best) {
          best = worth;
          node.room = worth;
          node.sample = p;
          node.jump = polygon.outward;
        }
      }
      continue;
    }
    double highest = 0, lowest = 0;
    for (uint32_t k = polygon.first; k < polygon.first + polygon.count; ++k) {
      const double f = planes_[plane].at(corners_[k]);
      highest = std::max(highest, f);
      lowest = std::min(lowest, f);
    }
    if (highest > slack_ && lowest < -slack_) {
      Polygon front, back;
      split(polygon, plane, front, back);
      const auto is_wide = [&](const Polygon& part) {
        return part.count >= 3 &&
               width_of(std::span(corners_).subspan(part.first, part.count)) > 2 * slack_;
      };
      if (is_wide(front)) {
        front_.push_back(uint32_t(polygons_.size()));
        polygons_.push_back(front);
      }
      if (is_wide(back)) {
        back_.push_back(uint32_t(polygons_.size()));
        polygons_.push_back(back);
      }
    } else {
      (highest >= -lowest ? front_ : back_).push_back(number);
    }
  }
}

void LocalBsp::build() {
  struct Open {
    uint32_t first, last;  ///< into lists_
    uint32_t parent, side;
  };
  nodes_.clear();
  windings_.clear();
  lists_.clear();
  for (uint32_t i = 0; i < polygons_.size(); ++i) lists_.push_back(i);
  std::vector<Open> open{{0, uint32_t(lists_.size()), UINT32_MAX, 0}};
  while (!open.empty()) {
    const Open part = open.back();
    open.pop_back();
    uint32_t self = kPart + uint32_t(windings_.size());
    if (part.first == part.last) {
      windings_.push_back(0);
    } else {
      self = uint32_t(nodes_.size());
      list_.assign(lists_.begin() + part.first, lists_.begin() + part.last);
      lists_.resize(part.first);
      Node node{choose(list_), {0, 0}, {}, 0, 0};
      divide(list_, node.plane, node);
      nodes_.push_back(node);
      const auto from = uint32_t(lists_.size());
      lists_.insert(lists_.end(), front_.begin(), front_.end());
      const auto middle = uint32_t(lists_.size());
      lists_.insert(lists_.end(), back_.begin(), back_.end());
      open.push_back({from, middle, self, 0});
      open.push_back({middle, uint32_t(lists_.size()), self, 1});
    }
    if (part.parent != UINT32_MAX) nodes_[part.parent].child[part.side] = self;
  }
}

/// The part that a point is in.
uint32_t LocalBsp::part_at(uint32_t node, Vec3 q) const {
  while ((node & kPart) == 0)
    node = nodes_[node].child[planes_[nodes_[node].plane].at(q) <= 0 ? 1 : 0];
  return node & ~kPart;
}

/// The parts that have a point well inside are looked up in the whole boundary there: points all
/// over the cell, and points on both sides of every node's sample. The rest, which are thin, follow
/// from their neighbours: every node tells by how much the winding numbers differ of two parts, one
/// on either side of its sample, and so its n - 1 nodes relate n parts.
void LocalBsp::label(const Boundary& boundary, const CellBox& cell) {
  struct Probe {
    Vec3 at;
    double distance = -1;  ///< from the nearest plane
  };
  std::vector<Probe> probes(windings_.size());
  for (const Vec3& share : kProbes) {
    const Vec3 q = times(share, cell.half);
    double nearest = kInfinity;
    for (const CellPlane& plane : planes_) nearest = std::min(nearest, std::fabs(plane.at(q)));
    Probe& probe = probes[part_at(0, q)];
    if (nearest > probe.distance) probe = {q, nearest};
  }
  for (const Node& node : nodes_)
    for (const double side : {0.5, -0.5}) {
      const Vec3 q = node.sample + planes_[node.plane].n * (side * node.room);
      Probe& probe = probes[part_at(0, q)];
      if (node.room / 2 > probe.distance) probe = {q, node.room / 2};
    }

  // Sets of parts whose differences are known: each part's to its set's first (union-find).
  std::vector<uint32_t> set(windings_.size());
  for (uint32_t i = 0; i < set.size(); ++i) set[i] = i;
  const auto find = [&](uint32_t part) {
    int sum = 0;
    uint32_t root = part;
    while (set[root] != root) sum += windings_[root], root = set[root];
    while (set[part] != root) {
      const uint32_t next = set[part];
      const int own = windings_[part];
      windings_[part] = sum;
      set[part] = root;
      sum -= own;
      part = next;
    }
    return root;
  };
  const auto difference = [&](uint32_t part, uint32_t root) {
    return part == root ? 0 : windings_[part];
  };
  for (const Node& node : nodes_) {
    const uint32_t front = part_at(node.child[0], node.sample),
                   back = part_at(node.child[1], node.sample);
    const uint32_t front_root = find(front), back_root = find(back);
    if (front_root == back_root) continue;
    // w(back) = w(front) + jump.
    const int sum = difference(front, front_root) + node.jump - difference(back, back_root);
    set[back_root] = front_root;
    windings_[back_root] = sum;
  }

  uint32_t best = 0;
  for (uint32_t i = 1; i < probes.size(); ++i)
    if (probes[i].distance > probes[best].distance) best = i;
  std::vector<int> result(windings_.size());
  const auto look_up = [&](uint32_t part) {
    return boundary.winding(cell.center + probes[part].at);
  };
  const uint32_t root = find(best);
  const int of_root = look_up(best) - difference(best, root);
  for (uint32_t i = 0; i < set.size(); ++i) {
    if (probes[i].distance > 4 * slack_) {
      result[i] = look_up(i);
    } else {
      const uint32_t its = find(i);
      result[i] = of_root + difference(i, its);
    }
  }
  windings_ = std::move(result);
}

LocalBsp::Form LocalBsp::form_of_child(uint32_t child) const {
  if ((child & kPart) == 0) return forms_[child];
  return windings_[child & ~kPart] != 0 ? Form::kTrue : Form::kFalse;
}

LocalBsp::Form LocalBsp::form_of(const Node& node) const {
  const Form front = form_of_child(node.child[0]), back = form_of_child(node.child[1]);
  const bool front_is_known = front == Form::kFalse || front == Form::kTrue;
  const bool back_is_known = back == Form::kFalse || back == Form::kTrue;
  if (front_is_known && back_is_known) {
    if (front == back) return front;
    return back == Form::kTrue ? Form::kBehind : Form::kInFront;
  }
  if (front_is_known) return front == Form::kFalse ? Form::kAnd : Form::kOrNot;
  if (back_is_known) return back == Form::kFalse ? Form::kAndNot : Form::kOr;
  return Form::kBoth;
}

/// From the tree to tokens, from the top, every group in one of the other kind.
void LocalBsp::write(bool negated) {
  tokens_.clear();
  operands_ = 0;
  enum class What : uint8_t { kNode, kBackHalf, kFrontHalf, kBehind, kInFront, kClose };
  struct Task {
    What what;
    TokenKind around;  ///< the group it stands in
    uint32_t depth;    ///< of that group
    uint32_t at;       ///< a node; kClose: a header
  };
  std::vector<Task> tasks;
  const auto literal = [&](const Node& node, bool behind) {
    const CellPlane& plane = planes_[node.plane];
    const bool is_complement = scene_.faces[plane.face].literal & 1;
    // The face says: behind the plane, or if it is the complement, in front of it.
    tokens_.push_back(
        Token::make(TokenKind::kFace, plane.face, (behind == is_complement) != negated));
  };
  // Opens a group, unless it stands in one of its own kind, and puts its two operands in it.
  const auto group = [&](const Task& task, TokenKind kind, Task first, Task second) {
    if (negated) kind = kind == TokenKind::kAnd ? TokenKind::kOr : TokenKind::kAnd;
    const bool joins = task.depth > 0 && task.around == kind;
    const uint32_t depth = joins ? task.depth : task.depth + 1;
    if (!joins) {
      if (task.depth == 1) ++operands_;
      tasks.push_back({What::kClose, kind, depth, uint32_t(tokens_.size())});
      tokens_.push_back(Token::make(kind, 0));
    }
    first.around = second.around = kind;
    first.depth = second.depth = depth;
    tasks.push_back(second);
    tasks.push_back(first);
  };
  tasks.push_back({What::kNode, TokenKind::kAnd, 0, 0});
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    if (task.what == What::kClose) {
      tokens_[task.at] = Token::make(task.around, uint32_t(tokens_.size()) - task.at);
      continue;
    }
    const Node& node = nodes_[task.at];
    const auto of = [&](What what) { return Task{what, {}, 0, task.at}; };
    const auto child = [&](int side) { return Task{What::kNode, {}, 0, node.child[side]}; };
    const auto alone = [&](bool behind) {
      if (task.depth == 1) ++operands_;
      literal(node, behind);
    };
    switch (task.what) {
      case What::kBehind:
        alone(true);
        break;
      case What::kInFront:
        alone(false);
        break;
      case What::kBackHalf:
        group(task, TokenKind::kAnd, of(What::kBehind), child(1));
        break;
      case What::kFrontHalf:
        group(task, TokenKind::kAnd, of(What::kInFront), child(0));
        break;
      default:
        switch (forms_[task.at]) {
          case Form::kFalse:
          case Form::kTrue: {
            // Only the root: within, constants have gone.
            const bool value = (forms_[task.at] == Form::kTrue) != negated;
            tokens_.push_back(Token::make(value ? TokenKind::kAnd : TokenKind::kOr, 1));
            break;
          }
          case Form::kBehind:
            alone(true);
            break;
          case Form::kInFront:
            alone(false);
            break;
          case Form::kAnd:
            group(task, TokenKind::kAnd, of(What::kBehind), child(1));
            break;
          case Form::kAndNot:
            group(task, TokenKind::kAnd, of(What::kInFront), child(0));
            break;
          case Form::kOr:
            group(task, TokenKind::kOr, of(What::kBehind), child(0));
            break;
          case Form::kOrNot:
            group(task, TokenKind::kOr, of(What::kInFront), child(1));
            break;
          case Form::kBoth:
            group(task, TokenKind::kOr, of(What::kBackHalf), of(What::kFrontHalf));
            break;
        }
    }
  }
}

std::span<const Token> LocalBsp::formula(const Unit& unit, const CellBox& cell, bool negated) {
  const Boundary& boundary = scene_.boundaries[unit.boundary];
  measure_slack(boundary, cell);
  collect(boundary, cell, cell.half);
  if (polygons_.empty()) {
    const bool value = is_inside(unit, cell) != negated;
    tokens_.assign(1, Token::make(value ? TokenKind::kAnd : TokenKind::kOr, 1));
    operands_ = 0;
    return tokens_;
  }
  build();
  label(boundary, cell);
  forms_.resize(nodes_.size());
  // Children stand behind their parents.
  for (size_t i = nodes_.size(); i-- > 0;) forms_[i] = form_of(nodes_[i]);
  write(negated);
  return tokens_;
}

}  // namespace whittle
