// Every plane is pushed out until it supports all corners, so the solid holds its own corners
// whatever their rounding. What rounding does to a plane's direction grows as the face gets
// narrower; the test for convexity allows for just that.
#include "model/polyhedron.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include <fmt/format.h>

#include "base/box.h"

namespace whittle {

namespace {

using Loop = std::vector<uint32_t>;

struct Face {
  uint32_t number;  ///< in the file, for messages
  Loop loop;        ///< corners, at least 3 different ones in a row
  Vec3 normal;      ///< unit
  double area = 0;
  double width = 0;  ///< how narrow the face is: area over its greatest reach
  Vec3 middle;
};

/// Corners by place: equal points get the number of the first of them.
std::vector<uint32_t> merge_equal_points(const std::vector<Vec3>& points) {
  std::map<std::tuple<double, double, double>, uint32_t> first;
  std::vector<uint32_t> merged(points.size());
  for (uint32_t i = 0; i < points.size(); ++i)
    merged[i] = first.try_emplace({points[i].x, points[i].y, points[i].z}, i).first->second;
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

/// Each edge must be run along once in each direction.
std::optional<std::string> check_closed(const std::vector<Face>& faces) {
  std::unordered_map<uint64_t, int> edges;
  const auto key = [](uint32_t a, uint32_t b) { return uint64_t{a} << 32 | b; };
  for (const Face& face : faces)
    for (size_t i = 0; i < face.loop.size(); ++i) {
      const uint32_t a = face.loop[i], b = face.loop[(i + 1) % face.loop.size()];
      if (++edges[key(a, b)] > 1)
        return fmt::format(
            "its faces are not turned the same way, or cross: the edge from point {} to {} is run "
            "along twice, the second time by face {}",
            a, b, face.number);
    }
  for (const Face& face : faces)
    for (size_t i = 0; i < face.loop.size(); ++i) {
      const uint32_t a = face.loop[i], b = face.loop[(i + 1) % face.loop.size()];
      if (!edges.contains(key(b, a)))
        return fmt::format("it is not closed: only face {} has the edge from point {} to {}",
                           face.number, a, b);
    }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> build_planes(Polyhedron& polyhedron) {
  const std::vector<Vec3>& points = polyhedron.points;
  polyhedron.planes.clear();

  const std::vector<uint32_t> merged = merge_equal_points(points);
  std::vector<Face> faces;
  std::vector<Vec3> corners;
  std::vector<uint32_t> corner_numbers;
  std::vector<bool> used(points.size());
  Box box;
  bool all_finite = true;
  for (uint32_t f = 0; f < polyhedron.faces.size(); ++f) {
    const Loop& given = polyhedron.faces[f];
    if (given.size() < 3) continue;
    for (const uint32_t i : given)
      if (i >= points.size())
        return fmt::format("face {} uses point {}, but the points are 0 to {}", f, i,
                           int64_t(points.size()) - 1);
    Face face{.number = f, .loop = clean_loop(given, merged), .normal = {}, .middle = {}};
    if (face.loop.size() < 3) continue;
    for (const uint32_t i : face.loop) {
      all_finite = all_finite && is_finite(points[i]);
      if (used[i]) continue;
      used[i] = true;
      corners.push_back(points[i]);
      corner_numbers.push_back(i);
      box.include(points[i]);
    }
    faces.push_back(std::move(face));
  }
  const double size = box.diagonal();
  if (!all_finite || faces.empty() || !(size > 0) || !std::isfinite(size * size * size)) return {};

  const Vec3 center = box.center();
  double volume = 0;
  const Face* largest = &faces[0];
  for (Face& face : faces) {
    const Vec3 area = area_vector(face.loop, points);
    double reach = 0;
    for (const uint32_t i : face.loop) {
      face.middle += points[i] / double(face.loop.size());
      reach = std::max(reach, length(points[i] - points[face.loop[0]]));
    }
    face.area = length(area);
    face.width = face.area / reach;
    face.normal = -normalize(area);
    volume += dot(face.middle - center, -area);
    if (face.area > largest->area) largest = &face;
  }

  const auto across = [&](Vec3 p) { return dot(p - largest->middle, largest->normal); };
  const auto [below, above] = std::ranges::minmax(corners, {}, across);
  if (!(across(above) - across(below) > kFlatSolid * size)) return {};

  if (const auto reason = check_closed(faces)) return reason;
  if (volume < 0)
    for (Face& face : faces) face.normal = -face.normal;

  // Widest first: the direction of a sliver is the least certain, so that a sliver in the plane of
  // a larger face goes with it.
  std::vector<const Face*> order(faces.size());
  std::ranges::transform(faces, order.begin(), [](const Face& f) { return &f; });
  std::ranges::stable_sort(order, std::ranges::greater{}, &Face::width);

  std::vector<Plane> planes;
  for (const Face* face : order) {
    // Too narrow to have a direction at all; its neighbours bound the solid there.
    if (!(face->width > kFlatSolid * kFlatSolid * size)) continue;
    const auto is_in = [&](const Plane& plane) {
      return dot(plane.n, face->normal) > 0 && std::ranges::all_of(face->loop, [&](uint32_t i) {
               return std::fabs(dot(plane.n, points[i]) - plane.d) <= kSamePlane * size;
             });
    };
    if (std::ranges::any_of(planes, is_in)) continue;

    const Vec3 n = face->normal;
    const double mean = dot(n, face->middle);
    for (const uint32_t i : face->loop)
      if (std::fabs(dot(n, points[i]) - mean) > kPolyhedronSlack * size)
        return fmt::format("face {} is not flat: point {} lies {:.3g} off it", face->number, i,
                           std::fabs(dot(n, points[i]) - mean));
    double support = -kInfinity;
    for (size_t c = 0; c < corners.size(); ++c) {
      const double height = dot(n, corners[c]);
      if (height <= support) continue;
      support = height;
      const double beyond = height - mean, distance = length(corners[c] - face->middle);
      if (beyond > kPolyhedronSlack * size * (1 + distance / face->width))
        return fmt::format("it is not convex: point {} lies {:.3g} outside face {}",
                           corner_numbers[c], beyond, face->number);
    }
    planes.push_back({n, support});
  }
  polyhedron.planes = std::move(planes);
  return std::nullopt;
}

}  // namespace whittle
