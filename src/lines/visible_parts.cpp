#include "lines/visible_parts.h"

#include <algorithm>

namespace whittle {
namespace {

struct Look {
  Ray ray;
  double least;  ///< what the ray meets before this hides the part
};

Look look_at(const LinePart& part, const DrawnLine& line, const SolidEdge& edge,
             const ViewProjection& projection) {
  // In units of the drawing, and as a share of the part.
  constexpr double kBeside = 1e-3, kShare = 0.05;
  // Distances are floats.
  constexpr double kRounding = 1e-6;
  const Vec3 middle = projection.point(line, (part.from + part.to) / 2);
  const double long_ = length(projection.point(line, part.to) - projection.point(line, part.from));
  const double beside =
      std::min(kBeside / projection.units_at(projection.depth(middle)), kShare * long_);
  double distance = 0;
  const Ray ray = projection.ray_to(middle + edge.inward * beside, distance);
  // A face may be narrower than that, and the place beside it a little below its neighbour.
  return {ray, distance - 4 * beside - kRounding * std::fabs(distance)};
}

}  // namespace

std::vector<bool> visible_parts(std::span<const LinePart> parts, std::span<const DrawnLine> lines,
                                std::span<const SolidEdge> edges, const ViewProjection& projection,
                                Tracer& tracer, const Progress& progress) {
  constexpr size_t kAtOnce = size_t(1) << 16;
  std::vector<bool> visible(parts.size(), false);
  std::vector<Ray> rays;
  std::vector<double> least;
  std::vector<size_t> asked;
  std::vector<Hit> hits;
  const auto ask = [&] {
    hits.resize(rays.size());
    tracer.cast(rays, hits);
    for (size_t i = 0; i < asked.size(); ++i) visible[asked[i]] = !(hits[i].distance < least[i]);
    rays.clear(), least.clear(), asked.clear();
  };
  for (size_t i = 0; i < parts.size(); ++i) {
    const DrawnLine& line = lines[parts[i].line];
    const SolidEdge& edge = edges[line.edge];
    if (!edge.may_be_seen) continue;
    const Look look = look_at(parts[i], line, edge, projection);
    rays.push_back(look.ray), least.push_back(look.least), asked.push_back(i);
    if (rays.size() < kAtOnce) continue;
    ask();
    if (progress) progress(double(i) / double(parts.size()));
  }
  ask();
  return visible;
}

}  // namespace whittle
