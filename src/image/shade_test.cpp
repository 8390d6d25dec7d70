#include "image/shade.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "support/instruction_sets.h"
#include "trace/view.h"

namespace whittle {
namespace {

const Workers kAllWorkers(0);

/// A camera as OpenSCAD's default view: rotation (55, 0, 25).
Camera default_camera(int width = 4, int height = 4) {
  ViewOptions options;
  options.width = width;
  options.height = height;
  return make_camera(options, {}, Box{{-5, -5, -5}, {5, 5, 5}});
}

Rgb8 at(const Picture& p, int x, int y) {
  return {p.at(x, y)[0], p.at(x, y)[1], p.at(x, y)[2]};
}

/// The colours of hits seen through those places, as four bytes each.
std::vector<uint8_t> shade_samples_of(std::span<const Hit> hits,
                                      std::span<const PixelPosition> places, const Camera& camera,
                                      std::span<const Appearance> appearances,
                                      const ShadeSettings& settings) {
  const Shader shader(camera, appearances, settings);
  SeenHits seen;
  Colors colors;
  shader.samples(hits, places, {}, seen, colors);
  std::vector<uint8_t> rgba(4 * hits.size());
  shader.store(colors, rgba.data());
  return rgba;
}

/// The colour of one hit seen through a place.
Rgb8 shade_one(const Hit& hit, PixelPosition place, const Camera& camera,
               std::span<const Appearance> appearances, const ShadeSettings& settings) {
  const std::vector<uint8_t> rgba =
      shade_samples_of({&hit, 1}, {&place, 1}, camera, appearances, settings);
  return {rgba[0], rgba[1], rgba[2]};
}

/// And in the middle of the picture.
Rgb8 shade_one(const Hit& hit, const Camera& camera, std::span<const Appearance> appearances,
               const ShadeSettings& settings) {
  const PixelPosition middle{float(camera.width) / 2, float(camera.height) / 2};
  return shade_one(hit, middle, camera, appearances, settings);
}

/// Id 1: material; 2: cut; 3: coloured cut; 4: colour with a component unset.
const std::vector<Appearance> kAppearances{
    {},
    {},
    {.color = {}, .cut = true},
    {.color = {1, 0, 0.4f, 0.25f}, .cut = true},
    {.color = {1, 0, 0.5f, -1}, .cut = false},
};

ShadeSettings styled(Style style) {
  ShadeSettings settings;
  settings.style = style;
  return settings;
}

constexpr Style kAllStyles[] = {Style::kStudio, Style::kPlain, Style::kBlinn, Style::kOpenscad};

TEST(Shade, OpenscadValuesAreThoseMeasuredInOpenscad) {
  const auto face = [](Vec3f n) {
    return shade_one({30, 1, n}, default_camera(), kAppearances, styled(Style::kOpenscad));
  };
  EXPECT_EQ(face({0, 0, 1}), (Rgb8{250, 216, 44}));
  EXPECT_EQ(face({0, -1, 0}), (Rgb8{143, 123, 25}));
  EXPECT_EQ(face({1, 0, 0}), (Rgb8{165, 143, 29}));
}

TEST(Shade, OpenscadKnowsMaterialAndCutsAndNoColors) {
  const auto base = [](uint32_t id) {
    // Where |n.l| = 0.8 the base colour is seen as it is.
    const Camera camera = default_camera();
    const Vec3 l = normalize(camera.up - camera.right - camera.forward);
    const Vec3 across = normalize(cross(l, Vec3{0, 0, 1}));
    const Vec3 n = l * 0.8 + across * 0.6;
    const Hit hit{30, id, {float(n.x), float(n.y), float(n.z)}};
    return shade_one(hit, camera, kAppearances, styled(Style::kOpenscad));
  };
  EXPECT_EQ(base(1), (Rgb8{0xF9, 0xD7, 0x2C}));
  EXPECT_EQ(base(2), (Rgb8{0x9D, 0xCB, 0x51}));
  EXPECT_EQ(base(3), (Rgb8{0x9D, 0xCB, 0x51}));
  EXPECT_EQ(base(4), (Rgb8{0xF9, 0xD7, 0x2C}));
  EXPECT_EQ(base(999), (Rgb8{0xF9, 0xD7, 0x2C})) << "an id that the model does not know";
}

TEST(Shade, OpenscadHasAColorForALonePrimitive) {
  ShadeSettings settings = styled(Style::kOpenscad);
  settings.scheme = find_color_scheme("Tomorrow");
  const Hit top{30, 1, {0, 0, 1}};
  EXPECT_EQ(shade_one(top, default_camera(), kAppearances, settings), (Rgb8{62, 154, 160}));
  settings.lone_primitive = 1;
  EXPECT_EQ(shade_one(top, default_camera(), kAppearances, settings), (Rgb8{66, 113, 175}));
}

TEST(Shade, OpenscadPaintsADrawingInOneColorThatNoLightFallsOn) {
  ShadeSettings settings = styled(Style::kOpenscad);
  settings.is_drawing = true;
  for (const float side : {1.0f, -1.0f})
    for (const uint32_t id : {1u, 2u, 3u, 999u})
      EXPECT_EQ(shade_one({30, id, {0, 0, side}}, default_camera(), kAppearances, settings),
                (Rgb8{0x00, 0xBF, 0x99}));
  settings.scheme = find_color_scheme("Tomorrow");
  settings.lone_primitive = 1;
  EXPECT_EQ(shade_one({30, 1, {0, 0, 1}}, default_camera(), kAppearances, settings),
            (Rgb8{0x71, 0x8C, 0x00}));
}

TEST(Shade, OtherStylesKeepTheColorsOfADrawing) {
  for (const Style style : {Style::kStudio, Style::kPlain, Style::kBlinn}) {
    const auto seen = [&](uint32_t id, bool is_drawing) {
      ShadeSettings settings = styled(style);
      settings.is_drawing = is_drawing;
      return shade_one({30, id, {0, 0, 1}}, default_camera(), kAppearances, settings);
    };
    EXPECT_EQ(seen(3, true), seen(3, false)) << "color() is there";
    EXPECT_LT(seen(1, true).r, seen(1, false).r - 40) << "it must stand out from a light backdrop";
    EXPECT_EQ(seen(1, true), seen(2, true)) << "there are no cuts";
  }
}

TEST(Shade, ASchemeReplacesTheColorsInEveryStyle) {
  for (const Style style : kAllStyles) {
    ShadeSettings settings = styled(style);
    settings.scheme = find_color_scheme("Sunset");
    const Picture p = shade(Frame(4, 4), default_camera(), {}, settings, kAllWorkers);
    EXPECT_EQ(at(p, 1, 2), (Rgb8{0xAA, 0x44, 0x44}));
    EXPECT_EQ(p.at(1, 2)[3], 255);
  }
}

TEST(Shade, ClearSkyRunsFromTopToBottom) {
  ShadeSettings settings = styled(Style::kOpenscad);
  settings.scheme = find_color_scheme("ClearSky");
  const Picture p = shade(Frame(2, 400), default_camera(2, 400), {}, settings, kAllWorkers);
  EXPECT_EQ(at(p, 0, 0), (Rgb8{0x87, 0xCE, 0xEB}));
  EXPECT_EQ(at(p, 1, 399), (Rgb8{0xC9, 0xE9, 0xF6}));
  EXPECT_EQ(at(p, 0, 199).r, (0x87 + 0xC9) / 2);
}

TEST(Shade, WithoutBackgroundWhatIsNotHitIsTransparent) {
  Frame frame(2, 1);
  frame.at(1, 0) = {30, 1, {0, 0, 1}};
  for (const Style style : kAllStyles) {
    ShadeSettings settings = styled(style);
    settings.background = false;
    const Picture p = shade(frame, default_camera(2, 1), kAppearances, settings, kAllWorkers);
    EXPECT_EQ(p.at(0, 0)[3], 0);
    EXPECT_EQ(p.at(1, 0)[3], 255);
  }
}

/// Algorithm 4 of the paper, in double and with pow.
Rgb8 blinn_reference(const Camera& camera, Vec3 light, const Hit& hit, Vec3f base, double px,
                     double py) {
  const Ray ray = camera.ray(px, py);
  Vec3 n{hit.normal.x, hit.normal.y, hit.normal.z};
  if (dot(n, ray.direction) > 0) n = -n;
  const Vec3 point = ray.origin + ray.direction * double(hit.distance);
  const Vec3 l = normalize(light - point);
  const double n_l = std::max(dot(n, l), 0.0);
  const double n_h = std::max(dot(n, normalize(l - ray.direction)), 0.0);
  const double white = n_l > 0 ? 0.3 * std::pow(n_h, 16) : 0;
  const auto byte = [&](double b) {
    return uint8_t(std::clamp(std::lround((b * (0.2 + 0.7 * n_l) + white) * 255), 0L, 255L));
  };
  return {byte(base.x), byte(base.y), byte(base.z)};
}

int distance(Rgb8 a, Rgb8 b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

RC_GTEST_PROP(Shade, BlinnIsThePapersFormula, ()) {
  const auto unit = [] { return *rc::gen::inRange(-1000, 1001) / 1000.0; };
  ViewOptions options;
  options.rotation_degrees = Vec3{unit() * 180, unit() * 180, unit() * 180};
  options.orthographic = *rc::gen::arbitrary<bool>();
  // Far from the origin nothing changes, as all is relative to the eye.
  options.target = Vec3{1e6 * *rc::gen::inRange(-1, 2), 7, 0};
  const Camera camera = make_camera(options, {}, {});
  const Vec3 n = normalize(Vec3{unit(), unit(), unit() + 1e-3});
  const Hit hit{float(100 + 50 * unit()), 3, {float(n.x), float(n.y), float(n.z)}};
  ShadeSettings settings = styled(Style::kBlinn);
  if (*rc::gen::arbitrary<bool>()) {
    settings.light = *options.target + Vec3{unit(), unit(), unit()} * 200;
  }
  const float px = 512 * float(std::fabs(unit())), py = 512 * float(std::fabs(unit()));
  const Rgb8 expected = blinn_reference(camera, settings.light.value_or(camera.eye), hit,
                                        {1, 0, 0.4f}, double(px), double(py));
  const Rgb8 got = shade_one(hit, {px, py}, camera, kAppearances, settings);
  RC_ASSERT(distance(got, expected) <= 1);
}

TEST(Shade, BlinnBehindTheLightIsAmbientAlone) {
  ShadeSettings settings = styled(Style::kBlinn);
  settings.light = Vec3{0, 0, -1000};
  const Hit hit{36, 3, {0, 0, 1}};
  EXPECT_EQ(shade_one(hit, default_camera(), kAppearances, settings), (Rgb8{51, 0, 20}));
}

RC_GTEST_PROP(Shade, BothSidesOfASurfaceLookAlike, ()) {
  const auto unit = [] { return float(*rc::gen::inRange(-1000, 1001)) / 1000; };
  const Vec3f n = normalize(Vec3f{unit(), unit(), unit() + 1e-3f});
  for (const Style style : kAllStyles) {
    const Rgb8 a = shade_one({30, 1, n}, default_camera(), kAppearances, styled(style));
    const Rgb8 b = shade_one({30, 1, -n}, default_camera(), kAppearances, styled(style));
    RC_ASSERT(a == b);
  }
}

TEST(Shade, StudioTellsTheThreeFacesOfACubeApart) {
  const auto face = [](Vec3f n) {
    return shade_one({30, 1, n}, default_camera(), kAppearances, styled(Style::kStudio)).g;
  };
  const int top = face({0, 0, 1}), front = face({0, -1, 0}), side = face({1, 0, 0});
  EXPECT_GT(top, front + 20);
  EXPECT_GT(front, side + 20);
  EXPECT_LT(top, 245) << "room for the highlight";
  EXPECT_GT(side, 90) << "no side is lost in the dark";
}

TEST(Shade, StudioHonoursColors) {
  const Rgb8 c =
      shade_one({30, 3, {0, 0, 1}}, default_camera(), kAppearances, styled(Style::kStudio));
  EXPECT_GT(c.r, c.b + 60);
  EXPECT_GT(c.b, c.g + 40);
  const Hit material{30, 1, {0, 0, 1}}, cut{30, 2, {0, 0, 1}};
  EXPECT_GT(distance(shade_one(material, default_camera(), kAppearances, styled(Style::kPlain)),
                     shade_one(cut, default_camera(), kAppearances, styled(Style::kPlain))),
            20);
}

/// Hits of all kinds next to one another, and background.
Frame confetti(int width, int height) {
  Frame frame(width, height);
  uint32_t seed = 1;
  const auto unit = [&] {
    seed = seed * 1664525u + 1013904223u;
    return float(seed >> 8) / float(1 << 23) - 1;
  };
  for (Hit& h : frame.hits) {
    if (unit() > 0) h = {30 + unit(), 1 + (seed >> 29), normalize(Vec3f{unit(), unit(), unit()})};
  }
  return frame;
}

/// The middles of all pixels.
std::vector<PixelPosition> middles(const Frame& frame) {
  std::vector<PixelPosition> places;
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) places.push_back({float(x) + 0.5f, float(y) + 0.5f});
  }
  return places;
}

/// All settings that change how colours are computed.
std::vector<ShadeSettings> all_settings() {
  std::vector<ShadeSettings> all;
  for (const Style style : kAllStyles) {
    for (const bool background : {true, false}) {
      all.push_back(styled(style));
      all.back().background = background;
    }
  }
  return all;
}

TEST(Shade, ThePictureIsTheSamplesInThePixelsMiddlesWhateverTheThreads) {
  for (const int width : {1, 5, 16, 61}) {
    const Frame frame = confetti(width, 47);
    const Camera camera = default_camera(width, 47);
    const std::vector<PixelPosition> places = middles(frame);
    for (const ShadeSettings& settings : all_settings()) {
      const Picture p = shade(frame, camera, kAppearances, settings, Workers(0));
      const std::vector<uint8_t> samples =
          shade_samples_of(frame.hits, places, camera, kAppearances, settings);
      for (size_t i = 0; i < frame.hits.size(); ++i) {
        // What is not there has no colour; its bytes are not looked at.
        const size_t from = settings.background || frame.hits[i].hit() ? 0 : 3;
        ASSERT_TRUE(
            std::equal(&p.rgba[4 * i + from], &p.rgba[4 * i + 3] + 1, &samples[4 * i + from]))
            << width << " " << i;
      }
      EXPECT_EQ(shade(frame, camera, kAppearances, settings, Workers(1)).rgba, p.rgba);
    }
  }
}

TEST(Shade, EveryInstructionSetGivesTheSameBytes) {
  const Frame frame = confetti(67, 40);
  for (const bool orthographic : {false, true}) {
    Camera camera = default_camera(67, 40);
    camera.orthographic = orthographic;
    for (const ShadeSettings& settings : all_settings()) {
      const Picture expected = shade(frame, camera, kAppearances, settings, Workers(0));
      const std::vector<uint8_t> samples =
          shade_samples_of(frame.hits, middles(frame), camera, kAppearances, settings);
      for_every_instruction_set([&] {
        EXPECT_EQ(shade(frame, camera, kAppearances, settings, Workers(0)).rgba, expected.rgba);
        EXPECT_EQ(shade_samples_of(frame.hits, middles(frame), camera, kAppearances, settings),
                  samples);
      });
    }
  }
}

TEST(Shade, WhatNoByteHoldsIsClamped) {
  Colors colors;
  const float all[] = {
      -1, 0, 1, 7, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()};
  const int bytes[] = {0, 0, 255, 255, 255, 0};
  colors.resize(std::size(all));
  for (size_t i = 0; i < std::size(all); ++i)
    colors.r[i] = colors.g[i] = colors.b[i] = colors.alpha[i] = all[i];
  for (const Style style : kAllStyles) {
    std::vector<uint8_t> rgba(4 * std::size(all));
    Shader(default_camera(), {}, styled(style)).store(colors, rgba.data());
    for (size_t i = 0; i < rgba.size(); ++i) EXPECT_EQ(rgba[i], bytes[i / 4]) << i;
  }
}

/// The colour of a hit that all lights fall on (but for the studio's rim light, which comes from
/// behind), in the middle of a picture, with that shadow.
Rgb8 in_shadow(Style style, uint8_t shadow, bool with_shadows = true) {
  const Camera camera = default_camera(1, 1);
  const Vec3 n = normalize(camera.up * 0.4 - camera.forward);
  Frame frame(1, 1);
  frame.at(0, 0) = {30, 1, {float(n.x), float(n.y), float(n.z)}};
  ShadeSettings settings = styled(style);
  settings.shadows = with_shadows;
  settings.light = camera.eye + camera.up * 20;
  const std::vector<uint8_t> shadows{shadow};
  const Picture picture = shade(frame, camera, kAppearances, settings, kAllWorkers,
                                with_shadows ? shadows : std::span<const uint8_t>());
  return at(picture, 0, 0);
}

TEST(Shade, WhatTheLampDoesNotReachIsAmbient) {
  const Vec3f base = base_color({}, effective_scheme(styled(Style::kBlinn))) * kBlinnAmbient;
  EXPECT_EQ(in_shadow(Style::kBlinn, 1),
            (Rgb8{to_8_bits(base.x), to_8_bits(base.y), to_8_bits(base.z)}));
  EXPECT_EQ(in_shadow(Style::kBlinn, 0), in_shadow(Style::kBlinn, 0, false));
  EXPECT_GT(in_shadow(Style::kBlinn, 0).g, 2 * in_shadow(Style::kBlinn, 1).g);
}

TEST(Shade, EachOfTheStudiosLightsHasAShadowOfItsOwn) {
  const auto brightness = [](uint8_t shadow) { return int(in_shadow(Style::kStudio, shadow).g); };
  EXPECT_LT(brightness(1), brightness(0) - 40) << "key";
  EXPECT_LT(brightness(2), brightness(0)) << "fill";
  EXPECT_EQ(brightness(4), brightness(0)) << "the rim light does not fall here";
  EXPECT_LT(brightness(3), brightness(1));
  EXPECT_GT(brightness(7), 20) << "the surroundings have none";
}

TEST(Shade, OpenscadHasNoLightsThatCast) {
  EXPECT_TRUE(lights(default_camera(), styled(Style::kOpenscad)).empty());
  EXPECT_EQ(in_shadow(Style::kOpenscad, 7), in_shadow(Style::kOpenscad, 0, false));
}

TEST(Shade, TheKeyLightOfShadowsEndsWhereTheSurfaceTurnsAway) {
  // A surface just beyond the terminator: without shadows the key reaches round the corner.
  const Camera camera = default_camera(1, 1);
  const Light key = lights(camera, styled(Style::kStudio))[0];
  const auto green = [&](double cosine, bool shadows) {
    const Vec3 aside = normalize(cross(key.at, camera.right));
    const Vec3 n = key.at * cosine + aside * std::sqrt(1 - cosine * cosine);
    Frame frame(1, 1);
    frame.at(0, 0) = {30, 1, {float(n.x), float(n.y), float(n.z)}};
    ShadeSettings settings = styled(Style::kStudio);
    settings.shadows = shadows;
    return int(at(shade(frame, camera, kAppearances, settings, kAllWorkers), 0, 0).g);
  };
  EXPECT_GT(green(-0.02, false), green(-0.02, true) + 5);
  EXPECT_NEAR(green(-0.001, true), green(0.001, true), 1) << "no step at the terminator";
}

}  // namespace
}  // namespace whittle
