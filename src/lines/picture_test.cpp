// The drawing against the traced picture of the same camera: what is a line in one is an edge in
// the other.
#include <algorithm>
#include <cmath>

#include "lines/drawing_for_test.h"
#include "lower/lower.h"
#include "subdivide/subdivide.h"
#include "support/random_tree.h"
#include "trace/cpu/cpu.h"

namespace whittle {
namespace {

constexpr int kSide = 400;

Camera perspective(uint64_t seed) {
  return camera_of({0, 0, 0, 40 + double(seed % 5) * 13, 7, double(seed) * 47, 90}, kSide);
}

/// The true surfaces, not the drawing's facets.
struct Traced {
  Scene scene;
  CellTree cells;
  std::unique_ptr<CpuTracer> tracer;
  explicit Traced(const Model& model)
      : scene(*lower(model)),
        cells(open_cells(scene, {})),
        tracer(make_cpu_tracer(scene, cells, 2)) {}
};

/// Whether two hits of neighbouring rays are not of one smooth surface.
bool differ(const Hit& a, const Hit& b) {
  if (a.hit() != b.hit()) return true;
  if (!a.hit()) return false;
  if (dot(a.normal, b.normal) < 0.9986f) return true;  // 3 degrees
  return std::fabs(a.distance - b.distance) > 1;
}

TEST(LinesOverPicture, EveryLineIsAnEdgeOfThePicture) {
  size_t asked = 0, wrong = 0;
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const Model model = model_of(random_tree(seed, {.coincident = seed % 4 == 0}));
    const Camera camera = perspective(seed);
    const Traced traced(model);
    std::vector<PixelPosition> places;
    for (const DrawnPath& path : drawing_of(model, camera).paths) {
      for (size_t i = 0; i + 1 < path.points.size(); ++i) {
        const Vec2 a = path.points[i], b = path.points[i + 1];
        const double size = length(b - a);
        const Vec2 p = (a + b) * 0.5;
        if (size < 3 || p.x < 1 || p.y < 1 || p.x > kSide - 1 || p.y > kSide - 1) continue;
        const Vec2 across = Vec2{a.y - b.y, b.x - a.x} * (0.6 / size);
        for (const Vec2 q : {p - across, p, p + across}) places.push_back({float(q.x), float(q.y)});
      }
    }
    std::vector<Hit> hits(places.size());
    traced.tracer->probe(camera, places, hits);
    for (size_t i = 0; i < hits.size(); i += 3) {
      ++asked;
      wrong += !differ(hits[i], hits[i + 1]) && !differ(hits[i + 1], hits[i + 2]) &&
               !differ(hits[i], hits[i + 2]);
    }
  }
  EXPECT_GT(asked, 500u);
  EXPECT_LT(wrong, asked / 200);
}

TEST(LinesOverPicture, EveryEdgeOfThePictureIsALine) {
  size_t asked = 0, wrong = 0;
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const Model model = model_of(random_tree(seed, {.coincident = seed % 4 == 0}));
    const Camera camera = perspective(seed);
    Traced traced(model);
    const Frame frame = traced.tracer->render(camera);
    std::vector<bool> drawn(size_t(kSide) * kSide, false);
    for (const DrawnPath& path : drawing_of(model, camera).paths) {
      std::vector<Vec2> points = path.points;
      if (path.is_closed) points.push_back(points.front());
      for (size_t i = 0; i + 1 < points.size(); ++i) {
        const Vec2 way = points[i + 1] - points[i];
        const int steps = int(length(way) * 4) + 1;
        for (int s = 0; s <= steps; ++s) {
          const Vec2 p = points[i] + way * (double(s) / steps);
          const int x = int(std::floor(p.x)), y = int(std::floor(p.y));
          for (int v = std::max(y - 1, 0); v <= std::min(y + 1, kSide - 1); ++v)
            for (int u = std::max(x - 1, 0); u <= std::min(x + 1, kSide - 1); ++u)
              drawn[size_t(v) * kSide + size_t(u)] = true;
        }
      }
    }
    // Where the solid ends, and where flat faces or whole bodies meet at a good angle.
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x + 1 < kSide; ++x) {
        const Hit &a = frame.at(x, y), &b = frame.at(x + 1, y);
        const bool is_edge = a.hit() != b.hit() || (a.hit() && dot(a.normal, b.normal) < 0.8f);
        if (!is_edge) continue;
        ++asked;
        wrong += !drawn[size_t(y) * kSide + size_t(x)];
      }
    }
  }
  EXPECT_GT(asked, 2000u);
  EXPECT_LT(wrong, asked / 1000);
}

}  // namespace
}  // namespace whittle
