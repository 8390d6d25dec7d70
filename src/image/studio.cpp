#include "image/studio.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "base/result.h"
#include "image/edge_pixels.h"
#include "image/feature_lines.h"
#include "image/ground.h"
#include "image/occlusion.h"
#include "image/shadows.h"

namespace whittle {
namespace {

/// Samples traced at a time: enough to keep a tracer's threads busy, and little enough to stay in
/// the processor's caches.
constexpr size_t kSamplesPerBatch = size_t(1) << 16;
constexpr size_t kPixelsPerTask = 64, kRowsPerTask = 16;
/// How much darker than its surface a line is.
constexpr float kLineDarkness = 0.5f;

OcclusionSettings occlusion_settings(Quality quality, double reach) {
  if (quality == Quality::kBest) return {.reach = reach, .rays = 16, .step = 1};
  return {.reach = reach, .rays = 1, .step = 4};
}

/// Quantiles of the tent over -1..1, at the middles of n * n equal parts.
std::vector<float> tent(size_t parts) {
  std::vector<float> at;
  for (size_t i = 0; i < parts; ++i) {
    const double u = (double(i) + 0.5) / double(parts);
    at.push_back(float(u < 0.5 ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u)));
  }
  return at;
}

/// Sample positions about the middle of a pixel: an n * n grid, sheared so that each has a column
/// and a row of its own, which is what edges that are nearly upright or level need.
std::vector<PixelPosition> sample_offsets(size_t n) {
  const std::vector<float> at = tent(n * n);
  std::vector<PixelPosition> offsets;
  for (size_t b = 0; b < n; ++b)
    for (size_t a = 0; a < n; ++a) offsets.push_back({at[a * n + b], at[b * n + a]});
  return offsets;
}

/// What tasks work with.
struct Scratch {
  SeenHits seen;
  Colors colors, means;
  std::vector<PixelPosition> places;
  std::vector<uint8_t> rgba;
  VeilScratch veil;
};

class Studio {
 public:
  Studio(Tracer& tracer, const Camera& camera, const Frame& frame,
         std::span<const Appearance> appearances, const ShadeSettings& settings,
         const Workers& workers, const std::stop_token& stop, Veil* veil)
      : tracer_(tracer),
        camera_(camera),
        frame_(frame),
        settings_(settings),
        workers_(workers),
        stop_(stop),
        veil_(veil),
        shader_(camera, appearances, settings),
        shadow_finder_(tracer, camera, settings, workers),
        scratch_(workers),
        differences_(later_differences(frame, camera, workers, kCosEdge)) {
    if (settings.shadows) shadows_ = shadow_finder_.of_frame(frame);
    const double reach = kOcclusionReach * settings.solid.diagonal();
    if (settings.quality == Quality::kDraft || settings.is_drawing || !(reach > 0) ||
        !std::isfinite(reach))
      return;
    openness_ =
        openness(tracer, camera, frame, occlusion_settings(settings.quality, reach), workers, stop);
    if (!settings.ground) return;
    grounds_.push_back({Ground(tracer, camera, frame, settings, workers, stop), 1});
    for (size_t i = 0; veil && i < veil->layers().size(); ++i) {
      const VeilLayer& layer = veil->layers()[i];
      if (layer.is_ghost) continue;
      grounds_.push_back(
          {Ground(*layer.tracer, camera, frame, settings, workers, stop), veil->shade(i)});
    }
  }

  /// Every pixel by what is seen through its middle.
  Picture draw_middles() {
    Picture picture = Picture::unfilled(frame_.width, frame_.height);
    const auto draw_rows = [&](size_t begin, size_t end, const VeilSight* sight) {
      workers_.for_parts(end - begin, kRowsPerTask, [&](size_t first, size_t last, size_t worker) {
        for (size_t y = begin + first; y < begin + last; ++y)
          draw_row(y, begin, sight, scratch_.of(worker), picture);
      });
    };
    if (veil_ == nullptr) {
      draw_rows(0, size_t(frame_.height), nullptr);
    } else {
      veil_->for_bands(frame_, workers_, differences_,
                       [&](size_t first, size_t last, const VeilSight& sight) {
                         if (!stop_.stop_requested()) draw_rows(first, last, &sight);
                       });
    }
    return picture;
  }

  /// Pixels at edges again, by samples.
  void draw_edges(size_t n, Picture& picture) {
    const size_t width = size_t(frame_.width), samples = n * n;
    std::vector<uint8_t> mask = edge_mask(differences_, width, workers_);
    if (settings_.shadows) add_shadow_edges(shadows_, width, mask);
    const std::vector<size_t> edges = places_in_blocks(mask, width);
    const std::vector<PixelPosition> offsets = sample_offsets(n);
    const size_t batch = std::max<size_t>(1, kSamplesPerBatch / samples);
    std::vector<PixelPosition> places;
    std::vector<Hit> hits;
    std::vector<uint8_t> shadows;
    std::vector<float> open;
    VeilSight sight, middle_sight;
    std::vector<PixelPosition> middles;
    std::vector<Hit> middle_hits;
    for (size_t first = 0; first < edges.size() && !stop_.stop_requested(); first += batch) {
      const auto pixels = std::span(edges).subspan(first, std::min(batch, edges.size() - first));
      places.clear();
      for (const size_t pixel : pixels)
        for (const PixelPosition offset : offsets)
          places.push_back(
              {float(pixel % width) + 0.5f + offset.x, float(pixel / width) + 0.5f + offset.y});
      hits.assign(places.size(), Hit{});
      tracer_.probe(camera_, places, hits);
      if (settings_.shadows) shadow_finder_.find(hits, places, shadows);
      open.assign(openness_.empty() ? 0 : places.size(), 1);
      if (veil_) {
        middles.clear(), middle_hits.clear();
        for (const size_t pixel : pixels) {
          middles.push_back(middle(pixel));
          middle_hits.push_back(frame_.hits[pixel]);
        }
        veil_->look(places, hits, sight);
        veil_->look(middles, middle_hits, middle_sight);
      }
      workers_.for_parts(
          pixels.size(), kPixelsPerTask, [&](size_t begin, size_t end, size_t worker) {
            Scratch& own = scratch_.of(worker);
            const auto of_part = [&](auto& all) {
              using T = const typename std::remove_reference_t<decltype(all)>::value_type;
              if (all.empty()) return std::span<T>();
              return std::span<T>(all).subspan(begin * samples, (end - begin) * samples);
            };
            own.means.resize(end - begin);
            std::vector<Spot> spots;
            std::vector<float> lines(end - begin);
            for (size_t k = begin; k < end; ++k) {
              spots.clear();
              for (size_t s = k * samples; s < (k + 1) * samples; ++s)
                spots.emplace_back(camera_, places[s], hits[s]);
              lines[k - begin] = line_through(pixels[k], spots);
              if (!open.empty())
                find_openness(pixels[k], spots, std::span(open).subspan(k * samples, samples));
            }
            shader_.samples(of_part(hits), of_part(places), {of_part(shadows), of_part(open)},
                            own.seen, own.colors);
            for (size_t k = begin; k < end; ++k)
              draw_line(std::span(places).subspan(k * samples, samples),
                        std::span(hits).subspan(k * samples, samples), lines[k - begin], own,
                        (k - begin) * samples);
            if (veil_) lay_veil(sight, middle_sight, begin, end, samples, own);
            for (size_t k = begin; k < end; ++k)
              find_mean(samples, own, (k - begin) * samples, k - begin);
            own.rgba.resize(4 * own.means.size);
            shader_.store(own.means, own.rgba.data());
            for (size_t k = begin; k < end; ++k)
              std::memcpy(&picture.rgba[4 * pixels[k]], &own.rgba[4 * (k - begin)], 4);
          });
    }
  }

 private:
  /// A shadow on the ground, and how much of the light it keeps away.
  struct CastShadow {
    Ground ground;
    float strength = 1;
  };

  /// A row; the veil's places begin with row `begin`.
  void draw_row(size_t y, size_t begin, const VeilSight* sight, Scratch& own, Picture& picture) {
    const size_t width = size_t(frame_.width);
    own.places.clear();
    for (size_t x = 0; x < width; ++x) own.places.push_back({float(x) + 0.5f, float(y) + 0.5f});
    const auto hits = std::span(&frame_.hits[y * width], width);
    shader_.samples(hits, own.places, reaching(y * width, width), own.seen, own.colors);
    for (size_t x = 0; x < width; ++x)
      if (!hits[x].hit()) darken_ground(own.places[x], own.colors, x);
    if (sight) {
      veil_->find_walls(*sight, (y - begin) * width, width, own.veil);
      veil_->cover(own.places, own.veil, own.colors, 0);
    }
    shader_.store(own.colors, picture.at(0, int(y)));
  }

  /// Lays what is see-through over the samples of some pixels, which are own.colors.
  void lay_veil(const VeilSight& sight, const VeilSight& middle_sight, size_t begin, size_t end,
                size_t samples, Scratch& own) const {
    VeilScratch middles;
    veil_->find_walls(middle_sight, begin, end - begin, middles);
    veil_->find_walls(sight, begin * samples, (end - begin) * samples, own.veil);
    const auto places = sight.places.subspan(begin * samples, (end - begin) * samples);
    for (size_t k = 0; k < end - begin; ++k) {
      const size_t first = k == 0 ? 0 : middles.ends[k - 1];
      veil_->draw_lines(places, k * samples, (k + 1) * samples,
                        std::span(middles.walls).subspan(first, middles.ends[k] - first),
                        middle_sight.places[begin + k], own.veil);
    }
    veil_->cover(places, own.veil, own.colors, 0);
  }

  Reaching reaching(size_t first, size_t count) const {
    const auto of = [&](const auto& all) {
      return all.empty()
                 ? std::span<const typename std::remove_cvref_t<decltype(all)>::value_type>()
                 : std::span(all).subspan(first, count);
    };
    return {of(shadows_), of(openness_)};
  }

  PixelPosition middle(size_t pixel) const {
    const size_t width = size_t(frame_.width);
    return {float(pixel % width) + 0.5f, float(pixel / width) + 0.5f};
  }
  Spot spot_of(size_t pixel) const { return {camera_, middle(pixel), frame_.hits[pixel]}; }

  void darken_ground(PixelPosition place, Colors& colors, size_t i) const {
    float shadow = 0;
    for (const CastShadow& cast : grounds_) {
      const float own = cast.strength * cast.ground.shadow(place.x, place.y);
      shadow = shadow == 0 ? own : 1 - (1 - shadow) * (1 - own);
    }
    if (!settings_.background) {
      colors.r[i] = colors.g[i] = colors.b[i] = 0;
      colors.alpha[i] = shadow;
      return;
    }
    for (std::vector<float>* v : {&colors.r, &colors.g, &colors.b}) (*v)[i] *= 1 - shadow;
  }

  /// How dark the line is that passes a pixel. Of an edge at distance d from its middle, a share of
  /// (1 - d)^2 / 2 of the samples lies beyond. 1 - d on either side is a line that weighs the same
  /// wherever it falls between pixels.
  float line_through(size_t pixel, std::span<const Spot> samples) const {
    const Spot here = spot_of(pixel);
    float sum = 0;
    for (const Spot& sample : samples) sum += line_between(here, sample);
    return std::min(1.0f, std::sqrt(2 * sum / float(samples.size())));
  }

  /// What samples of a pixel see of their surroundings: as much as the nearest pixel that shows the
  /// same face does; where none does, as much as the pixel itself.
  void find_openness(size_t pixel, std::span<const Spot> samples, std::span<float> open) const {
    const size_t width = size_t(frame_.width), height = size_t(frame_.height);
    const size_t x = pixel % width, y = pixel / width;
    std::vector<std::pair<Spot, float>> around;
    const auto add = [&](size_t px, size_t py) {
      const size_t at = py * width + px;
      if (frame_.hits[at].hit()) around.emplace_back(spot_of(at), openness_[at]);
    };
    add(x, y);
    for (size_t py = y - std::min<size_t>(y, 1); py < std::min(height, y + 2); ++py)
      for (size_t px = x - std::min<size_t>(x, 1); px < std::min(width, x + 2); ++px)
        if (px != x || py != y) add(px, py);
    for (size_t i = 0; i < samples.size(); ++i) {
      if (samples[i].id == 0 || around.empty()) continue;
      const auto is_same = [&](const auto& other) {
        constexpr float kLittle = 0.2f;
        return line_between(samples[i], other.first) < kLittle;
      };
      const auto same = std::ranges::find_if(around, is_same);
      open[i] = same != around.end() ? same->second : around.front().second;
    }
  }

  /// Darkens a pixel's samples, which stand at `first` in the colours: the ground, and lines.
  void draw_line(std::span<const PixelPosition> places, std::span<const Hit> hits, float line,
                 Scratch& own, size_t first) const {
    Colors& colors = own.colors;
    for (size_t k = 0; k < hits.size(); ++k) {
      const size_t s = first + k;
      if (!hits[k].hit()) {
        darken_ground(places[k], colors, s);
        continue;
      }
      // A sample brighter than white is white: a highlight must not outshine an edge's other side.
      for (std::vector<float>* v : {&colors.r, &colors.g, &colors.b})
        (*v)[s] = std::min((*v)[s], 1.0f) * (1 - kLineDarkness * line);
    }
  }

  /// The mean of a pixel's samples.
  static void find_mean(size_t samples, Scratch& own, size_t first, size_t pixel) {
    Vec3f sum;
    float alpha = 0;
    const Colors& colors = own.colors;
    for (size_t s = first; s < first + samples; ++s) {
      const Vec3f color = min(Vec3f{colors.r[s], colors.g[s], colors.b[s]}, Vec3f{1, 1, 1});
      sum += color * colors.alpha[s];
      alpha += colors.alpha[s];
    }
    const Vec3f mean = alpha > 0 ? sum / alpha : Vec3f{};
    own.means.r[pixel] = mean.x, own.means.g[pixel] = mean.y, own.means.b[pixel] = mean.z;
    own.means.alpha[pixel] = alpha / float(samples);
  }

  Tracer& tracer_;
  const Camera& camera_;
  const Frame& frame_;
  const ShadeSettings& settings_;
  const Workers& workers_;
  const std::stop_token stop_;
  Veil* const veil_;  ///< or null
  const Shader shader_;
  Shadows shadow_finder_;
  PerWorker<Scratch> scratch_;
  std::vector<uint8_t> differences_;
  std::vector<uint8_t> shadows_;  ///< or empty
  std::vector<float> openness_;   ///< or empty
  std::vector<CastShadow> grounds_;
};

}  // namespace

Picture shade_studio(Tracer& tracer, const Camera& camera, const Frame& frame,
                     std::span<const Appearance> appearances, const ShadeSettings& settings, int n,
                     const Workers& workers, const std::stop_token& stop, Veil* veil) {
  WHITTLE_CHECK(settings.style == Style::kStudio);
  Studio studio(tracer, camera, frame, appearances, settings, workers, stop, veil);
  Picture picture = studio.draw_middles();
  if (n > 1 && !stop.stop_requested()) studio.draw_edges(size_t(n), picture);
  return picture;
}

}  // namespace whittle
