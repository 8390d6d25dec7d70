#include "evaluate/convex_hull.h"

#include <libqhull_r/qhull_ra.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <utility>

#include "base/box.h"
#include "shape/build_planes.h"

namespace whittle {
namespace {

/// The point farthest from `from` by what `distance` says, and how far.
template <class Distance>
std::pair<size_t, double> farthest(std::span<const Vec3> points, const Distance& distance) {
  std::pair<size_t, double> best{0, 0};
  for (size_t i = 0; i < points.size(); ++i) {
    const double d = distance(points[i]);
    if (d > best.second) best = {i, d};
  }
  return best;
}

/// True if no tetrahedron of the points is thicker than rounding.
bool is_flat(std::span<const Vec3> points, double least) {
  if (points.size() < 4) return true;
  const Vec3 a = points[0];
  const auto [ib, ab] = farthest(points, [&](Vec3 p) { return length(p - a); });
  if (!(ab > least)) return true;
  const Vec3 axis = (points[ib] - a) / ab;
  const auto across = [&](Vec3 p) { return (p - a) - axis * dot(p - a, axis); };
  const auto [ic, ac] = farthest(points, [&](Vec3 p) { return length(across(p)); });
  if (!(ac > least)) return true;
  const Vec3 normal = normalize(cross(axis, across(points[ic])));
  double low = 0, high = 0;
  for (const Vec3 p : points) {
    low = std::min(low, dot(p - a, normal));
    high = std::max(high, dot(p - a, normal));
  }
  return !(high - low > least);
}

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// Frees what Qhull holds.
class Hull {
 public:
  Hull() { qh_zero(&qh_, nullptr); }
  ~Hull() {
    qh_freeqhull(&qh_, !qh_ALL);
    int left = 0, total = 0;
    qh_memfreeshort(&qh_, &left, &total);
  }
  Hull(const Hull&) = delete;
  Hull& operator=(const Hull&) = delete;

  /// Corner loops, clockwise seen from outside; none if Qhull gives up.
  std::vector<std::vector<uint32_t>> faces(std::vector<double>& coordinates) {
    // Qhull writes what it cannot do to a file.
    const std::unique_ptr<std::FILE, CloseFile> nowhere(std::fopen("/dev/null", "w"));
    char options[] = "qhull Pp";
    if (!nowhere || qh_new_qhull(&qh_, 3, int(coordinates.size() / 3), coordinates.data(), False,
                                 options, nullptr, nowhere.get()) != 0) {
      return {};
    }
    std::vector<std::vector<uint32_t>> faces;
    for (facetT* facet = qh_.facet_list; facet && facet->next; facet = facet->next) {
      faces.push_back(loop(facet, coordinates));
    }
    return faces;
  }

 private:
  std::vector<uint32_t> loop(facetT* facet, const std::vector<double>& coordinates) {
    std::vector<uint32_t> corners;
    setT* vertices = qh_facet3vertex(&qh_, facet);
    const int count = qh_setsize(&qh_, vertices);
    for (int k = 0; k < count; ++k) {
      const auto* const vertex = static_cast<const vertexT*>(SETelem_(vertices, k));
      corners.push_back(uint32_t(qh_pointid(&qh_, vertex->point)));
    }
    qh_settempfree(&qh_, &vertices);
    Vec3 area{};
    const auto at = [&](uint32_t i) {
      return Vec3{coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]};
    };
    for (size_t k = 2; k < corners.size(); ++k) {
      area += cross(at(corners[k - 1]) - at(corners[0]), at(corners[k]) - at(corners[0]));
    }
    const Vec3 outward{facet->normal[0], facet->normal[1], facet->normal[2]};
    if (dot(area, outward) > 0) std::reverse(corners.begin(), corners.end());
    return corners;
  }

  qhT qh_{};
};

}  // namespace

std::optional<Polyhedron> solid_hull(std::span<const Vec3> all) {
  Polyhedron solid;
  solid.points.assign(all.begin(), all.end());
  if (!std::all_of(all.begin(), all.end(), [](Vec3 p) { return is_finite(p); })) {
    return std::nullopt;
  }
  const auto before = [](Vec3 a, Vec3 b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
  };
  std::sort(solid.points.begin(), solid.points.end(), before);
  solid.points.erase(std::unique(solid.points.begin(), solid.points.end()), solid.points.end());
  Box box;
  for (const Vec3 p : solid.points) box.include(p);
  if (is_flat(solid.points, kFlatSolid * box.diagonal())) return std::nullopt;
  // About the middle and of size 1, where Qhull's own tolerances are small.
  const Vec3 middle = box.center();
  const double scale = 1 / max_component(box.size());
  std::vector<double> coordinates;
  coordinates.reserve(3 * solid.points.size());
  for (const Vec3 p : solid.points) {
    const Vec3 q = (p - middle) * scale;
    coordinates.insert(coordinates.end(), {q.x, q.y, q.z});
  }
  solid.faces = Hull().faces(coordinates);
  // Only the corners of the hull stay.
  std::vector<uint32_t> number(solid.points.size(), UINT32_MAX);
  std::vector<Vec3> corners;
  for (auto& face : solid.faces) {
    for (uint32_t& i : face) {
      if (number[i] == UINT32_MAX) {
        number[i] = uint32_t(corners.size());
        corners.push_back(solid.points[i]);
      }
      i = number[i];
    }
  }
  solid.points = std::move(corners);
  if (!build_planes(solid).refusal.empty() || solid.planes.empty()) return std::nullopt;
  return solid;
}

}  // namespace whittle
