#include "image/antialias.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "base/result.h"
#include "image/edge_lanes.h"
#include "image/shadows.h"

namespace whittle {
namespace {

/// Samples traced at a time: enough to keep a tracer's threads busy, and little enough to stay in
/// the processor's caches.
constexpr size_t kSamplesPerBatch = size_t(1) << 16;
constexpr size_t kPixelsPerTask = 64;
/// Edge pixels are taken a block of so many pixels a side after the other: rays that are close to
/// one another are traced for less.
constexpr size_t kBlockSide = 4;
/// Each batch of hits is looked at from every light; many at a time, for backends that draw.
constexpr size_t kShadowsPerBatch = size_t(1) << 20;

/// Where the mask is set, block after block.
std::vector<size_t> set_places(const std::vector<uint8_t>& mask, size_t width) {
  std::vector<size_t> places;
  const size_t height = mask.size() / width;
  for (size_t y0 = 0; y0 < height; y0 += kBlockSide) {
    // The next place of each row.
    std::array<size_t, kBlockSide> next{};
    const size_t rows = std::min(kBlockSide, height - y0);
    const auto find_next = [&](size_t row, size_t from) {
      const auto start = mask.begin() + ptrdiff_t((y0 + row) * width);
      next[row] = size_t(std::find(start + ptrdiff_t(from), start + ptrdiff_t(width), 1) - start);
    };
    for (size_t row = 0; row < rows; ++row) find_next(row, 0);
    while (true) {
      const size_t first = *std::min_element(next.begin(), next.begin() + ptrdiff_t(rows));
      if (first == width) break;
      const size_t end = std::min(width, (first / kBlockSide + 1) * kBlockSide);
      for (size_t row = 0; row < rows; ++row)
        for (; next[row] < end; find_next(row, next[row] + 1))
          places.push_back((y0 + row) * width + next[row]);
    }
  }
  return places;
}

/// The shadows of a frame, one a pixel.
std::vector<uint8_t> shadows_of(const Frame& frame, Shadows& finder) {
  std::vector<uint8_t> shadows, some;
  shadows.reserve(frame.hits.size());
  std::vector<PixelPosition> places;
  const size_t width = size_t(frame.width);
  const size_t rows = std::max<size_t>(1, kShadowsPerBatch / width);
  for (size_t y = 0; y < size_t(frame.height); y += rows) {
    const size_t last = std::min(y + rows, size_t(frame.height));
    places.clear();
    for (size_t row = y; row < last; ++row)
      for (size_t x = 0; x < width; ++x) places.push_back({float(x) + 0.5f, float(row) + 0.5f});
    finder.find(std::span(frame.hits).subspan(y * width, places.size()), places, some);
    shadows.insert(shadows.end(), some.begin(), some.end());
  }
  return shadows;
}

/// Adds to the mask the pixels that are lit otherwise than one of their eight neighbours.
void add_shadow_edges(const std::vector<uint8_t>& shadows, size_t width,
                      std::vector<uint8_t>& mask) {
  const size_t height = shadows.size() / width;
  const auto compare = [&](size_t a, size_t b) {
    if (shadows[a] != shadows[b]) mask[a] = mask[b] = 1;
  };
  for (size_t y = 0; y < height; ++y) {
    for (size_t x = 0; x < width; ++x) {
      const size_t at = y * width + x;
      if (x + 1 < width) compare(at, at + 1);
      if (y + 1 == height) continue;
      compare(at, at + width);
      if (x > 0) compare(at, at + width - 1);
      if (x + 1 < width) compare(at, at + width + 1);
    }
  }
}

/// What a task that makes pixels of samples works with.
struct MeanScratch {
  SeenHits seen;
  Colors samples, means;
  std::vector<uint8_t> rgba;
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
      sum += min(Vec3f{samples.r[s], samples.g[s], samples.b[s]}, Vec3f{1, 1, 1});
      ++seen;
    }
    const Vec3f mean = seen == 0 ? Vec3f{} : sum / seen;
    means.r[pixel] = mean.x, means.g[pixel] = mean.y, means.b[pixel] = mean.z;
    means.alpha[pixel] = seen / float(n);
  }
}

}  // namespace

std::vector<uint8_t> edge_mask(const Frame& frame, const Camera& camera, const Workers& workers) {
  WHITTLE_CHECK(frame.width == camera.width && frame.height == camera.height);
  constexpr size_t kRowsPerTask = 16;
  const PixelRays rays(camera);
  const size_t width = size_t(frame.width), height = size_t(frame.height);
  std::vector<uint8_t> mask(frame.hits.size());
  workers.for_parts(height, kRowsPerTask, [&](size_t first, size_t last, size_t) {
    // Each pair of pixels is looked at from its earlier one, so the row before counts too.
    EdgeRow here(width), below(width);
    std::vector<uint8_t> above_bits(width), bits(width);
    const auto look = [&](size_t y, EdgeRow& row) {
      look_at_row(rays, std::span(&frame.hits[y * width], width), int(y), row);
    };
    const size_t start = first == 0 ? 0 : first - 1;
    look(start, below);
    for (size_t y = start; y < last; ++y) {
      std::swap(here, below);
      std::swap(above_bits, bits);
      if (y + 1 < height) look(y + 1, below);
      find_differences(here, y + 1 < height ? &below : nullptr, bits);
      if (y < first) continue;
      uint8_t* row = &mask[y * width];
      for (size_t x = 0; x < width; ++x) {
        unsigned found = bits[x] | (above_bits[x] & kBelow);
        if (x > 0) found |= (bits[x - 1] & kRight) | (above_bits[x - 1] & kBelowRight);
        if (x + 1 < width) found |= above_bits[x + 1] & kBelowLeft;
        row[x] = found != 0;
      }
    }
  });
  return mask;
}

Picture shade_antialiased(Tracer& tracer, const Camera& camera, const Frame& frame,
                          std::span<const Appearance> appearances, const ShadeSettings& settings,
                          int n, const Workers& workers, const std::stop_token& stop) {
  Shadows finder(tracer, camera, settings, workers);
  std::vector<uint8_t> shadows;
  if (settings.shadows) shadows = shadows_of(frame, finder);
  Picture picture = shade(frame, camera, appearances, settings, workers, shadows);
  if (n <= 1) return picture;
  const Shader shader(camera, appearances, settings);
  std::vector<uint8_t> mask = edge_mask(frame, camera, workers);
  if (settings.shadows) add_shadow_edges(shadows, size_t(frame.width), mask);
  const std::vector<size_t> edges = set_places(mask, size_t(frame.width));

  const size_t samples = size_t(n) * size_t(n), width = size_t(frame.width);
  const size_t batch = std::max<size_t>(1, kSamplesPerBatch / samples);
  std::vector<PixelPosition> positions;
  std::vector<Hit> hits;
  PerWorker<MeanScratch> scratch(workers);
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
    workers.for_parts(count, kPixelsPerTask, [&](size_t begin, size_t end, size_t worker) {
      MeanScratch& own = scratch.of(worker);
      const auto of_part = [&](auto& all) {
        return std::span(std::as_const(all)).subspan(begin * samples, (end - begin) * samples);
      };
      shader.samples(of_part(hits), of_part(positions),
                     settings.shadows ? of_part(shadows) : std::span<const uint8_t>(), own.seen,
                     own.samples);
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
