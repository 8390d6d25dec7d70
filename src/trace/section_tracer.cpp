#include "trace/section_tracer.h"

#include <cmath>
#include <utility>

namespace whittle {
namespace {

constexpr size_t kHitsPerTask = 1024;
constexpr double kFloatRounding = 2e-7;

}  // namespace

SectionTracer::SectionTracer(Tracer& model, Cut ids, CapOwner owner, const Workers& workers)
    : model_(model), ids_(ids), owner_(std::move(owner)), workers_(workers) {}

uint32_t SectionTracer::id_at(uint32_t plane, const Ray& ray, double distance, Vec3 normal) const {
  // A hit knows its distance as a float; from far away that is more than the tolerance.
  const double off = kFloatRounding * std::fabs(distance);
  const uint32_t owner = owner_(ray.origin + ray.direction * distance - normal * off, normal);
  return owner == 0 ? plane : ids_.cap_of(owner);
}

template <class RayOf>
void SectionTracer::name_caps(const RayOf& ray_of, std::span<Hit> hits) const {
  workers_.for_parts(hits.size(), kHitsPerTask, [&](size_t first, size_t last, size_t) {
    for (size_t i = first; i < last; ++i) {
      Hit& hit = hits[i];
      if (ids_.is_plane(hit.id))
        hit.id = id_at(hit.id, ray_of(i), double(hit.distance), to_double(hit.normal));
    }
  });
}

Frame SectionTracer::render(const Camera& camera, const RenderControl& control) {
  Frame frame = model_.render(camera, control);
  if (control.stop.stop_requested()) return frame;
  const size_t width = size_t(frame.width);
  name_caps([&](size_t i) { return camera.ray(double(i % width) + 0.5, double(i / width) + 0.5); },
            frame.hits);
  return frame;
}

void SectionTracer::probe(const Camera& camera, std::span<const PixelPosition> positions,
                          std::span<Hit> hits) {
  model_.probe(camera, positions, hits);
  name_caps([&](size_t i) { return camera.ray(double(positions[i].x), double(positions[i].y)); },
            hits);
}

void SectionTracer::cast(std::span<const Ray> rays, std::span<Hit> hits) {
  model_.cast(rays, hits);
  name_caps([&](size_t i) { return rays[i]; }, hits);
}

void SectionTracer::cast_through(std::span<const Ray> rays, RayCrossings& found) {
  model_.cast_through(rays, found);
  workers_.for_parts(rays.size(), kHitsPerTask, [&](size_t first, size_t last, size_t) {
    for (size_t r = first; r < last; ++r) {
      const size_t begin = r == 0 ? 0 : found.ends[r - 1];
      for (size_t i = begin; i < found.ends[r]; ++i) {
        SurfaceCrossing& crossing = found.all[i];
        if (ids_.is_plane(crossing.id))
          crossing.id = id_at(crossing.id, rays[r], crossing.distance, crossing.normal);
      }
    }
  });
}

}  // namespace whittle
