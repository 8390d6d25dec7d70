#include "lines/smooth_parts.h"

#include <cmath>
#include <limits>

#include "base/degrees.h"

namespace whittle {
namespace {

/// How two places of one surface may differ.
struct Likeness {
  double least_cosine;  ///< between their normals
  double slope;         ///< the sine by which each may be out of the other's tangent plane
};

struct Seen {
  Vec3 point, normal;
};

bool is_smooth(const Seen& a, const Seen& b, const Likeness& likeness, double farthest) {
  if (dot(a.normal, b.normal) < likeness.least_cosine) return false;
  const Vec3 way = b.point - a.point;
  const double apart = length(way), most = likeness.slope * apart;
  return apart <= farthest && std::fabs(dot(a.normal, way)) <= most &&
         std::fabs(dot(b.normal, way)) <= most;
}

/// Asks about many parts at once.
class Asker {
 public:
  Asker(const ViewProjection& projection, Tracer& tracer, const Likeness& likeness,
        std::vector<bool>& smooth)
      : projection_(projection), tracer_(tracer), likeness_(likeness), smooth_(smooth) {}

  void add(size_t number, const LinePart& part, const DrawnLine& line, const SolidEdge& edge,
           bool is_visible) {
    const double beside = edge.stray * projection_.fineness();
    const double middle = (part.from + part.to) / 2;
    const Vec3 point = projection_.point(line, middle);
    const double in_space = beside / projection_.units_at(projection_.depth(point));
    const double farthest = edge.doubt == Doubt::kFold ? edge.fold : kFarthest * in_space;
    const Vec2 way = line.b - line.a, at = line.at(middle);
    const Vec2 across = Vec2{-way.y, way.x} * (beside / length(way));
    // What is before a hidden edge is passed, and what is far behind it is not there.
    double start = 0, end = std::numeric_limits<double>::infinity();
    if (!is_visible) {
      projection_.ray_to(point, start);
      end = start + farthest;
      start -= 4 * in_space;
    }
    for (const Vec2 place : {at - across, at + across}) {
      rays_.push_back(projection_.ray_at(place));
      if (!is_visible) rays_.back().t_min = start;
    }
    asked_.push_back({number, farthest, end});
    if (rays_.size() >= kAtOnce) ask();
  }

  void ask() {
    hits_.resize(rays_.size());
    tracer_.cast(rays_, hits_);
    for (size_t i = 0; i < asked_.size(); ++i) {
      const Hit &a = hits_[2 * i], &b = hits_[2 * i + 1];
      const bool is_nothing = a.distance > asked_[i].end && b.distance > asked_[i].end;
      smooth_[asked_[i].number] =
          is_nothing || (a.hit() && b.hit() &&
                         is_smooth(seen(2 * i), seen(2 * i + 1), likeness_, asked_[i].farthest));
    }
    rays_.clear(), asked_.clear();
  }

 private:
  static constexpr size_t kAtOnce = size_t(1) << 16;
  /// A surface that is seen aslant goes farther than the places are apart.
  static constexpr double kFarthest = 100;
  struct Asked {
    size_t number;
    double farthest;  ///< between places of one surface
    double end;       ///< of the rays
  };

  Seen seen(size_t i) const {
    return {rays_[i].origin + rays_[i].direction * double(hits_[i].distance),
            to_double(hits_[i].normal)};
  }

  const ViewProjection& projection_;
  Tracer& tracer_;
  const Likeness& likeness_;
  std::vector<bool>& smooth_;
  std::vector<Ray> rays_;
  std::vector<Asked> asked_;
  std::vector<Hit> hits_;
};

}  // namespace

void mark_smooth_parts(Doubt doubt, std::span<const LinePart> parts,
                       std::span<const DrawnLine> lines, std::span<const SolidEdge> edges,
                       const std::vector<bool>& visible, const ViewProjection& projection,
                       Tracer& tracer, std::vector<bool>& smooth) {
  const Likeness likeness = doubt == Doubt::kFold ? Likeness{cos_degrees(kCreaseOfBody), 0.25}
                                                  : Likeness{cos_degrees(kCrease), 0.1};
  Asker asker(projection, tracer, likeness, smooth);
  for (size_t i = 0; i < parts.size(); ++i) {
    const DrawnLine& line = lines[parts[i].line];
    const SolidEdge& edge = edges[line.edge];
    if (edge.doubt == doubt) asker.add(i, parts[i], line, edge, visible[i]);
  }
  asker.ask();
}

}  // namespace whittle
