// Shadows are where they are by geometry worked out by hand, and where the oracle finds them with a
// ray of its own for every hit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "agreement/cpu_subject.h"
#include "image/shadows.h"
#include "model/instances.h"
#include "support/random_tree.h"
#include "support/read_text.h"
#include "support/zoo.h"
#include "trace/oracle/oracle.h"
#include "trace/view_for_test.h"
#if WHITTLE_HAS_VULKAN
#include "agreement/raster_subject.h"
#endif

namespace whittle {
namespace {

const Workers kShadowWorkers(2);

ShadeSettings casting(const Model& model, Style style, std::optional<Vec3> light = {}) {
  ShadeSettings settings;
  settings.style = style;
  settings.light = light;
  settings.shadows = true;
  settings.casters = view_region(bounds(model));
  return settings;
}

std::vector<PixelPosition> pixel_middles(const Camera& camera) {
  std::vector<PixelPosition> places;
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) places.push_back({float(x) + 0.5f, float(y) + 0.5f});
  return places;
}

struct Shadowed {
  Frame frame;
  std::vector<uint8_t> shadows;
};

Shadowed shadowed(Tracer& tracer, const Camera& camera, const ShadeSettings& settings) {
  Shadowed result{tracer.render(camera), {}};
  Shadows(tracer, camera, settings, kShadowWorkers)
      .find(result.frame.hits, pixel_middles(camera), result.shadows);
  return result;
}

Vec3 point_of(const Camera& camera, const Frame& frame, int x, int y) {
  const Ray ray = camera.ray(x + 0.5, y + 0.5);
  return ray.origin + ray.direction * double(frame.at(x, y).distance);
}

constexpr const char* kBallOverPlate =
    "translate([-30, -30, -1]) cube([60, 60, 1]); translate([2, -1, 6]) sphere(3);";

Camera from_above(int size) {
  ViewOptions options = view_of({0, 0, 0, 0, 0, 0, 150});
  options.width = options.height = size;
  return make_camera(options, {}, {});
}

/// Whether a disc's or ellipse's form is too near its rim for single precision to tell.
bool is_at_rim(double form) {
  return std::fabs(form - 1) < 1e-4;
}

TEST(Shadows, ABallUnderParallelLightCastsAnEllipse) {
  const Model model = model_of(kBallOverPlate);
  CpuSubject cpu(model, {});
  const Camera camera = from_above(160);
  const ShadeSettings settings = casting(model, Style::kStudio);
  const Shadowed seen = shadowed(*cpu.tracer, camera, settings);
  const std::vector<Light> all = lights(camera, settings);
  ASSERT_EQ(all.size(), 3u);
  int in_shadow[3] = {}, lit = 0;
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      if (seen.frame.at(x, y).id != 1) continue;
      const Vec3 p = point_of(camera, seen.frame, x, y);
      for (int k = 0; k < 2; ++k) {
        // An ellipse about the ball's middle carried along the light to z = 0: as wide as the ball,
        // and longer by one over the sine of the light's height.
        const Vec3 l = all[size_t(k)].at;
        const double flat = std::hypot(l.x, l.y);
        const Vec3 middle = Vec3{2, -1, 6} - l * (6 / l.z);
        const double along = ((p.x - middle.x) * l.x + (p.y - middle.y) * l.y) / flat;
        const double across = ((p.x - middle.x) * l.y - (p.y - middle.y) * l.x) / flat;
        const double form = std::pow(along * l.z / 3, 2) + std::pow(across / 3, 2);
        const bool dark = (seen.shadows[size_t(y * camera.width + x)] >> k & 1) != 0;
        if (is_at_rim(form)) continue;
        ASSERT_EQ(dark, form < 1) << x << ", " << y << " light " << k;
        (dark ? in_shadow[k] : lit)++;
      }
      // The third comes from below: the plate's upper side faces away.
      EXPECT_EQ(seen.shadows[size_t(y * camera.width + x)] >> 2, 0);
    }
  }
  EXPECT_GT(in_shadow[0], 200);
  EXPECT_GT(in_shadow[1], 200);
  EXPECT_GT(lit, 10000);
}

TEST(Shadows, ABallUnderALampCastsTheConeThatItFills) {
  const Model model = model_of(kBallOverPlate);
  CpuSubject cpu(model, {});
  const Camera camera = from_above(160);
  // Aside, far away, near by, and so low that it looks at the plate in six ways.
  for (const Vec3 lamp : {Vec3{12, 8, 20}, {-900, 700, 4000}, {2, -1, 9.5}, {-14, 3, 5}}) {
    const Shadowed seen = shadowed(*cpu.tracer, camera, casting(model, Style::kBlinn, lamp));
    const Vec3 to_ball = Vec3{2, -1, 6} - lamp;
    int in_shadow = 0;
    for (int y = 0; y < camera.height; ++y) {
      for (int x = 0; x < camera.width; ++x) {
        if (seen.frame.at(x, y).id != 1) continue;
        const Vec3 p = point_of(camera, seen.frame, x, y), way = p - lamp;
        if (p.z < -0.5) continue;
        // How far the way from the lamp passes the ball's middle; it does so before the plate.
        const double past = length(cross(way, to_ball)) / length(way);
        const bool before = dot(way, to_ball) > 0;
        const bool dark = seen.shadows[size_t(y * camera.width + x)] != 0;
        if (before && is_at_rim(past / 3)) continue;
        ASSERT_EQ(dark, before && past < 3) << x << ", " << y;
        in_shadow += dark;
      }
    }
    EXPECT_GT(in_shadow, 40) << lamp.x;
  }
}

TEST(Shadows, AConvexBodyHasNone) {
  int looks = 0;
  for (const char* text :
       {"sphere(10);", "cube(10);", "cylinder(h = 20, r1 = 8, r2 = 0);",
        "scale([1, 1, 0.001]) sphere(10);", "translate([1e6, 0, 0]) sphere(3);"}) {
    const Model model = model_of(text);
    CpuSubject cpu(model, {});
    for (const Camera& camera : cameras_for(model, 64, 64)) {
      const Box box = bounds(model).box;
      if (box.contains(camera.eye)) continue;
      ++looks;
      for (const ShadeSettings& settings :
           {casting(model, Style::kStudio),
            casting(model, Style::kBlinn, box.center() + Vec3{1, 2, 0.3} * box.diagonal())}) {
        for (const uint8_t shadow : shadowed(*cpu.tracer, camera, settings).shadows)
          ASSERT_EQ(shadow, 0) << text;
      }
    }
  }
  EXPECT_GE(looks, 5);
}

TEST(Shadows, ALightAtTheEyeReachesAllThatIsSeen) {
  const Model model = model_of(kBallOverPlate);
  CpuSubject cpu(model, {});
  const Camera camera = from_above(64);
  ShadeSettings settings = casting(model, Style::kBlinn);
  for (const uint8_t shadow : shadowed(*cpu.tracer, camera, settings).shadows) ASSERT_EQ(shadow, 0);
  // And by looking, a hair beside the eye.
  settings.light = camera.eye + Vec3{1e-9, 0, 0};
  for (const uint8_t shadow : shadowed(*cpu.tracer, camera, settings).shadows) ASSERT_EQ(shadow, 0);
}

struct ShadowReport {
  int compared = 0, dark = 0, ambiguous = 0, wrong = 0;
};

/// Holds shadows to the oracle's: for each hit a camera of one pixel that looks from the light
/// straight at it, and at four points beside it. Where these do not agree, nothing is asked.
ShadowReport hold_to_oracle(const Model& model, Tracer& tracer, const Camera& camera,
                            const ShadeSettings& settings) {
  const auto oracle = make_oracle_tracer(model, 1);
  const Shadowed seen = shadowed(tracer, camera, settings);
  const std::vector<Light> all = lights(camera, settings);
  const double aside = 1e-4 * bounds(model).box.diagonal();
  ShadowReport report;
  const auto is_blocked = [&](const Light& light, Vec3 p) {
    const Vec3 l = light.is_direction ? light.at : normalize(light.at - p);
    const double far = settings.casters.diagonal();
    Camera view;
    view.width = view.height = 1;
    view.orthographic = light.is_direction;
    view.eye = light.is_direction ? p + l * far : light.at;
    view.forward = l * -1;
    view.right =
        normalize(cross(view.forward, std::fabs(l.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}));
    view.up = cross(view.right, view.forward);
    Hit hit;
    const PixelPosition middle{0.5f, 0.5f};
    oracle->probe(view, {&middle, 1}, {&hit, 1});
    return double(hit.distance) < length(p - view.eye) - aside;
  };
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Hit& hit = seen.frame.at(x, y);
      if (!hit.hit()) continue;
      const Vec3 p = point_of(camera, seen.frame, x, y);
      Vec3 n{double(hit.normal.x), double(hit.normal.y), double(hit.normal.z)};
      if (dot(n, camera.ray(x + 0.5, y + 0.5).direction) > 0) n = n * -1;
      for (size_t k = 0; k < all.size(); ++k) {
        const Vec3 l = all[k].is_direction ? all[k].at : normalize(all[k].at - p);
        const bool dark = (seen.shadows[size_t(y * camera.width + x)] >> k & 1) != 0;
        if (dot(n, l) <= 0) {
          report.wrong += dark;
          continue;
        }
        const bool blocked = is_blocked(all[k], p);
        bool is_clear = dot(n, l) > 0.05;
        const Vec3 u = normalize(cross(n, std::fabs(n.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}));
        for (const Vec3 off : {u, u * -1, cross(n, u), cross(u, n)})
          is_clear = is_clear && is_blocked(all[k], p + off * aside + n * aside) == blocked;
        ++report.compared;
        report.dark += dark;
        report.ambiguous += !is_clear;
        if (is_clear && dark != blocked && report.wrong++ == 0)
          ADD_FAILURE() << x << ", " << y << ", light " << k << ": " << dark << ", the oracle says "
                        << blocked;
      }
    }
  }
  return report;
}

ShadowReport& operator+=(ShadowReport& sum, const ShadowReport& one) {
  sum.compared += one.compared, sum.dark += one.dark;
  sum.ambiguous += one.ambiguous, sum.wrong += one.wrong;
  return sum;
}

TEST(Shadows, CpuAgreesWithTheOracle) {
  ShadowReport sum;
  const auto hold = [&](const Model& model, int size) {
    CpuSubject cpu(model, {});
    for (const Camera& camera : cameras_for(model, size, size)) {
      const Box box = bounds(model).box;
      sum += hold_to_oracle(model, *cpu.tracer, camera, casting(model, Style::kStudio));
      sum += hold_to_oracle(
          model, *cpu.tracer, camera,
          casting(model, Style::kBlinn, box.center() + Vec3{0.6, -0.4, 0.7} * box.diagonal()));
      // Among the parts, or inside of one.
      sum += hold_to_oracle(
          model, *cpu.tracer, camera,
          casting(model, Style::kBlinn, box.center() + Vec3{0.1, 0.07, 0.13} * box.diagonal()));
    }
  };
  for (uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    hold(model_of(random_tree(seed)), 32);
  }
  EXPECT_EQ(sum.wrong, 0);
  EXPECT_GT(sum.compared, 25000);
  EXPECT_GT(sum.dark, sum.compared / 20);
  EXPECT_LT(sum.ambiguous, sum.compared / 10);
}

#if WHITTLE_HAS_VULKAN
TEST(Shadows, VulkanRasterAgreesWithTheOracle) {
  ShadowReport sum;
  for (uint64_t seed = 1; seed <= 2; ++seed) {
    SCOPED_TRACE(seed);
    RasterSettings settings;
    settings.numbers = seed == 1 ? ShaderNumbers::kAuto : ShaderNumbers::kFloat;
    const Result<std::shared_ptr<RasterDevice>> device = open_raster_device(settings);
    ASSERT_TRUE(device) << device.error().message;
    const Model model = model_of(random_tree(seed));
    RasterSubject raster(*device, model, SubdivideSettings());
    const Camera camera = cameras_for(model, 32, 32)[0];
    const Box box = bounds(model).box;
    sum += hold_to_oracle(model, *raster.tracer, camera, casting(model, Style::kStudio));
    sum += hold_to_oracle(
        model, *raster.tracer, camera,
        casting(model, Style::kBlinn, box.center() + Vec3{0.6, -0.4, 0.7} * box.diagonal()));
    ASSERT_TRUE(raster.tracer->status());
  }
  EXPECT_EQ(sum.wrong, 0);
  EXPECT_GT(sum.dark, 50);
}
#endif

}  // namespace
}  // namespace whittle
