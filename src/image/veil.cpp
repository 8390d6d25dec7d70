#include "image/veil.h"

#include <algorithm>
#include <cmath>

#include "image/edge_lanes.h"
#include "image/edge_pixels.h"
#include "image/feature_lines.h"

namespace whittle {
namespace {

/// What is behind so much is not seen: less than a level of 255 is left of it.
constexpr float kLeastSeen = 1.0f / 1024;
/// How much darker than its wall a line is, and how much of what the wall lets through it hides.
constexpr float kLineDarkness = 0.5f, kLineCover = 0.35f;
/// Walls lie on one another if their normals are no farther apart.
constexpr float kCosParallel = 0.9999f;
/// The most that the distance of a hit, a float, is wrong by, as a share of it.
constexpr double kFloatError = 2e-7;
constexpr float kDepthStepPixels = 2;
constexpr size_t kRowsPerTask = 16;

Vec3f to_float(Vec3 v) {
  return {float(v.x), float(v.y), float(v.z)};
}

Hit hit_of(const VeilWall& wall) {
  return {float(wall.distance), wall.look, wall.normal};
}

bool differ(const Spot& a, const Spot& b) {
  return a.id != b.id || dot(a.normal, b.normal) < kCosEdge ||
         pixels_apart(a, b) > kDepthStepPixels;
}

}  // namespace

Veil::Veil(std::vector<VeilLayer> layers, std::span<const Appearance> looks, const Camera& camera,
           const ShadeSettings& settings, double tolerance)
    : layers_(std::move(layers)),
      shades_(layers_.size(), 0),
      camera_(camera),
      shader_(camera, looks, settings),
      tolerance_(tolerance) {
  opacities_.reserve(looks.size());
  for (const Appearance& look : looks) opacities_.push_back(std::max(0.0f, opacity(look)));
  for (size_t i = 0; i < layers_.size(); ++i)
    for (const Hit& hit : layers_[i].first.hits)
      if (hit.hit()) shades_[i] = std::max(shades_[i], opacities_[layers_[i].first_look + hit.id]);
}

void Veil::cast(size_t layer, std::span<const PixelPosition> places, VeilSight& sight) {
  rays_.clear();
  for (size_t i = 0; i < places.size(); ++i)
    if (sight.ray_of[layer][i] != VeilSight::kNone) {
      sight.ray_of[layer][i] = uint32_t(rays_.size());
      rays_.push_back(camera_.ray(double(places[i].x), double(places[i].y)));
    }
  RayCrossings& found = sight.crossings[layer];
  found.all.clear(), found.ends.clear();
  if (!rays_.empty()) layers_[layer].tracer->cast_through(rays_, found);
}

void Veil::look(std::span<const PixelPosition> places, std::span<const Hit> opaque,
                VeilSight& sight) {
  sight.places = places, sight.opaque = opaque;
  sight.crossings.resize(layers_.size()), sight.ray_of.resize(layers_.size());
  for (size_t layer = 0; layer < layers_.size(); ++layer) {
    sight.ray_of[layer].assign(places.size(), 0);
    cast(layer, places, sight);
  }
}

void Veil::look_at_rows(const Frame& opaque, size_t first, size_t last,
                        std::vector<PixelPosition>& places, VeilSight& sight) {
  const size_t width = size_t(opaque.width), count = (last - first) * width;
  places.clear();
  for (size_t y = first; y < last; ++y)
    for (size_t x = 0; x < width; ++x) places.push_back({float(x) + 0.5f, float(y) + 0.5f});
  sight.places = places;
  sight.opaque = std::span(opaque.hits).subspan(first * width, count);
  sight.crossings.resize(layers_.size()), sight.ray_of.resize(layers_.size());
  for (size_t layer = 0; layer < layers_.size(); ++layer) {
    const Hit* seen = &layers_[layer].first.hits[first * width];
    std::vector<uint32_t>& ray_of = sight.ray_of[layer];
    ray_of.resize(count);
    for (size_t i = 0; i < count; ++i) {
      // What is wholly behind what is opaque is not asked for.
      const float behind = sight.opaque[i].distance;
      const bool may_be_seen =
          seen[i].hit() &&
          seen[i].distance <= behind + 1e-5f * std::fabs(behind) + float(4 * tolerance_);
      ray_of[i] = may_be_seen ? 0 : VeilSight::kNone;
    }
    cast(layer, places, sight);
  }
}

/// Sorts the walls of a ray from `first` on, near ones before those behind, and those that lie on
/// one another by the rule: ghosts lie on what is there; a solid is left before another is entered,
/// but where that is opaque its surface is that of both; of two that are entered at once the
/// statement that comes first in the file is in front.
void Veil::order(Vec3 direction, std::vector<VeilWall>& walls, size_t first) const {
  const auto begin = walls.begin() + std::ptrdiff_t(first);
  std::stable_sort(begin, walls.end(),
                   [](const VeilWall& a, const VeilWall& b) { return a.distance < b.distance; });
  const Vec3f d = to_float(direction);
  const auto is_on = [&](const VeilWall& a, const VeilWall& b) {
    if (std::fabs(dot(a.normal, b.normal)) < kCosParallel) return false;
    const double gap = b.distance - a.distance;
    return gap * double(std::fabs(dot(a.normal, d))) <=
           2 * tolerance_ + kFloatError * std::fabs(a.distance);
  };
  for (auto run = begin; run != walls.end();) {
    auto end = run + 1;
    while (end != walls.end() && is_on(*run, *end)) ++end;
    if (end - run > 1) {
      const bool is_closed = std::any_of(
          run, end, [](const VeilWall& wall) { return wall.enters && wall.opacity >= 1; });
      const auto rank = [&](const VeilWall& wall) {
        if (layers_.size() > wall.layer && layers_[wall.layer].is_ghost) return 0;
        if (!wall.enters) return is_closed ? 3 : 1;
        return 2;
      };
      std::stable_sort(run, end, [&](const VeilWall& a, const VeilWall& b) {
        const int of_a = rank(a), of_b = rank(b);
        return of_a != of_b ? of_a < of_b : of_a == 2 && a.look < b.look;
      });
    }
    run = end;
  }
}

void Veil::find_walls(const VeilSight& sight, size_t first, size_t count,
                      VeilScratch& scratch) const {
  std::vector<VeilWall>& walls = scratch.walls;
  walls.clear(), scratch.ends.clear();
  for (size_t i = first; i < first + count; ++i) {
    const size_t begin = walls.size();
    for (uint32_t layer = 0; layer < layers_.size(); ++layer) {
      const uint32_t ray = sight.ray_of[layer][i];
      if (ray == VeilSight::kNone) continue;
      uint32_t index = 0;
      for (const SurfaceCrossing& crossing : sight.crossings[layer].of(ray)) {
        const uint32_t look = layers_[layer].first_look + crossing.id;
        walls.push_back({crossing.distance, look, layer, index++, to_float(crossing.normal),
                         look < opacities_.size() ? opacities_[look] : 1.0f, 0, crossing.enters});
      }
    }
    if (walls.size() > begin) {
      const Vec3 direction =
          camera_.ray(double(sight.places[i].x), double(sight.places[i].y)).direction;
      const Hit& hit = sight.opaque[i];
      if (hit.hit()) {
        VeilWall end{.distance = double(hit.distance), .look = hit.id, .normal = hit.normal};
        end.layer = uint32_t(layers_.size());
        end.enters = dot(hit.normal, to_float(direction)) <= 0;
        walls.push_back(end);
      }
      order(direction, walls, begin);
      // To what is opaque, or to where nothing can be seen.
      float left = 1;
      size_t kept = begin;
      for (size_t k = begin; k < walls.size() && left > kLeastSeen; ++k) {
        if (walls[k].layer == layers_.size()) break;
        if (walls[k].opacity <= 0) continue;
        left *= 1 - walls[k].opacity;
        walls[kept++] = walls[k];
      }
      walls.resize(kept);
    }
    scratch.ends.push_back(walls.size());
  }
}

void Veil::draw_lines(std::span<const PixelPosition> places, size_t first, size_t last,
                      std::span<const VeilWall> middle, PixelPosition middle_place,
                      VeilScratch& scratch) const {
  struct Line {
    uint32_t layer = 0, index = 0;
    Spot here;
    float sum = 0;
    size_t seen = 0;
  };
  std::vector<Line> lines;
  const auto line_of = [&](const VeilWall& wall) -> Line& {
    for (Line& line : lines)
      if (line.layer == wall.layer && line.index == wall.index) return line;
    return lines.emplace_back(Line{wall.layer, wall.index, Spot(camera_, middle_place, Hit{})});
  };
  for (const VeilWall& wall : middle)
    line_of(wall).here = Spot(camera_, middle_place, hit_of(wall));
  for (size_t i = first; i < last; ++i) {
    for (size_t k = i == 0 ? 0 : scratch.ends[i - 1]; k < scratch.ends[i]; ++k) {
      const VeilWall& wall = scratch.walls[k];
      Line& line = line_of(wall);
      line.sum += line_between(line.here, Spot(camera_, places[i], hit_of(wall)));
      ++line.seen;
    }
  }
  // Where a sample has no such wall, it sees past its edge.
  const size_t samples = last - first;
  for (Line& line : lines)
    if (line.here.id != 0) line.sum += float(samples - std::min(samples, line.seen));
  for (size_t k = first == 0 ? 0 : scratch.ends[first - 1]; k < scratch.ends[last - 1]; ++k) {
    const Line& line = line_of(scratch.walls[k]);
    scratch.walls[k].line = std::min(1.0f, std::sqrt(2 * line.sum / float(samples)));
  }
}

void Veil::cover(std::span<const PixelPosition> places, VeilScratch& scratch, Colors& colors,
                 size_t at) const {
  const std::vector<VeilWall>& walls = scratch.walls;
  if (walls.empty()) return;
  scratch.hits.clear(), scratch.places.clear();
  for (size_t i = 0, k = 0; i < scratch.ends.size(); ++i)
    for (; k < scratch.ends[i]; ++k) {
      scratch.hits.push_back(hit_of(walls[k]));
      scratch.places.push_back(places[i]);
    }
  shader_.samples(scratch.hits, scratch.places, {}, scratch.seen, scratch.colors);
  const Colors& own = scratch.colors;
  for (size_t i = 0, k = 0; i < scratch.ends.size(); ++i) {
    if (k == scratch.ends[i]) continue;
    Vec3f sum;
    float left = 1;
    for (; k < scratch.ends[i]; ++k) {
      const float line = walls[k].line;
      const float hides = 1 - (1 - walls[k].opacity) * (1 - kLineCover * line);
      const Vec3f color = min(Vec3f{own.r[k], own.g[k], own.b[k]}, Vec3f{1, 1, 1});
      sum += color * (left * hides * (1 - kLineDarkness * line));
      left *= 1 - hides;
    }
    const size_t c = at + i;
    const float behind = left * colors.alpha[c];
    sum += min(Vec3f{colors.r[c], colors.g[c], colors.b[c]}, Vec3f{1, 1, 1}) * behind;
    const float alpha = 1 - left + behind;
    const Vec3f color = alpha > 0 ? sum / alpha : Vec3f{};
    colors.r[c] = color.x, colors.g[c] = color.y, colors.b[c] = color.z;
    colors.alpha[c] = alpha;
  }
}

/// `rows` rows of places, and one more below if there is one.
void Veil::add_differences(const VeilSight& sight, size_t width, size_t rows, bool has_below,
                           const Workers& workers, std::span<uint8_t> differences) const {
  workers.for_parts(rows, kRowsPerTask, [&](size_t first, size_t last, size_t) {
    VeilScratch here, below;
    std::vector<Spot> spots_here, spots_below;
    const auto look_at = [&](size_t y, VeilScratch& row, std::vector<Spot>& spots) {
      find_walls(sight, y * width, width, row);
      spots.clear();
      for (size_t x = 0, k = 0; x < width; ++x)
        for (; k < row.ends[x]; ++k)
          spots.emplace_back(camera_, sight.places[y * width + x], hit_of(row.walls[k]));
    };
    const auto differs = [&](const VeilScratch& a, const std::vector<Spot>& of_a, size_t x,
                             const VeilScratch& b, const std::vector<Spot>& of_b, size_t other) {
      const size_t begin_a = x == 0 ? 0 : a.ends[x - 1];
      const size_t begin_b = other == 0 ? 0 : b.ends[other - 1];
      const size_t count = a.ends[x] - begin_a;
      if (count != b.ends[other] - begin_b) return true;
      for (size_t k = 0; k < count; ++k)
        if (differ(of_a[begin_a + k], of_b[begin_b + k])) return true;
      return false;
    };
    look_at(first, below, spots_below);
    for (size_t y = first; y < last; ++y) {
      std::swap(here, below), std::swap(spots_here, spots_below);
      const bool is_above = y + 1 < rows || has_below;
      if (is_above) look_at(y + 1, below, spots_below);
      for (size_t x = 0; x < width; ++x) {
        unsigned bits = 0;
        const auto add = [&](const VeilScratch& row, const std::vector<Spot>& spots, size_t other,
                             unsigned bit) {
          if (differs(here, spots_here, x, row, spots, other)) bits |= bit;
        };
        if (x + 1 < width) add(here, spots_here, x + 1, kRight);
        if (is_above) {
          if (x > 0) add(below, spots_below, x - 1, kBelowLeft);
          add(below, spots_below, x, kBelow);
          if (x + 1 < width) add(below, spots_below, x + 1, kBelowRight);
        }
        differences[y * width + x] |= uint8_t(bits);
      }
    }
  });
}

}  // namespace whittle
