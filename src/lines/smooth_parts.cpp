#include "lines/smooth_parts.h"

#include <cmath>
#include <limits>

#include "base/degrees.h"

namespace whittle {
namespace {

Vec3 normal_of(const Hit& hit) {
  return {double(hit.normal.x), double(hit.normal.y), double(hit.normal.z)};
}

/// Whether two points that are near one another in the drawing lie on one smooth surface: each in
/// the other's tangent plane, nearly, and no farther away than `farthest`.
bool is_smooth(const Ray& ray_a, const Hit& a, const Ray& ray_b, const Hit& b, double farthest) {
  constexpr double kSlope = 0.1;
  if (!a.hit() || !b.hit()) return false;
  if (dot(normal_of(a), normal_of(b)) < cos_degrees(kCrease)) return false;
  const Vec3 way = ray_b.origin + ray_b.direction * double(b.distance) -
                   (ray_a.origin + ray_a.direction * double(a.distance));
  const double apart = length(way), most = kSlope * apart;
  return apart <= farthest && std::fabs(dot(normal_of(a), way)) <= most &&
         std::fabs(dot(normal_of(b), way)) <= most;
}

/// Asks about many parts at once.
class Asker {
 public:
  Asker(const Projection& projection, Tracer& tracer, std::vector<bool>& smooth)
      : projection_(projection), tracer_(tracer), smooth_(smooth) {}

  void add(size_t number, const LinePart& part, const DrawnLine& line, double stray,
           bool is_visible) {
    const double beside = stray * projection_.fineness();
    const double middle = (part.from + part.to) / 2;
    const Vec3 point = projection_.point(line, middle);
    const double in_space = beside / projection_.units_at(projection_.depth(point));
    const Vec2 way = line.b - line.a, at = line.at(middle);
    const Vec2 across = Vec2{-way.y, way.x} * (beside / length(way));
    // What is before a hidden edge is passed, and what is far behind it is not there.
    double start = 0, end = std::numeric_limits<double>::infinity();
    if (!is_visible) {
      projection_.ray_to(point, start);
      end = start + kFarthest * in_space;
      start -= 4 * in_space;
    }
    for (const Vec2 place : {at - across, at + across}) {
      rays_.push_back(projection_.ray_at(place));
      if (!is_visible) rays_.back().t_min = start;
    }
    asked_.push_back({number, kFarthest * in_space, end});
    if (rays_.size() >= kAtOnce) ask();
  }

  void ask() {
    hits_.resize(rays_.size());
    tracer_.cast(rays_, hits_);
    for (size_t i = 0; i < asked_.size(); ++i) {
      const Hit &a = hits_[2 * i], &b = hits_[2 * i + 1];
      const bool is_nothing = a.distance > asked_[i].end && b.distance > asked_[i].end;
      smooth_[asked_[i].number] =
          is_nothing || is_smooth(rays_[2 * i], a, rays_[2 * i + 1], b, asked_[i].farthest);
    }
    rays_.clear(), asked_.clear();
  }

 private:
  static constexpr size_t kAtOnce = size_t(1) << 16;
  /// A surface that is seen aslant goes farther than the places are apart.
  static constexpr double kFarthest = 100;
  struct Asked {
    size_t number;
    double farthest;  ///< between the points of one surface
    double end;       ///< of the rays
  };
  const Projection& projection_;
  Tracer& tracer_;
  std::vector<bool>& smooth_;
  std::vector<Ray> rays_;
  std::vector<Asked> asked_;
  std::vector<Hit> hits_;
};

}  // namespace

std::vector<bool> smooth_parts(std::span<const LinePart> parts, std::span<const DrawnLine> lines,
                               std::span<const SolidEdge> edges, const std::vector<bool>& visible,
                               const Projection& projection, Tracer& tracer) {
  std::vector<bool> smooth(parts.size(), false);
  Asker asker(projection, tracer, smooth);
  for (size_t i = 0; i < parts.size(); ++i) {
    const DrawnLine& line = lines[parts[i].line];
    const double stray = edges[line.edge].stray;
    if (stray > 0) asker.add(i, parts[i], line, stray, visible[i]);
  }
  asker.ask();
  return smooth;
}

}  // namespace whittle
