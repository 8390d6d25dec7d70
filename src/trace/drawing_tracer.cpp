#include "trace/drawing_tracer.h"

#include <algorithm>
#include <cmath>

namespace whittle {
namespace {

/// Rays at a time, so that little is kept of a large picture.
constexpr size_t kRaysPerBatch = size_t(1) << 20;
constexpr size_t kRaysPerTask = 4096;
/// Pixels a side of the picture from above. With about one for each ray, backends that draw find a
/// place for each in few drawings.
constexpr double kMostSide = 1 << 12;

}  // namespace

DrawingTracer::DrawingTracer(Tracer& slab, const Box& box, const Workers& workers)
    : slab_(slab), box_(box), workers_(workers) {}

Frame DrawingTracer::render(const Camera& camera, const Progress& progress) {
  Frame frame = Frame::unfilled(camera.width, camera.height);
  const size_t width = size_t(camera.width), height = size_t(camera.height);
  const size_t rows = std::max<size_t>(1, kRaysPerBatch / width);
  std::vector<PixelPosition> positions;
  for (size_t y = 0; y < height; y += rows) {
    const size_t last = std::min(y + rows, height);
    positions.clear();
    for (size_t row = y; row < last; ++row)
      for (size_t x = 0; x < width; ++x) positions.push_back({float(x) + 0.5f, float(row) + 0.5f});
    probe(camera, positions, std::span(frame.hits).subspan(y * width, positions.size()));
    if (progress) progress(double(last) / double(height));
  }
  return frame;
}

void DrawingTracer::probe(const Camera& camera, std::span<const PixelPosition> positions,
                          std::span<Hit> hits) {
  std::fill(hits.begin(), hits.end(), Hit{});
  if (box_.is_empty()) return;
  meet(camera, positions);
  const Camera above = look_down();
  const double scale = 1 / above.units_per_pixel();
  if (!std::isfinite(scale) || scale == 0) return;
  places_.clear();
  for (const Meeting& meeting : meetings_) {
    if (meeting.normal == 0) continue;
    places_.push_back({float((meeting.point.x - above.eye.x) * scale + 0.5 * above.width),
                       float((above.eye.y - meeting.point.y) * scale + 0.5 * above.height)});
  }
  if (places_.empty()) return;
  found_.assign(places_.size(), Hit{});
  slab_.probe(above, places_, found_);
  size_t next = 0;
  for (size_t i = 0; i < hits.size(); ++i) {
    const Meeting& meeting = meetings_[i];
    if (meeting.normal == 0) continue;
    const Hit& below = found_[next++];
    if (below.hit()) hits[i] = {meeting.distance, below.id, {0, 0, meeting.normal}};
  }
}

void DrawingTracer::meet(const Camera& camera, std::span<const PixelPosition> positions) {
  meetings_.assign(positions.size(), Meeting{});
  workers_.for_parts(positions.size(), kRaysPerTask, [&](size_t first, size_t last, size_t) {
    for (size_t i = first; i < last; ++i) {
      const Ray ray = camera.ray(double(positions[i].x), double(positions[i].y));
      const double t = -ray.origin.z / ray.direction.z;
      if (!(t > ray.t_min && std::isfinite(t))) continue;
      const Vec3 p = ray.origin + ray.direction * t;
      if (!(p.x >= box_.lo.x && p.x <= box_.hi.x && p.y >= box_.lo.y && p.y <= box_.hi.y)) continue;
      meetings_[i] = {{p.x, p.y}, float(t), ray.direction.z < 0 ? 1.0f : -1.0f};
    }
  });
}

/// A camera above all points that are met.
Camera DrawingTracer::look_down() const {
  Box seen;
  size_t count = 0;
  for (const Meeting& meeting : meetings_) {
    if (meeting.normal == 0) continue;
    seen.include({meeting.point.x, meeting.point.y, 0});
    ++count;
  }
  if (seen.is_empty()) seen = box_;
  const Vec3 size = seen.size(), whole = box_.size();
  const double longest = std::max(whole.x, whole.y);
  // Of few points, or of one, as large a part is looked at as floats tell places apart in.
  const double edge = std::max({size.x, size.y, 1e-6 * longest});
  const double side = std::clamp(std::ceil(std::sqrt(double(count))), 1.0, kMostSide);
  const double pixel = edge / side;
  const auto pixels = [&](double length) {
    return int(std::clamp(std::ceil(length / pixel), 1.0, side));
  };
  Camera camera;
  camera.width = pixels(size.x), camera.height = pixels(size.y);
  camera.eye = {seen.center().x, seen.center().y, box_.hi.z + longest};
  camera.right = {1, 0, 0}, camera.up = {0, 1, 0}, camera.forward = {0, 0, -1};
  camera.orthographic = true;
  camera.half_height = 0.5 * pixel * camera.height;
  return camera;
}

}  // namespace whittle
