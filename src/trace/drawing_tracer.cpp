#include "trace/drawing_tracer.h"

#include <algorithm>
#include <cmath>

namespace whittle {
namespace {

/// Rays at a time, so that little is kept of a large picture.
constexpr size_t kRaysPerBatch = size_t(1) << 18;
constexpr size_t kRaysPerTask = 4096;

}  // namespace

DrawingTracer::DrawingTracer(Tracer& slab, const Box& box, const Workers& workers)
    : slab_(slab), box_(box), workers_(workers) {}

Frame DrawingTracer::render(const Camera& camera, const RenderControl& control) {
  Frame frame = Frame::unfilled(camera.width, camera.height);
  const size_t width = size_t(camera.width), height = size_t(camera.height);
  const size_t rows = std::max<size_t>(1, kRaysPerBatch / width);
  for (size_t y = 0; y < height && !control.stop.stop_requested(); y += rows) {
    const size_t last = std::min(y + rows, height);
    const auto ray_of = [&](size_t i) {
      return camera.ray(double(i % width) + 0.5, double(y + i / width) + 0.5);
    };
    look((last - y) * width, ray_of, std::span(frame.hits).subspan(y * width));
    if (control.part_seen) control.part_seen(frame, {0, int(y), camera.width, int(last)});
    if (control.progress) control.progress(double(last) / double(height));
  }
  return frame;
}

void DrawingTracer::probe(const Camera& camera, std::span<const PixelPosition> positions,
                          std::span<Hit> hits) {
  const auto ray_of = [&](size_t i) {
    return camera.ray(double(positions[i].x), double(positions[i].y));
  };
  look(positions.size(), ray_of, hits);
}

void DrawingTracer::cast(std::span<const Ray> rays, std::span<Hit> hits) {
  look(
      rays.size(), [&](size_t i) { return rays[i]; }, hits);
}

void DrawingTracer::cast_through(std::span<const Ray> rays, RayCrossings& found) {
  std::vector<Hit> hits(rays.size());
  cast(rays, hits);
  found = {};
  for (const Hit& hit : hits) {
    if (hit.hit())
      found.all.push_back({double(hit.distance), hit.id, true, {0, 0, double(hit.normal.z)}});
    found.ends.push_back(found.all.size());
  }
}

template <class RayOf>
void DrawingTracer::look(size_t count, const RayOf& ray_of, std::span<Hit> hits) {
  meetings_.assign(count, Meeting{});
  workers_.for_parts(count, kRaysPerTask, [&](size_t first, size_t last, size_t) {
    for (size_t i = first; i < last; ++i) meetings_[i] = meet(ray_of(i));
  });
  const double above = box_.hi.z + box_.diagonal();
  down_.clear();
  for (const Meeting& meeting : meetings_) {
    if (meeting.normal != 0)
      down_.push_back({{meeting.point.x, meeting.point.y, above}, {0, 0, -1}, 0});
  }
  found_.assign(down_.size(), Hit{});
  slab_.cast(down_, found_);
  size_t next = 0;
  for (size_t i = 0; i < count; ++i) {
    const Meeting& meeting = meetings_[i];
    hits[i] = Hit{};
    if (meeting.normal == 0) continue;
    const Hit& below = found_[next++];
    if (below.hit()) hits[i] = {meeting.distance, below.id, {0, 0, meeting.normal}};
  }
}

DrawingTracer::Meeting DrawingTracer::meet(const Ray& ray) const {
  const double t = -ray.origin.z / ray.direction.z;
  if (box_.is_empty() || !(t > ray.t_min && std::isfinite(t))) return {};
  const Vec3 p = ray.origin + ray.direction * t;
  if (!(p.x >= box_.lo.x && p.x <= box_.hi.x && p.y >= box_.lo.y && p.y <= box_.hi.y)) return {};
  return {{p.x, p.y}, float(t), ray.direction.z < 0 ? 1.0f : -1.0f};
}

}  // namespace whittle
