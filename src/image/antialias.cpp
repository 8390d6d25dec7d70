#include "image/antialias.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/result.h"

namespace whittle {
namespace {

constexpr float kCosCrease = 0.99026806874157f;  ///< cos 8 degrees
constexpr float kDepthStepPixels = 2;
/// Samples traced at a time: enough to keep a tracer's threads busy, and bounded memory.
constexpr size_t kSamplesPerBatch = size_t(1) << 20;
constexpr size_t kPixelsPerTask = 64;

/// A hit with what its neighbours ask of it.
struct Seen {
  Vec3f direction, point;  ///< of its ray; of the hit, from the eye
  float step = 0;          ///< kDepthStepPixels in model units there
};

/// The distance along b's ray from b to the tangent plane of a is |n_a.(b - a)| / |n_a.d_b|.
bool off_plane(Vec3f normal, Vec3f between, Vec3f other_direction, float step) {
  return std::fabs(dot(normal, between)) > step * std::fabs(dot(normal, other_direction));
}

bool differ(const Hit& a, const Seen& seen_a, const Hit& b, const Seen& seen_b) {
  if (a.id != b.id) return true;
  if (!a.hit()) return false;
  if (dot(a.normal, b.normal) < kCosCrease) return true;
  const Vec3f between = seen_b.point - seen_a.point;
  const float step = std::max(seen_a.step, seen_b.step);
  return off_plane(a.normal, between, seen_b.direction, step) &&
         off_plane(b.normal, between, seen_a.direction, step);
}

void look_at_row(const Frame& frame, const PixelRays& rays, int y, std::vector<Seen>& row) {
  for (int x = 0; x < frame.width; ++x) {
    const Hit& hit = frame.at(x, y);
    if (!hit.hit()) continue;
    const float px = float(x) + 0.5f, py = float(y) + 0.5f;
    Seen& seen = row[size_t(x)];
    seen.direction = rays.direction(px, py);
    seen.point = rays.point(seen.direction, hit.distance, px, py);
    seen.step = kDepthStepPixels * rays.units_per_pixel * (rays.orthographic ? 1 : hit.distance);
  }
}

/// Neighbours that stand after a pixel, and the bit of each.
constexpr struct { int dx, dy; } kLater[] = {{1, 0}, {-1, 1}, {0, 1}, {1, 1}};

/// Writes the mean colour of one pixel's samples.
void store_mean(const Shader& shader, std::span<const Hit> hits,
                std::span<const PixelPosition> positions, uint8_t* rgba) {
  Vec3f sum;
  size_t seen = 0;
  for (size_t s = 0; s < hits.size(); ++s) {
    if (!hits[s].hit() && !shader.has_background()) continue;
    const Vec3f c = shader.color(hits[s], positions[s].x, positions[s].y);
    // A sample brighter than white is white: a highlight must not outshine an edge's other side.
    sum += min(c, Vec3f{1, 1, 1});
    ++seen;
  }
  if (seen == 0)
    std::fill_n(rgba, 4, uint8_t(0));
  else
    shader.store(sum / float(seen), float(seen) / float(hits.size()), rgba);
}

}  // namespace

std::vector<uint8_t> edge_mask(const Frame& frame, const Camera& camera, const Workers& workers) {
  WHITTLE_CHECK(frame.width == camera.width && frame.height == camera.height);
  constexpr size_t kRowsPerTask = 16;
  const PixelRays rays(camera);
  const size_t width = size_t(frame.width);
  // Each pair is looked at once, from its earlier pixel; a task writes its own rows only.
  std::vector<uint8_t> later(frame.hits.size());
  workers.for_parts(size_t(frame.height), kRowsPerTask, [&](size_t first, size_t last, size_t) {
    std::vector<Seen> here(width), below(width);
    look_at_row(frame, rays, int(first), below);
    for (int y = int(first); y < int(last); ++y) {
      std::swap(here, below);
      if (y + 1 < frame.height) look_at_row(frame, rays, y + 1, below);
      for (int x = 0; x < frame.width; ++x) {
        unsigned bits = 0;
        for (unsigned k = 0; k < std::size(kLater); ++k) {
          const int u = x + kLater[k].dx, v = y + kLater[k].dy;
          if (u < 0 || u >= frame.width || v >= frame.height) continue;
          bits |= unsigned(differ(frame.at(x, y), here[size_t(x)], frame.at(u, v),
                                  (v == y ? here : below)[size_t(u)]))
                  << k;
        }
        later[size_t(y) * width + size_t(x)] = uint8_t(bits);
      }
    }
  });
  std::vector<uint8_t> mask(frame.hits.size());
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      const unsigned bits = later[size_t(y) * width + size_t(x)];
      if (bits == 0) continue;
      mask[size_t(y) * width + size_t(x)] = 1;
      for (unsigned k = 0; k < std::size(kLater); ++k) {
        if (bits >> k & 1) mask[size_t(y + kLater[k].dy) * width + size_t(x + kLater[k].dx)] = 1;
      }
    }
  }
  return mask;
}

Picture shade_antialiased(Tracer& tracer, const Camera& camera, const Frame& frame,
                          std::span<const Appearance> appearances, const ShadeSettings& settings,
                          int n, const Workers& workers) {
  Picture picture = shade(frame, camera, appearances, settings, workers);
  if (n <= 1) return picture;
  const Shader shader(camera, appearances, settings);
  const std::vector<uint8_t> mask = edge_mask(frame, camera, workers);
  std::vector<size_t> edges;
  for (size_t i = 0; i < mask.size(); ++i) {
    if (mask[i]) edges.push_back(i);
  }

  const size_t samples = size_t(n) * size_t(n), width = size_t(frame.width);
  const size_t batch = std::max<size_t>(1, kSamplesPerBatch / samples);
  std::vector<PixelPosition> positions;
  std::vector<Hit> hits;
  for (size_t first = 0; first < edges.size(); first += batch) {
    const size_t count = std::min(batch, edges.size() - first);
    positions.clear();
    for (size_t k = 0; k < count; ++k) {
      const size_t x = edges[first + k] % width, y = edges[first + k] / width;
      for (int b = 0; b < n; ++b) {
        for (int a = 0; a < n; ++a) {
          positions.push_back(
              {float(x) + (float(a) + 0.5f) / float(n), float(y) + (float(b) + 0.5f) / float(n)});
        }
      }
    }
    hits.assign(positions.size(), Hit{});
    tracer.probe(camera, positions, hits);
    workers.for_parts(count, kPixelsPerTask, [&](size_t begin, size_t end, size_t) {
      for (size_t k = begin; k < end; ++k) {
        const std::span<const Hit> pixel_hits(&hits[k * samples], samples);
        const std::span<const PixelPosition> places(&positions[k * samples], samples);
        store_mean(shader, pixel_hits, places, &picture.rgba[4 * edges[first + k]]);
      }
    });
  }
  return picture;
}

}  // namespace whittle
