#include "image/antialias.h"

#include <algorithm>
#include <cstring>

#include "base/result.h"
#include "image/edge_pixels.h"
#include "image/shadows.h"

namespace whittle {
namespace {

/// Samples traced at a time: enough to keep a tracer's threads busy, and little enough to stay in
/// the processor's caches.
constexpr size_t kSamplesPerBatch = size_t(1) << 16;
constexpr size_t kPixelsPerTask = 64, kRowsPerTask = 16;
/// What a task that makes pixels of samples works with.
struct MeanScratch {
  SeenHits seen;
  Colors samples, means;
  std::vector<uint8_t> rgba;
  std::vector<PixelPosition> places;
  VeilScratch veil;
};

/// The mean of each pixel's samples, which are `n` a pixel.
void find_means(const Colors& samples, size_t n, Colors& means) {
  means.resize(samples.size / n);
  for (size_t pixel = 0; pixel < means.size; ++pixel) {
    Vec3f sum;
    float seen = 0;
    for (size_t s = pixel * n; s < (pixel + 1) * n; ++s) {
      if (samples.alpha[s] == 0) continue;
      // A sample brighter than white is white: a highlight must not outshine an edge's other side.
      sum +=
          min(Vec3f{samples.r[s], samples.g[s], samples.b[s]}, Vec3f{1, 1, 1}) * samples.alpha[s];
      seen += samples.alpha[s];
    }
    const Vec3f mean = seen == 0 ? Vec3f{} : sum / seen;
    means.r[pixel] = mean.x, means.g[pixel] = mean.y, means.b[pixel] = mean.z;
    means.alpha[pixel] = seen / float(n);
  }
}

/// shade(), with what is see-through laid over it; adds where that differs to `differences`.
Picture shade_veiled(const Frame& frame, const Shader& shader, std::span<const uint8_t> shadows,
                     Veil& veil, const Workers& workers, PerWorker<MeanScratch>& scratch,
                     std::vector<uint8_t>& differences) {
  Picture picture = Picture::unfilled(frame.width, frame.height);
  const size_t width = size_t(frame.width);
  const auto draw = [&](size_t begin, size_t end, const VeilSight& sight) {
    workers.for_parts(end - begin, kRowsPerTask, [&](size_t first, size_t last, size_t worker) {
      MeanScratch& own = scratch.of(worker);
      for (size_t row = first; row < last; ++row) {
        const size_t at = (begin + row) * width;
        own.places.clear();
        for (size_t x = 0; x < width; ++x)
          own.places.push_back({float(x) + 0.5f, float(begin + row) + 0.5f});
        shader.samples(std::span(&frame.hits[at], width), own.places,
                       {shadows.empty() ? shadows : shadows.subspan(at, width), {}}, own.seen,
                       own.samples);
        veil.find_walls(sight, row * width, width, own.veil);
        veil.cover(own.places, own.veil, own.samples, 0);
        shader.store(own.samples, picture.at(0, int(begin + row)));
      }
    });
  };
  veil.for_bands(frame, workers, differences, draw);
  return picture;
}

}  // namespace

Picture shade_antialiased(Tracer& tracer, const Camera& camera, const Frame& frame,
                          std::span<const Appearance> appearances, const ShadeSettings& settings,
                          int n, const Workers& workers, const std::stop_token& stop, Veil* veil) {
  WHITTLE_CHECK(settings.style != Style::kStudio);
  Shadows finder(tracer, camera, settings, workers);
  std::vector<uint8_t> shadows;
  if (settings.shadows) shadows = finder.of_frame(frame);
  const Shader shader(camera, appearances, settings);
  PerWorker<MeanScratch> scratch(workers);
  std::vector<uint8_t> differences;
  if (n > 1) differences = later_differences(frame, camera, workers, kCosEdge);
  Picture picture = veil
                        ? shade_veiled(frame, shader, shadows, *veil, workers, scratch, differences)
                        : shade(frame, camera, appearances, settings, workers, shadows);
  if (n <= 1) return picture;
  std::vector<uint8_t> mask = edge_mask(differences, size_t(frame.width), workers);
  if (settings.shadows) add_shadow_edges(shadows, size_t(frame.width), mask);
  const std::vector<size_t> edges = places_in_blocks(mask, size_t(frame.width));

  const size_t samples = size_t(n) * size_t(n), width = size_t(frame.width);
  const size_t batch = std::max<size_t>(1, kSamplesPerBatch / samples);
  std::vector<PixelPosition> positions;
  std::vector<Hit> hits;
  VeilSight sight;
  for (size_t first = 0; first < edges.size() && !stop.stop_requested(); first += batch) {
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
    if (settings.shadows) finder.find(hits, positions, shadows);
    if (veil) veil->look(positions, hits, sight);
    workers.for_parts(count, kPixelsPerTask, [&](size_t begin, size_t end, size_t worker) {
      MeanScratch& own = scratch.of(worker);
      const auto of_part = [&](auto& all) {
        return std::span(std::as_const(all)).subspan(begin * samples, (end - begin) * samples);
      };
      shader.samples(of_part(hits), of_part(positions),
                     {settings.shadows ? of_part(shadows) : std::span<const uint8_t>(), {}},
                     own.seen, own.samples);
      if (veil) {
        veil->find_walls(sight, begin * samples, (end - begin) * samples, own.veil);
        veil->cover(of_part(positions), own.veil, own.samples, 0);
      }
      find_means(own.samples, samples, own.means);
      own.rgba.resize(4 * own.means.size);
      shader.store(own.means, own.rgba.data());
      for (size_t k = begin; k < end; ++k)
        std::memcpy(&picture.rgba[4 * edges[first + k]], &own.rgba[4 * (k - begin)], 4);
    });
  }
  return picture;
}

}  // namespace whittle
