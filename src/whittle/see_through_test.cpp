// Pictures of see-through parts and of ghosts, against formulas and between backends.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "image/srgb.h"
#include "lower/evaluate.h"
#include "lower/lower.h"
#include "model/layers.h"
#include "support/random_tree.h"
#include "support/read_text.h"
#include "trace/oracle/oracle.h"
#include "whittle/renderer.h"

namespace whittle {
namespace {

struct Shot {
  Frame frame;
  Picture picture;
};

struct Look {
  ShadeSettings shading;
  RendererSettings renderer;
  int antialias = 1;
};

Look look_in(Style style) {
  Look look;
  look.shading.style = style;
  look.shading.is_preview = style == Style::kOpenscad;
  look.shading.quality = Quality::kDraft;
  look.renderer.backend = Backend::kCpu;
  return look;
}

ViewOptions from_above(int side = 33) {
  ViewOptions view;
  view.eye = Vec3{0, 0, 50}, view.center = Vec3{};
  view.orthographic = true;
  view.width = view.height = side;
  return view;
}

Shot shoot(const Model& model, const Look& look, const ViewOptions& view = from_above()) {
  Result<Renderer> renderer = Renderer::make(model, look.renderer);
  WHITTLE_CHECK(renderer);
  const Camera camera = renderer->camera(view);
  WHITTLE_CHECK(renderer->prepare(camera));
  Shot shot;
  shot.frame = *renderer->trace(camera);
  shot.picture = *renderer->shade(shot.frame, camera, look.shading, look.antialias);
  return shot;
}

Model with_ghosts(std::string_view text) {
  ReadOptions options;
  options.background = true;
  return model_of(text, "test.csg", options);
}

const uint8_t* middle_of(const Picture& picture) {
  return picture.at(picture.width / 2, picture.height / 2);
}

/// A colour in the space in which a style mixes.
std::array<float, 3> mixable(const uint8_t* rgba, Style style) {
  std::array<float, 3> c;
  for (size_t i = 0; i < 3; ++i) {
    c[i] = float(rgba[i]) / 255;
    if (is_linear(style)) c[i] = linear_from_srgb(c[i]);
  }
  return c;
}

constexpr const char* kPlate =
    "multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,-5],[0,0,0,1]]) color([0,0.5,1,1]) "
    "cube([60, 60, 1], center = true);";

std::string slab(double alpha) {
  return fmt::format("color([1, 0.25, 0, {}]) cube([12, 12, 4], center = true);", alpha);
}

/// The levels of a slab of half that hides a share of what is behind it by either wall. Its walls
/// are lit alike where lights are: what is seen of the far one is its inner side, which faces the
/// eye as the near one does.
void expect_slab(Style style) {
  const double alpha = 0.3;
  const auto near = mixable(middle_of(shoot(model_of(slab(1)), look_in(style)).picture), style);
  const auto behind = mixable(middle_of(shoot(model_of(kPlate), look_in(style)).picture), style);
  const auto seen =
      mixable(middle_of(shoot(model_of(slab(alpha) + kPlate), look_in(style)).picture), style);
  const float hidden = float(1 - (1 - alpha) * (1 - alpha));
  for (size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(seen[i], hidden * near[i] + (1 - hidden) * behind[i], 0.008f)
        << int(style) << " component " << i;
}

TEST(SeeThrough, ASlabHidesAsMuchAsItsTwoWallsDo) {
  expect_slab(Style::kPlain);
  expect_slab(Style::kStudio);
  expect_slab(Style::kOpenscad);
}

TEST(SeeThrough, WithoutABackgroundASlabIsAsOpaqueAsItsTwoWalls) {
  Look look = look_in(Style::kPlain);
  look.shading.background = false;
  const Picture picture = shoot(model_of(slab(0.3)), look).picture;
  EXPECT_NEAR(middle_of(picture)[3], 255 * (1 - 0.7 * 0.7), 1);
  EXPECT_EQ(picture.at(0, 0)[3], 0);
}

TEST(SeeThrough, WhatIsOpaqueIsSeenWithinWhatIsNot) {
  const std::string ball = "color([0, 1, 0, 1]) sphere(1.5);";
  for (const std::string& text : {slab(0.5) + ball, ball + slab(0.5)}) {
    const Shot shot = shoot(model_of(text), look_in(Style::kOpenscad));
    const uint8_t* seen = middle_of(shot.picture);
    // One wall, then the ball: (0.2 + 1 / sqrt(3)) of both.
    const double lit = 255 * (0.2 + 1 / std::sqrt(3.0));
    EXPECT_NEAR(seen[0], 0.5 * lit, 1.5) << text;
    EXPECT_NEAR(seen[1], (0.5 * 0.25 + 0.5) * lit, 1.5) << text;
    EXPECT_NEAR(shot.frame.at(16, 16).distance, 48, 1e-4) << "a fact: the solid is what it was";
  }
}

TEST(SeeThrough, NoWallIsBetweenPartsOfOneColor) {
  const std::string half = "color([1, 0, 0, 0.5]) cube([9, 9, 4], center = false);";
  const std::string two = half + "multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,2],[0,0,0,1]]) " + half;
  const std::string one = "color([1, 0, 0, 0.5]) cube([9, 9, 6], center = false);";
  ViewOptions view = from_above();
  view.eye = Vec3{3, 2, 50}, view.center = Vec3{3, 2, 0};
  const Look look = look_in(Style::kPlain);
  const Picture a = shoot(model_of(two), look, view).picture;
  const Picture b = shoot(model_of(one), look, view).picture;
  for (int i = 0; i < 4; ++i) EXPECT_EQ(middle_of(a)[i], middle_of(b)[i]);
}

TEST(SeeThrough, TheOrderOfTheFileDoesNotMatter) {
  std::vector<std::string> parts{
      slab(0.4), "color([0, 0, 1, 0.6]) cylinder(h = 30, r = 5, center = true);",
      "color([0, 1, 0, 0.2]) sphere(8);", "cube([3, 40, 3], center = true);"};
  Look look = look_in(Style::kStudio);
  look.antialias = 3;
  ViewOptions view;
  view.width = view.height = 64;
  std::ranges::sort(parts);
  const auto draw = [&] {
    return shoot(model_of(parts[0] + parts[1] + parts[2] + parts[3]), look, view).picture;
  };
  const Picture first = draw();
  for (int i = 0; i < 3; ++i) {
    std::ranges::next_permutation(parts);
    EXPECT_EQ(draw().rgba, first.rgba);
  }
}

TEST(SeeThrough, ThreadsDoNotMatter) {
  Look look = look_in(Style::kStudio);
  look.shading.quality = Quality::kGood;
  look.antialias = 3;
  const Model model = model_of(slab(0.4) + kPlate + "color([0, 0, 1, 0.6]) sphere(9);");
  ViewOptions view;
  view.width = view.height = 96;
  look.renderer.threads = 1;
  const Picture one = shoot(model, look, view).picture;
  look.renderer.threads = 4;
  EXPECT_EQ(shoot(model, look, view).picture.rgba, one.rgba);
}

TEST(SeeThrough, RenderKnowsNoAlpha) {
  Look look = look_in(Style::kOpenscad);
  look.shading.is_preview = false;
  EXPECT_EQ(shoot(model_of(slab(0.3)), look).picture.rgba,
            shoot(model_of(slab(1)), look).picture.rgba);
}

/// Colours of random trees get alphas: two of every seven cubes, spheres and so on.
std::string with_alphas(std::string text) {
  size_t n = 0;
  for (const char* name : {"cube(", "sphere(", "cylinder("}) {
    const std::string colors[] = {"color([1,0,0,0.5]) ", "", "", "color([0,0,1,0.3]) ", "", "", ""};
    for (size_t at = text.find(name); at != std::string::npos; at = text.find(name, at)) {
      const std::string& color = colors[n++ % 7];
      text.insert(at, color);
      at += color.size() + 1;
    }
  }
  return text;
}

/// An intersection of which each operand is see-through in part.
const std::string kUnionsThatMeet =
    "intersection() { union() { color([1, 0, 0, 0.5]) cube(9); cube([20, 5, 5], center = true); }"
    "  union() { cube(8); color([1, 0, 0, 0.5]) cube([9, 9, 20], center = true); } }";

TEST(SeeThrough, LayersTogetherAreTheSolid) {
  size_t inside = 0, taken_apart = 0;
  for (uint64_t seed = 1; seed <= 200; ++seed) {
    const Model model = model_of(seed == 1 ? kUnionsThatMeet : with_alphas(random_tree(seed)));
    const Layers layers = layers_of(model, appearances(model), {});
    if (layers.is_whole) continue;
    ++taken_apart;
    const Scene whole = *lower(model);
    std::vector<Scene> parts{*lower(layers.opaque)};
    for (const Layer& layer : layers.see_through) parts.push_back(*lower(layer.model));
    for (int k = 0; k < 400; ++k) {
      const auto part = [&](double step) { return 24 * (std::fmod(0.5 + k * step, 1) - 0.5); };
      const Vec3 p{part(0.8191725134), part(0.6710436067), part(0.5497004779)};
      const bool any = std::ranges::any_of(parts, [&](const Scene& scene) {
        return contains(scene, scene.formula, p - scene.origin);
      });
      EXPECT_EQ(any, contains(whole, whole.formula, p - whole.origin)) << "seed " << seed;
      inside += any;
    }
  }
  EXPECT_GT(taken_apart, 20u);
  EXPECT_GT(inside, 200u);
}

/// The share of pixels that differ by more than rounding.
double share_apart(const Picture& a, const Picture& b) {
  size_t apart = 0;
  for (size_t i = 0; i < a.rgba.size(); ++i) apart += std::abs(a.rgba[i] - b.rgba[i]) > 2;
  return double(apart) / double(a.rgba.size());
}

TEST(SeeThrough, TheCpuAndTheOracleSeeTheSame) {
  Look cpu = look_in(Style::kPlain), oracle = cpu;
  oracle.renderer.backend = Backend::kOracle;
  ViewOptions view;
  view.width = view.height = 40;
  for (uint64_t seed = 1; seed <= 40; ++seed) {
    const Model model = with_ghosts(with_alphas(random_tree(seed)));
    cpu.renderer.ghosts = oracle.renderer.ghosts = seed % 2 == 0;
    EXPECT_LT(share_apart(shoot(model, cpu, view).picture, shoot(model, oracle, view).picture),
              0.01)
        << "seed " << seed;
  }
}

/// How opaque what is seen through a pixel is, by the oracle's crossings of each solid alone.
double opacity_by_spans(const Layers& layers, const std::vector<Appearance>& looks,
                        const Ray& ray) {
  Hit behind;
  make_oracle_tracer(layers.opaque, 1)->cast({&ray, 1}, {&behind, 1});
  double left = behind.hit() ? 0 : 1, before = 1;
  for (const Layer& layer : layers.see_through) {
    RayCrossings found;
    make_oracle_tracer(layer.model, 1)->cast_through({&ray, 1}, found);
    for (const SurfaceCrossing& crossing : found.of(0))
      if (crossing.distance < double(behind.distance))
        before *= 1 - double(opacity(looks[crossing.id]));
  }
  return 1 - before * left;
}

TEST(SeeThrough, WhatIsHiddenFollowsFromTheOraclesSpans) {
  Look look = look_in(Style::kPlain);
  look.shading.background = false;
  ViewOptions view = from_above(15);
  size_t seen = 0, apart = 0, thin = 0;
  for (uint64_t seed = 1; seed <= 120; ++seed) {
    const Model model = model_of(with_alphas(random_tree(seed)));
    const std::vector<Appearance> looks = appearances(model);
    const Layers layers = layers_of(model, looks, {});
    if (layers.is_whole) continue;
    const Picture picture = shoot(model, look, view).picture;
    const Camera camera = Renderer::make(model, look.renderer)->camera(view);
    for (int y = 0; y < view.height; y += 2) {
      for (int x = 0; x < view.width; x += 2) {
        const double expected = opacity_by_spans(layers, looks, camera.ray(x + 0.5, y + 0.5));
        ++seen;
        thin += expected > 0.01 && expected < 0.99;
        apart += std::abs(255 * expected - picture.at(x, y)[3]) > 1;
      }
    }
  }
  EXPECT_GT(thin, 100u);
  EXPECT_LT(double(apart), 0.01 * double(seen));
}

TEST(SeeThrough, GhostsAreSeenAsOpenscadPaintsThem) {
  Look look = look_in(Style::kOpenscad);
  look.renderer.ghosts = true;
  const double lit = 0.2 + 1 / std::sqrt(3.0), a = 128.0 / 255, hidden = 1 - (1 - a) * (1 - a);
  const Picture ghost = shoot(with_ghosts("%cube(10, center = true);"), look).picture;
  EXPECT_NEAR(middle_of(ghost)[0], hidden * 180 * lit + (1 - hidden) * 255, 1.5);
  EXPECT_NEAR(middle_of(ghost)[2], hidden * 180 * lit + (1 - hidden) * 229, 1.5);
  const Picture mark = shoot(with_ghosts("#cube(10, center = true);"), look).picture;
  EXPECT_NEAR(middle_of(mark)[0], hidden * 255 * lit + (1 - hidden) * 255, 1.5);
  EXPECT_NEAR(middle_of(mark)[1], hidden * 81 * lit + (1 - hidden) * 255, 1.5);
  const Picture painted =
      shoot(with_ghosts("%color([0, 1, 0, 1]) cube(10, center = true);"), look).picture;
  EXPECT_NEAR(middle_of(painted)[1], 255 * lit, 1.5);
  EXPECT_EQ(middle_of(painted)[0], 0);
}

TEST(SeeThrough, GhostsNeverChangeTheSolid) {
  const Model model =
      with_ghosts("%cube(30, center = true); #sphere(5); difference() { cube(9); #sphere(4); }");
  Look look = look_in(Style::kPlain);
  ViewOptions view = from_above();
  const Shot without = shoot(model, look, view);
  look.renderer.ghosts = true;
  const Shot with = shoot(model, look, view);
  ASSERT_EQ(with.frame.hits.size(), without.frame.hits.size());
  for (size_t i = 0; i < with.frame.hits.size(); ++i) {
    EXPECT_EQ(with.frame.hits[i].id, without.frame.hits[i].id);
    EXPECT_EQ(with.frame.hits[i].distance, without.frame.hits[i].distance);
  }
  EXPECT_NE(with.picture.rgba, without.picture.rgba);
}

TEST(SeeThrough, GhostsAreInTheFrame) {
  const Model model = with_ghosts("cube(1); %cube(40);");
  RendererSettings settings;
  settings.backend = Backend::kCpu;
  const auto distance = [&] { return length(Renderer::make(model, settings)->camera({}).eye); };
  const double without = distance();
  settings.ghosts = true;
  EXPECT_GT(distance(), 10 * without);
}

TEST(SeeThrough, ThrownTogetherShowsCutters) {
  Look look = look_in(Style::kOpenscad);
  look.renderer.thrown_together = true;
  const Model model = model_of(
      "difference() { cube([9, 9, 1], center = true); cylinder(h = 9, r = 3, center = true); }");
  const Picture picture = shoot(model, look).picture;
  const double lit = 0.2 + 1 / std::sqrt(3.0);
  EXPECT_NEAR(middle_of(picture)[0], 0x9D * lit, 1.5) << "the cutter's top, in the colour of cuts";
}

TEST(SeeThrough, CutsCanHaveThePartsColor) {
  Look look = look_in(Style::kOpenscad);
  const Model model = model_of(
      "difference() { color([0, 0, 1, 1]) cube([20, 20, 4], center = true);"
      "  color([1, 0, 0, 1]) multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,2],[0,0,0,1]])"
      "    sphere(1.5); }");
  EXPECT_GT(middle_of(shoot(model, look).picture)[0], 50);
  EXPECT_EQ(middle_of(shoot(model, look).picture)[2], 0);
  look.renderer.part_colors = true;
  EXPECT_EQ(middle_of(shoot(model, look).picture)[0], 0);
  EXPECT_GT(middle_of(shoot(model, look).picture)[2], 50);
}

TEST(SeeThrough, WhatCannotBeHonouredIsSaid) {
  const auto note = [](const Model& model, const RendererSettings& settings = {}) {
    return Renderer::make(model, settings)->picture_note();
  };
  EXPECT_EQ(note(model_of(slab(0.5))), "");
  EXPECT_NE(note(model_of("color([1, 0, 0, 0.5]) square(3);")), "");
  RendererSettings parts;
  parts.part_colors = true;
  const Model two = model_of(
      "difference() { union() { color([1,0,0,1]) cube(1); color([0,1,0,1]) cube(2); } cube(0.5); "
      "}");
  EXPECT_EQ(note(two), "");
  EXPECT_NE(note(two, parts), "");
}

}  // namespace
}  // namespace whittle
