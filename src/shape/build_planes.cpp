// Every plane is pushed out until it supports all corners, so the solid holds its own corners
// whatever their rounding.
//
// What rounding can do. Let no corner be farther than e from where it was meant to be, on or below
// the plane of a face with unit normal n. The vector area of the printed face is half the sum of
// cross(p[i], p[i+1]); the corners' heights h[i] <= e over the true plane turn it by half the sum
// of h[i] (p[i+1] - p[i-1]), so the sine of the angle between the printed normal and n is at most e
// times `turn`, the sum of |p[i+1] - p[i-1]| over twice the area. Hence
// - a corner at distance r from the face's middle is at most 2 e + e turn r above it;
// - a corner of the face itself is at most 6 e off the plane through its middle, however narrow the
//   face: along a chord the turn is worth at most 4 e, because the area is at least half of that
//   chord times the width across it. Of 40,000 random convex faces none came beyond 3.8 e; with
//   four corners none can come beyond e.
//
// Every plane is held against every corner, but a tree of them answers for most. Faces in one plane
// are found by going from neighbour to neighbour: what of a convex surface lies within a little of
// a plane that touches it hangs together.
#include "shape/build_planes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/box.h"
#include "shape/corner_tree.h"

namespace whittle {

namespace {

using Loop = std::vector<uint32_t>;

/// Cutting a face takes time with the square of its corners.
constexpr size_t kMostBentCorners = 100;

/// Of the solid's diagonal: what is worth a word.
constexpr double kCoarse = 1e-3;

struct Face {
  uint32_t number = 0;  ///< in the file, for messages
  Loop loop = {};       ///< corners, at least 3 different ones in a row
  Vec3 normal = {};     ///< unit
  double area = 0;
  double width = 0;  ///< how narrow the face is: area over its greatest reach
  double turn = 0;   ///< by how much an error of 1 in its corners may turn it, as a sine
  Vec3 middle = {};
};

/// Corners by place: equal points get the number of the first of them.
std::vector<uint32_t> merge_equal_points(const std::vector<Vec3>& points) {
  // A hash table, not more than half full.
  const size_t mask = std::bit_ceil(2 * points.size() + 1) - 1;
  std::vector<uint32_t> slots(mask + 1, UINT32_MAX);
  const auto hash_of = [](const Vec3& p) {
    uint64_t hash = 0;
    for (const double x : {p.x, p.y, p.z}) {
      // Both zeros are one.
      hash = (hash ^ std::bit_cast<uint64_t>(x + 0.0)) * 0x9e3779b97f4a7c15ull;
      hash ^= hash >> 32;
    }
    return hash;
  };
  std::vector<uint32_t> merged(points.size());
  for (uint32_t i = 0; i < points.size(); ++i) {
    size_t slot = hash_of(points[i]) & mask;
    while (slots[slot] != UINT32_MAX && !(points[slots[slot]] == points[i]))
      slot = (slot + 1) & mask;
    if (slots[slot] == UINT32_MAX) slots[slot] = i;
    merged[i] = slots[slot];
  }
  return merged;
}

Loop clean_loop(const Loop& face, const std::vector<uint32_t>& merged) {
  Loop loop;
  for (const uint32_t i : face)
    if (loop.empty() || loop.back() != merged[i]) loop.push_back(merged[i]);
  while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
  return loop;
}

/// Twice the area as a vector (Newell), by fans about the first corner; inward for OpenSCAD's
/// order.
Vec3 area_vector(const Loop& loop, const std::vector<Vec3>& points) {
  Vec3 sum;
  const Vec3 o = points[loop[0]];
  for (size_t i = 2; i < loop.size(); ++i)
    sum += cross(points[loop[i - 1]] - o, points[loop[i]] - o);
  return sum;
}

/// Which face, by its place in the list, runs along an edge in that direction. A hash table, not
/// more than half full.
class Edges {
 public:
  Edges() = default;
  /// For so many edges at most.
  explicit Edges(size_t edges) : slots_(std::bit_ceil(2 * edges + 1)) {}

  /// False if a face does so already.
  bool add(uint32_t from, uint32_t to, uint32_t face) {
    Slot& slot = slots_[find_slot(from, to)];
    if (slot.face != kNone) return false;
    slot = {from, to, face};
    return true;
  }
  const uint32_t* find(uint32_t from, uint32_t to) const {
    const Slot& slot = slots_[find_slot(from, to)];
    return slot.face == kNone ? nullptr : &slot.face;
  }

 private:
  static constexpr uint32_t kNone = UINT32_MAX;
  struct Slot {
    uint32_t from = 0, to = 0;
    uint32_t face = kNone;
  };

  /// That of the edge, or a free one.
  size_t find_slot(uint32_t from, uint32_t to) const {
    const size_t mask = slots_.size() - 1;
    const uint64_t key = uint64_t{from} << 32 | to;
    size_t i = (key * 0x9e3779b97f4a7c15ull >> 32) & mask;
    while (slots_[i].face != kNone && (slots_[i].from != from || slots_[i].to != to))
      i = (i + 1) & mask;
    return i;
  }

  std::vector<Slot> slots_;
};

/// Calls `visit(from, to)` for every edge of the face; stops where it returns false.
template <class Visit>
bool all_edges(const Loop& loop, const Visit& visit) {
  uint32_t from = loop.back();
  for (const uint32_t to : loop) {
    if (!visit(from, to)) return false;
    from = to;
  }
  return true;
}

/// Each edge must be run along once in each direction.
std::optional<std::string> check_closed(const std::vector<Face>& faces, Edges& edges) {
  std::string reason;
  size_t count = 0;
  for (const Face& face : faces) count += face.loop.size();
  edges = Edges(count);
  for (uint32_t f = 0; f < faces.size(); ++f) {
    const auto is_new = [&](uint32_t a, uint32_t b) {
      if (edges.add(a, b, f)) return true;
      reason = fmt::format(
          "its faces are not turned the same way, or cross: the edge from point {} to {} is run "
          "along twice, the second time by face {}",
          a, b, faces[f].number);
      return false;
    };
    if (!all_edges(faces[f].loop, is_new)) return reason;
  }
  for (const Face& face : faces) {
    const auto has_twin = [&](uint32_t a, uint32_t b) {
      if (edges.find(b, a) != nullptr) return true;
      reason = fmt::format("it is not closed: only face {} has the edge from point {} to {}",
                           face.number, a, b);
      return false;
    };
    if (!all_edges(face.loop, has_twin)) return reason;
  }
  return std::nullopt;
}

/// What the faces are, once the text's peculiarities are gone.
struct Surface {
  const std::vector<Vec3>& points;
  std::vector<Face> faces;
  std::vector<CornerTree::Corner> corners;  ///< points that faces use
  Edges edges;
  double size = 0;  ///< the diagonal of the box
  double thickness = 0;
  double stray = 0;  ///< how far a corner may be from where it was meant to be

  /// Else it is too narrow to have one; its neighbours bound the solid there.
  bool has_direction(const Face& face) const { return face.width > kFlatSolid * kFlatSolid * size; }
};

void measure(Face& face, const std::vector<Vec3>& points) {
  const Vec3 area = area_vector(face.loop, points);
  double reach = 0, across = 0;
  const size_t n = face.loop.size();
  for (size_t k = 0; k < n; ++k) {
    const Vec3 corner = points[face.loop[k]];
    face.middle += corner / double(n);
    reach = std::max(reach, length(corner - points[face.loop[0]]));
    across += length(points[face.loop[(k + 1) % n]] - points[face.loop[(k + n - 1) % n]]);
  }
  face.area = length(area);
  face.width = face.area / reach;
  face.turn = across / face.area;
  face.normal = -normalize(area);
}

/// Six times the volume; negative if the faces are turned inward. The centre, which may be any,
/// spares digits.
double volume(const Surface& surface, Vec3 center) {
  double sum = 0;
  for (const Face& face : surface.faces) sum += dot(face.middle - center, face.normal * face.area);
  return sum;
}

/// How far it reaches across its largest face.
double thickness(const Surface& surface) {
  const Face& largest = *std::ranges::max_element(surface.faces, {}, &Face::area);
  const auto across = [&](const CornerTree::Corner& corner) {
    return dot(corner.place - largest.middle, largest.normal);
  };
  const auto [below, above] = std::ranges::minmax(surface.corners, {}, across);
  return across(above) - across(below);
}

CornerTree make_tree(Surface& surface) {
  std::vector<Vec3> outward(surface.points.size());
  for (const Face& face : surface.faces)
    for (const uint32_t i : face.loop) outward[i] += face.normal;
  for (CornerTree::Corner& corner : surface.corners) corner.normal = outward[corner.number];
  return CornerTree(std::move(surface.corners));
}

/// Half a unit of the sixth digit of the largest of the coordinates.
double rounding_of_six_digits(double largest) {
  if (!(largest > 0)) return 0;
  double decade = std::floor(std::log10(largest));
  // The logarithm is rounded too.
  if (std::pow(10, decade + 1) <= largest) ++decade;
  return 0.5 * std::pow(10, decade - 5);
}

/// How far printing may have moved a corner of a solid in this box.
double stray(const Box& box) {
  const Vec3 lo = abs(box.lo), hi = abs(box.hi);
  double e[3];
  for (int i = 0; i < 3; ++i) e[i] = rounding_of_six_digits(std::max(lo[i], hi[i]));
  return std::max(kLeastStray * box.diagonal(), std::hypot(e[0], e[1], e[2]));
}

/// The corner that is farthest off the plane of its face, the first of several, and how far.
std::pair<uint32_t, double> bend(const Surface& surface, const Face& face) {
  std::pair<uint32_t, double> most{face.loop[0], 0};
  for (const uint32_t i : face.loop) {
    const double off = std::fabs(dot(face.normal, surface.points[i] - face.middle));
    if (off > most.second * (1 + 1e-9)) most = {i, off};
  }
  return most;
}

/// Cuts a face into triangles: those of the convex hull of its corners that are seen from outside,
/// where seen from there the corners are those of a convex polygon.
std::vector<Loop> cut(const Surface& surface, const Face& face, bool inside_out) {
  const auto place = [&](uint32_t k) { return surface.points[face.loop[k]]; };
  std::vector<Loop> triangles;
  // Runs of corners whose first and last have an edge between them.
  std::vector<std::pair<uint32_t, uint32_t>> open{{0, uint32_t(face.loop.size() - 1)}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    if (last - first < 2) continue;
    uint32_t apex = first + 1;
    for (uint32_t k = first + 2; k < last; ++k) {
      const Vec3 o = place(first);
      const double volume = dot(cross(place(apex) - o, place(last) - o), place(k) - o);
      if (inside_out ? volume > 0 : volume < 0) apex = k;
    }
    triangles.push_back({face.loop[first], face.loop[apex], face.loop[last]});
    open.emplace_back(first, apex);
    open.emplace_back(apex, last);
  }
  return triangles;
}

/// Puts triangles in the place of faces that are not flat. Returns what is to be said about that.
Verdict cut_bent_faces(Surface& surface, bool inside_out) {
  Verdict verdict;
  std::vector<Face> faces;
  for (Face& face : surface.faces) {
    if (!surface.has_direction(face)) {
      faces.push_back(std::move(face));
      continue;
    }
    const auto [corner, off] = bend(surface, face);
    if (!(off > kFlatFace * surface.stray)) {
      faces.push_back(std::move(face));
      continue;
    }
    const std::string what =
        fmt::format("face {} is not flat: point {} lies {:.3g} off it", face.number, corner, off);
    if (face.loop.size() > kMostBentCorners) {
      verdict.refusal = what;
      return verdict;
    }
    if (verdict.remark.empty()) verdict.remark = what + "; it is cut so that the solid is convex";
    for (Loop& triangle : cut(surface, face, inside_out)) {
      Face& part = faces.emplace_back(Face{.number = face.number, .loop = std::move(triangle)});
      measure(part, surface.points);
      if (inside_out) part.normal = -part.normal;
    }
  }
  surface.faces = std::move(faces);
  return verdict;
}

/// How far above its face, as it is printed, a corner of a convex solid may be, so far from the
/// face's middle.
double forgiven(const Surface& surface, const Face& face, double distance) {
  return surface.stray * (2 + face.turn * distance);
}

std::string not_convex(uint32_t corner, double beyond, const Face& face) {
  return fmt::format("it is not convex: point {} lies {:.3g} outside face {}", corner, beyond,
                     face.number);
}

/// Why it is not convex, if a few of the faces and a few of the corners, all over the solid, tell
/// that already. Of most meshes that are not they do, and the rest need not be found out.
///
/// Twice what is forgiven is sure: a face that is in the plane of a wider one is off it by less
/// than a corner may stray, so that no corner below that plane is so far above the face.
std::optional<std::string> find_dent(const Surface& surface) {
  constexpr size_t kFew = 64;
  const std::vector<Face>& faces = surface.faces;
  const size_t face_step = faces.size() / kFew, corner_step = surface.corners.size() / kFew;
  if (face_step == 0 || corner_step == 0) return std::nullopt;
  for (size_t f = 0; f < faces.size(); f += face_step) {
    const Face& face = faces[f];
    if (!surface.has_direction(face)) continue;
    for (size_t c = 0; c < surface.corners.size(); c += corner_step) {
      const Vec3 away = surface.corners[c].place - face.middle;
      const double beyond = dot(face.normal, away);
      if (beyond > 2 * forgiven(surface, face, length(away)))
        return not_convex(surface.corners[c].number, beyond, face);
    }
  }
  return std::nullopt;
}

/// The plane of a face, pushed out to the farthest corner; or why that would be too far.
std::variant<Plane, std::string> supporting_plane(const Surface& surface, const Face& face,
                                                  const CornerTree& tree) {
  const Vec3 n = face.normal;
  const double mean = dot(n, face.middle);
  double support = -kInfinity;
  for (const uint32_t i : face.loop) support = std::max(support, dot(n, surface.points[i]));
  std::string reason;
  tree.search(
      n, face.middle,
      [&](double height, double distance) {
        return reason.empty() &&
               (height > support || height - mean > forgiven(surface, face, distance));
      },
      [&](const CornerTree::Corner& corner) {
        const double height = dot(n, corner.place), beyond = height - mean;
        support = std::max(support, height);
        if (beyond > forgiven(surface, face, length(corner.place - face.middle)))
          reason = not_convex(corner.number, beyond, face);
      });
  if (!reason.empty()) return reason;
  return Plane{n, support};
}

/// How far below the plane the face reaches.
double depth(const Surface& surface, const Face& face, const Plane& plane) {
  double lowest = plane.d;
  for (const uint32_t i : face.loop) lowest = std::min(lowest, dot(plane.n, surface.points[i]));
  return plane.d - lowest;
}

/// Marks the face and all that hang together with it in its plane.
void mark_plane(const Surface& surface, const Plane& plane, uint32_t seed,
                std::vector<bool>& has_plane) {
  // A needle's sides are near one another's planes all along.
  const double allowed = std::min(kSamePlane * surface.size, kSameOfThin * surface.thickness);
  const auto is_in_plane = [&](const Face& face) {
    if (surface.has_direction(face) && !(dot(plane.n, face.normal) > 0)) return false;
    return std::ranges::all_of(face.loop, [&](uint32_t i) {
      return std::fabs(dot(plane.n, surface.points[i]) - plane.d) <= allowed;
    });
  };
  has_plane[seed] = true;
  std::vector<uint32_t> open{seed};
  while (!open.empty()) {
    const uint32_t face = open.back();
    open.pop_back();
    all_edges(surface.faces[face].loop, [&](uint32_t a, uint32_t b) {
      const uint32_t neighbour = *surface.edges.find(b, a);
      if (!has_plane[neighbour] && is_in_plane(surface.faces[neighbour])) {
        has_plane[neighbour] = true;
        open.push_back(neighbour);
      }
      return true;
    });
  }
}

}  // namespace

Verdict build_planes(Polyhedron& polyhedron) {
  polyhedron.planes.clear();
  polyhedron.rise = 0;
  Surface surface{.points = polyhedron.points, .faces = {}, .corners = {}, .edges = {}};
  const std::vector<Vec3>& points = surface.points;

  const std::vector<uint32_t> merged = merge_equal_points(points);
  std::vector<bool> used(points.size());
  Box box;
  bool all_finite = true;
  for (uint32_t f = 0; f < polyhedron.faces.size(); ++f) {
    const Loop& given = polyhedron.faces[f];
    if (given.size() < 3) continue;
    for (const uint32_t i : given)
      if (i >= points.size())
        return {.refusal = fmt::format("face {} uses point {}, but the points are 0 to {}", f, i,
                                       int64_t(points.size()) - 1)};
    Face face{.number = f, .loop = clean_loop(given, merged)};
    if (face.loop.size() < 3) continue;
    for (const uint32_t i : face.loop) {
      all_finite = all_finite && is_finite(points[i]);
      if (used[i]) continue;
      used[i] = true;
      surface.corners.push_back({.place = points[i], .normal = {}, .number = i});
      box.include(points[i]);
    }
    surface.faces.push_back(std::move(face));
  }
  std::vector<Face>& faces = surface.faces;
  const double size = surface.size = box.diagonal();
  if (!all_finite || faces.empty() || !(size > 0) || !std::isfinite(size * size * size)) return {};
  for (Face& face : faces) measure(face, points);
  surface.thickness = thickness(surface);
  if (!(surface.thickness > kFlatSolid * size)) return {};
  surface.stray = stray(box);
  const bool inside_out = volume(surface, box.center()) < 0;
  if (inside_out)
    for (Face& face : faces) face.normal = -face.normal;
  Verdict verdict = cut_bent_faces(surface, inside_out);
  if (!verdict.refusal.empty()) return verdict;
  if (auto reason = find_dent(surface)) return {.refusal = std::move(*reason)};
  if (auto reason = check_closed(faces, surface.edges)) return {.refusal = std::move(*reason)};

  // Widest first: the direction of a sliver is the least certain, so that a sliver in the plane of
  // a larger face goes with it.
  std::vector<uint32_t> order(faces.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, std::ranges::greater{},
                           [&](uint32_t f) { return faces[f].width; });
  const CornerTree tree = make_tree(surface);
  std::vector<Plane> planes;
  std::vector<bool> has_plane(faces.size());
  double rise = 0;
  for (const uint32_t f : order) {
    if (has_plane[f] || !surface.has_direction(faces[f])) continue;
    std::variant<Plane, std::string> plane = supporting_plane(surface, faces[f], tree);
    if (auto* const reason = std::get_if<std::string>(&plane))
      return {.refusal = std::move(*reason)};
    planes.push_back(std::get<Plane>(plane));
    mark_plane(surface, planes.back(), f, has_plane);
    rise = std::max(rise, std::min(depth(surface, faces[f], planes.back()), faces[f].width));
  }
  polyhedron.planes = std::move(planes);
  polyhedron.rise = rise;
  // The corners of cut faces bound facets of their own.
  if (!verdict.remark.empty()) {
    polyhedron.faces.clear();
    for (Face& face : faces) polyhedron.faces.push_back(std::move(face.loop));
  }
  if (verdict.remark.empty() && std::min(surface.stray, rise) > kCoarse * size)
    verdict.remark = fmt::format(
        "six digits so far from the origin leave its faces uncertain; some are moved by {:.3g}",
        rise);
  return verdict;
}

}  // namespace whittle
