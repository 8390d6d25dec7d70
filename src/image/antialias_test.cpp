#include "image/antialias.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "image/edge_pixels.h"
#include "image/srgb.h"
#include "support/instruction_sets.h"
#include "trace/view_for_test.h"

namespace whittle {
namespace {

const Workers kWorkers(0);

ShadeSettings plain() {
  ShadeSettings settings;
  settings.style = Style::kPlain;
  return settings;
}

/// A tracer of anything that a function can say about a ray; counts what it is asked.
class FunctionTracer : public Tracer {
 public:
  explicit FunctionTracer(std::function<Hit(const Ray&)> shoot) : shoot_(std::move(shoot)) {}
  const char* name() const override { return "function"; }
  Frame render(const Camera& camera, const RenderControl&) override {
    Frame frame(camera.width, camera.height);
    for (int y = 0; y < camera.height; ++y) {
      for (int x = 0; x < camera.width; ++x) frame.at(x, y) = shoot_(camera.ray(x + 0.5, y + 0.5));
    }
    return frame;
  }
  void probe(const Camera& camera, std::span<const PixelPosition> positions,
             std::span<Hit> hits) override {
    for (size_t i = 0; i < positions.size(); ++i) {
      hits[i] = shoot_(camera.ray(double(positions[i].x), double(positions[i].y)));
      probed.push_back(positions[i]);
    }
  }
  void cast(std::span<const Ray> rays, std::span<Hit> hits) override {
    std::ranges::transform(rays, hits.begin(), shoot_);
  }
  std::vector<PixelPosition> probed;

 private:
  std::function<Hit(const Ray&)> shoot_;
};

/// Straight down on the plane z = 0, one unit a pixel, (0, 0) in the middle.
Camera top_camera(int width, int height) {
  ViewOptions options = view_of({0, 0, 0, 0, 0, 0, 50});
  options.orthographic = true;
  options.width = width;
  options.height = height;
  Camera camera = make_camera(options, {}, {});
  camera.half_height = 0.5 * height;
  return camera;
}

/// The plane z = 0, its points with x < edge owned by 1, the others by `right` (0: nothing there).
FunctionTracer edge_tracer(double edge, uint32_t right) {
  return FunctionTracer([=](const Ray& ray) -> Hit {
    const double t = -ray.origin.z / ray.direction.z;
    const uint32_t id = ray.origin.x + t * ray.direction.x < edge ? 1 : right;
    return id == 0 ? Hit{} : Hit{float(t), id, {0, 0, 1}};
  });
}

const std::vector<Appearance> kBlackAndWhite{
    {}, {.color = {0, 0, 0, 1}, .cut = false}, {.color = {1, 1, 1, 1}, .cut = false}};

size_t count(const std::vector<uint8_t>& mask) {
  size_t n = 0;
  for (const uint8_t m : mask) n += m;
  return n;
}

TEST(Antialias, TheShareOfSamplesThatHitIsTheAlpha) {
  // Half a pixel column and a quarter are covered; the colours stay pure.
  for (const double share : {0.5, 0.25}) {
    FunctionTracer tracer = edge_tracer(share, 0);
    const Camera camera = top_camera(8, 4);
    const Frame frame = tracer.render(camera, {});
    ShadeSettings settings;
    settings.style = Style::kOpenscad;
    settings.background = false;
    const Picture p = shade_antialiased(tracer, camera, frame, {}, settings, 4, kWorkers);
    for (int y = 0; y < 4; ++y) {
      EXPECT_EQ(p.at(3, y)[3], 255);
      EXPECT_EQ(p.at(4, y)[3], int(share * 255 + 0.5));
      EXPECT_EQ(p.at(5, y)[3], 0);
      for (int k = 0; k < 3; ++k) EXPECT_EQ(p.at(4, y)[k], p.at(3, y)[k]);
    }
  }
}

TEST(Antialias, OnlyPixelsBesideTheEdgeAreTracedAgain) {
  FunctionTracer tracer = edge_tracer(0.5, 2);
  const Camera camera = top_camera(20, 10);
  const Frame frame = tracer.render(camera, {});
  shade_antialiased(tracer, camera, frame, {}, plain(), 3, kWorkers);
  // The border between pixel columns 9 and 10, or 10 and 11: two columns of ten rows.
  EXPECT_EQ(tracer.probed.size(), size_t(2 * 10 * 9));
}

TEST(Antialias, EveryEdgePixelIsTracedOnceHoweverLargeThePicture) {
  // A disc, so that edges are everywhere; sizes that blocks of pixels divide, and others.
  const double radius = 8;
  FunctionTracer tracer([&](const Ray& ray) -> Hit {
    const double t = -ray.origin.z / ray.direction.z;
    const double x = ray.origin.x + t * ray.direction.x, y = ray.origin.y + t * ray.direction.y;
    return x * x + y * y > radius * radius ? Hit{} : Hit{float(t), 1, {0, 0, 1}};
  });
  for (const auto& [width, height] : {std::pair{20, 16}, {19, 17}, {18, 15}, {1, 9}, {21, 1}}) {
    const Camera camera = top_camera(width, height);
    const Frame frame = tracer.render(camera, {});
    const std::vector<uint8_t> mask = edge_mask(frame, camera, kWorkers);
    tracer.probed.clear();
    shade_antialiased(tracer, camera, frame, {}, plain(), 2, kWorkers);
    std::vector<int> samples(mask.size());
    for (const PixelPosition& p : tracer.probed)
      ++samples[size_t(p.y) * size_t(width) + size_t(p.x)];
    for (size_t i = 0; i < mask.size(); ++i)
      EXPECT_EQ(samples[i], 4 * mask[i]) << i << " of " << width << " x " << height;
  }
}

TEST(Antialias, OneSampleIsPlainShading) {
  FunctionTracer tracer = edge_tracer(0.5, 2);
  const Camera camera = top_camera(8, 4);
  const Frame frame = tracer.render(camera, {});
  EXPECT_EQ(shade_antialiased(tracer, camera, frame, {}, plain(), 1, kWorkers).rgba,
            shade(frame, camera, {}, plain(), kWorkers).rgba);
  EXPECT_EQ(tracer.probed.size(), 0u);
}

TEST(Antialias, PlainAveragesLightAndTheOthersDisplayValues) {
  FunctionTracer tracer = edge_tracer(0.5, 2);
  const Camera camera = top_camera(8, 4);
  const Frame frame = tracer.render(camera, {});
  for (const Style style : {Style::kPlain, Style::kBlinn, Style::kOpenscad}) {
    ShadeSettings settings;
    settings.style = style;
    const Picture p =
        shade_antialiased(tracer, camera, frame, kBlackAndWhite, settings, 2, kWorkers);
    const float dark = float(p.at(0, 1)[1]) / 255, bright = float(p.at(7, 1)[1]) / 255;
    const float mean =
        style == Style::kPlain
            ? srgb_from_linear((linear_from_srgb(dark) + linear_from_srgb(bright)) / 2)
            : (dark + bright) / 2;
    // The highlight of the light at the eye is not the same in each pixel.
    EXPECT_NEAR(float(p.at(4, 1)[1]), mean * 255, 3) << int(style);
  }
}

/// What a ray sees of a ball of radius r about the origin.
Hit ball(const Ray& ray, double r) {
  const double b = dot(ray.origin, ray.direction);
  const double q = b * b - dot(ray.origin, ray.origin) + r * r;
  if (q < 0) return {};
  const double t = -b - std::sqrt(q);
  const Vec3 n = normalize(ray.origin + ray.direction * t);
  return {float(t), 1, {float(n.x), float(n.y), float(n.z)}};
}

TEST(Antialias, TheInsideOfABallIsNoEdgeAndItsOutlineIs) {
  for (const bool orthographic : {false, true}) {
    ViewOptions options;
    options.orthographic = orthographic;
    options.width = options.height = 200;
    const Camera camera = make_camera(options, {}, Box{{-5, -5, -5}, {5, 5, 5}});
    FunctionTracer tracer([](const Ray& ray) { return ball(ray, 5); });
    const Frame frame = tracer.render(camera, {});
    const std::vector<uint8_t> mask = edge_mask(frame, camera, kWorkers);
    size_t hits = 0;
    for (int y = 1; y + 1 < 200; ++y) {
      for (int x = 1; x + 1 < 200; ++x) {
        hits += frame.at(x, y).hit();
        const bool outline = frame.at(x, y).hit() != frame.at(x + 1, y).hit();
        if (outline) {
          EXPECT_TRUE(mask[size_t(y) * 200 + size_t(x)] && mask[size_t(y) * 200 + size_t(x) + 1]);
        }
      }
    }
    EXPECT_GT(hits, 5000u);
    EXPECT_LT(count(mask), hits / 5);
  }
}

TEST(Antialias, APlaneSeenAtAGrazingAngleIsNoEdge) {
  ViewOptions options = view_of({0, 0, 0, 85, 0, 30, 50});
  options.width = options.height = 64;
  for (const bool orthographic : {false, true}) {
    options.orthographic = orthographic;
    const Camera camera = make_camera(options, {}, {});
    FunctionTracer tracer([](const Ray& ray) -> Hit {
      const double t = -ray.origin.z / ray.direction.z;
      return t > ray.t_min ? Hit{float(t), 1, {0, 0, 1}} : Hit{};
    });
    const Frame frame = tracer.render(camera, {});
    const std::vector<uint8_t> mask = edge_mask(frame, camera, kWorkers);
    for (int y = 2; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        if (!frame.at(x, y - 2).hit()) continue;
        EXPECT_FALSE(mask[size_t(y) * 64 + size_t(x)]) << x << " " << y;
      }
    }
    EXPECT_TRUE(frame.at(32, 60).hit());
  }
}

TEST(Antialias, AStepInDepthOfOneOwnerIsAnEdge) {
  const auto step_tracer = [](double height) {
    return FunctionTracer([=](const Ray& ray) -> Hit {
      const double t = -ray.origin.z / ray.direction.z;
      return {float(ray.origin.x < 0 ? t : t - height), 1, {0, 0, 1}};
    });
  };
  const Camera camera = top_camera(8, 4);
  FunctionTracer low = step_tracer(1), high = step_tracer(3);
  EXPECT_EQ(count(edge_mask(low.render(camera, {}), camera, kWorkers)), 0u);
  EXPECT_EQ(count(edge_mask(high.render(camera, {}), camera, kWorkers)), 8u);
}

TEST(Antialias, APixelThatDiffersMarksItselfAndItsEightNeighbours) {
  Frame frame(7, 6);
  for (Hit& h : frame.hits) h = {50, 1, {0, 0, 1}};
  frame.at(3, 2).id = 2;
  const std::vector<uint8_t> mask = edge_mask(frame, top_camera(7, 6), kWorkers);
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 7; ++x) {
      const bool near = std::abs(x - 3) <= 1 && std::abs(y - 2) <= 1;
      EXPECT_EQ(mask[size_t(y) * 7 + size_t(x)], near) << x << " " << y;
    }
  }
}

TEST(Antialias, ACreaseOfOneOwnerIsAnEdge) {
  const auto crease_tracer = [](double degrees) {
    return FunctionTracer([=](const Ray& ray) -> Hit {
      const double slope = std::tan(degrees * std::acos(-1.0) / 180) * (ray.origin.x > 0);
      const double t = ray.origin.z + slope * ray.origin.x;
      const Vec3 n = normalize(Vec3{slope, 0, 1});
      return {float(t), 1, {float(n.x), float(n.y), float(n.z)}};
    });
  };
  const Camera camera = top_camera(8, 4);
  FunctionTracer flat = crease_tracer(7), sharp = crease_tracer(9);
  EXPECT_EQ(count(edge_mask(flat.render(camera, {}), camera, kWorkers)), 0u);
  EXPECT_EQ(count(edge_mask(sharp.render(camera, {}), camera, kWorkers)), 8u);
}

TEST(Antialias, EveryInstructionSetFindsTheSameEdges) {
  // One owner's wave with a crease, a step and a hole, and another owner beside it.
  FunctionTracer wave([](const Ray& ray) -> Hit {
    const double x = ray.origin.x, y = ray.origin.y;
    if (std::fabs(x - y) < 1) return {};
    const double z = 4 * std::sin(x / 12) + (y > 10 ? 4 : 0);
    const Vec3 n = normalize(Vec3{y > 3 ? -std::cos(x / 12) / 3 : 0, 0, 1});
    return {float(ray.origin.z - z), y < -12 ? 2u : 1u, {float(n.x), float(n.y), float(n.z)}};
  });
  for (const int width : {1, 2, 17, 40}) {
    const Camera camera = top_camera(width, 40);
    const Frame frame = wave.render(camera, {});
    const std::vector<uint8_t> expected = edge_mask(frame, camera, Workers(1));
    EXPECT_GT(count(expected), expected.size() / 20);
    EXPECT_LT(count(expected), expected.size());
    for_every_instruction_set([&] { EXPECT_EQ(edge_mask(frame, camera, kWorkers), expected); });
  }
}

TEST(Antialias, IsTheSameOnOneThread) {
  ViewOptions options;
  options.width = options.height = 100;
  const Camera camera = make_camera(options, {}, Box{{-5, -5, -5}, {5, 5, 5}});
  FunctionTracer tracer([](const Ray& ray) { return ball(ray, 5); });
  const Frame frame = tracer.render(camera, {});
  const Picture p = shade_antialiased(tracer, camera, frame, {}, plain(), 4, kWorkers);
  EXPECT_EQ(shade_antialiased(tracer, camera, frame, {}, plain(), 4, Workers(1)).rgba, p.rgba);
}

TEST(Antialias, TheEdgeOfAShadowIsAnEdge) {
  // A plane, and 10 above it, out of sight behind the eye, a lid over x < 0.3. Light falls straight
  // down.
  FunctionTracer tracer([](const Ray& ray) -> Hit {
    for (const double z : {60.0, 0.0}) {
      const double t = (z - ray.origin.z) / ray.direction.z;
      const double x = ray.origin.x + t * ray.direction.x;
      if (t > ray.t_min && (z == 0 || x < 0.3)) return {float(t), 1, {0, 0, 1}};
    }
    return {};
  });
  Camera camera = top_camera(8, 8);
  camera.ortho_reach = 0;
  ShadeSettings settings;
  settings.style = Style::kBlinn;
  settings.light = Vec3{0, 0, 1e6};
  settings.shadows = true;
  settings.casters = {{-10, -10, -1}, {10, 10, 61}};
  const Frame frame = tracer.render(camera, {});
  const Picture hard = shade_antialiased(tracer, camera, frame, {}, settings, 1, kWorkers);
  const Picture soft = shade_antialiased(tracer, camera, frame, {}, settings, 4, kWorkers);
  const int dark = hard.at(3, 4)[1], lit = hard.at(5, 4)[1];
  EXPECT_GT(lit, 2 * dark);
  EXPECT_EQ(hard.at(4, 4)[1], lit) << "its middle is at 0.5";
  // The samples at 0.125 are in shadow, those at 0.375, 0.625 and 0.875 are not.
  EXPECT_NEAR(soft.at(4, 4)[1], 0.25 * dark + 0.75 * lit, 2);
  EXPECT_NEAR(soft.at(3, 4)[1], dark, 1);
  EXPECT_NEAR(soft.at(5, 4)[1], lit, 1);
}

}  // namespace
}  // namespace whittle
