#include "whittle/renderer.h"
#include "whittle/paper_settings_for_test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "csg/read_csg.h"
#include "model/instances.h"
#include "support/read_text.h"

namespace whittle {
namespace {

constexpr const char* kPart = "difference() { cube(20, center = true); sphere(12); }";

ViewOptions small_view() {
  ViewOptions view;
  view.width = view.height = 24;
  return view;
}

Camera camera_of(const Model& model, const ViewOptions& view,
                 const RendererSettings& settings = {}) {
  Result<Renderer> renderer = Renderer::make(model, settings);
  EXPECT_TRUE(bool(renderer));
  return renderer->camera(view);
}

Frame frame_of(const Model& model, const RendererSettings& settings) {
  Result<Renderer> renderer = Renderer::make(model, settings);
  EXPECT_TRUE(bool(renderer));
  const Camera camera = renderer->camera(small_view());
  EXPECT_TRUE(renderer->prepare(camera));
  return *renderer->trace(camera);
}

TEST(Renderer, SizesOfPicturesHaveLimits) {
  for (const auto& [w, h] : {std::pair(1, 1), std::pair(65535, 4096), std::pair(16384, 16384)})
    EXPECT_TRUE(bool(check_picture_size(w, h))) << w << " x " << h;
  for (const auto& [w, h] :
       {std::pair(0, 1), std::pair(1, -1), std::pair(65536, 1), std::pair(16385, 16384)})
    EXPECT_FALSE(bool(check_picture_size(w, h))) << w << " x " << h;
}

TEST(Renderer, FramesTheBoundsOfTheSolid) {
  // The cutter is far larger than what it cuts, and that says nothing.
  const Model model =
      model_of("difference() { cube(2, center = true); cylinder(h = 99, r = 0.5); }");
  const Camera camera = camera_of(model, small_view());
  // d = (diagonal / 2) / sin(fov / 2), looking at the middle.
  EXPECT_NEAR(length(camera.eye), std::sqrt(3.0) / std::sin(11.25 / 180 * std::acos(-1.0)), 2e-5);
}

TEST(Renderer, FramesWhatIsLeftOfABodyThatLosesItsEnd) {
  const Model cut = model_of("difference() { cube([2, 2, 9]); translate([-1, -1, 2]) cube(99); }");
  const Model whole = model_of("cube(2);");
  EXPECT_LT(length(camera_of(cut, small_view()).eye - camera_of(whole, small_view()).eye), 1e-4);
}

TEST(Renderer, FramesAlikeWithEveryBackend) {
  const Model model = model_of(kPart);
  for (const Backend backend : {Backend::kCpu, Backend::kOracle})
    EXPECT_EQ(camera_of(model, small_view(), {.backend = backend, .subdivide = {}}).eye,
              camera_of(model, small_view()).eye);
}

/// The share of the picture's width or height, whichever is more, that is filled.
double fill_of(const Model& model, ViewOptions view) {
  view.tight = true;
  Result<Renderer> renderer = Renderer::make(model, {});
  EXPECT_TRUE(bool(renderer));
  const Camera camera = renderer->camera(view);
  EXPECT_TRUE(renderer->prepare(camera));
  const Frame frame = *renderer->trace(camera);
  int x0 = frame.width, x1 = 0, y0 = frame.height, y1 = 0;
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      if (!frame.at(x, y).hit()) continue;
      x0 = std::min(x0, x), x1 = std::max(x1, x + 1);
      y0 = std::min(y0, y), y1 = std::max(y1, y + 1);
    }
  }
  return std::max(double(x1 - x0) / frame.width, double(y1 - y0) / frame.height);
}

TEST(Renderer, FramedTightlyTheSolidFillsTheSideItFillsMost) {
  for (const char* text :
       {kPart, "cube([100, 1, 1]);", "cube([1, 1, 50]);", "sphere(10);",
        "cylinder(h = 30, r1 = 10, r2 = 0);", "rotate([90, 0, 30]) cylinder(h = 80, r = 3);",
        "difference() { cube(9, center = true); translate([-9, -9, 1]) cube(20); }",
        "translate([500, 0, 7]) union() { cube(4); translate([30, 0, 0]) sphere(3); }",
        "hull() { cube(3); translate([10, 20, 30]) cube(1); }"}) {
    const Model model = model_of(text);
    for (const bool orthographic : {false, true}) {
      for (const auto& [width, height] : {std::pair(400, 400), std::pair(600, 300)}) {
        ViewOptions view;
        view.width = width, view.height = height;
        view.orthographic = orthographic;
        EXPECT_NEAR(fill_of(model, view), kTightFill, 0.01)
            << text << " " << width << " x " << height << (orthographic ? " orthographic" : "");
      }
    }
  }
}

TEST(Renderer, ASolidWithoutEndIsFramedByItsFiniteParts) {
  const Model endless = model_of("cube(2); halfspace(n = [0, 0, 1], d = 0);");
  const Model finite = model_of("cube(2);");
  EXPECT_EQ(camera_of(endless, small_view()).eye, camera_of(finite, small_view()).eye);
}

TEST(Renderer, StyleOpenscadPaintsWhatTheSolidHoldsNotWhatOwnsIt) {
  // The cutter only touches the top, whose owner is the cube; OpenSCAD paints it as cut.
  const Model model = model_of("difference() { cube(10); translate([-1, -1, 10]) cube(20); }");
  Result<Renderer> renderer = Renderer::make(model, {});
  ASSERT_TRUE(bool(renderer));
  ViewOptions down = small_view();
  down.target = Vec3{5, 5, 0}, down.rotation_degrees = Vec3{}, down.distance = 100;
  const Camera camera = renderer->camera(down);
  ASSERT_TRUE(renderer->prepare(camera));
  const Frame frame = *renderer->trace(camera);
  EXPECT_EQ(frame.at(12, 12).id, 1u);
  ShadeSettings settings;
  settings.style = Style::kOpenscad;
  const Picture picture = *renderer->shade(frame, camera, settings, 1);
  const uint8_t* top = picture.at(12, 12);
  EXPECT_GT(top[1], top[0]) << "green, not yellow";
}

constexpr const char* kDrawing =
    "difference() { square([20, 10]); translate([5, 5]) circle(3); } translate([30, 5]) circle(4);";

TEST(Renderer, ADrawingIsFramedAndSeenInItsPlane) {
  const Model model = model_of(kDrawing);
  const Camera camera = camera_of(model, small_view());
  // d = (diagonal / 2) / sin(fov / 2), looking at the middle of the flat box.
  EXPECT_NEAR(length(camera.eye - Vec3{17, 5, 0}),
              std::hypot(17.0, 5.0) / std::sin(11.25 / 180 * std::acos(-1.0)), 1e-4);
  for (const Backend backend : {Backend::kCpu, Backend::kOracle}) {
    const Frame frame = frame_of(model, {.backend = backend, .subdivide = {}});
    size_t seen = 0;
    for (int y = 0; y < 24; ++y) {
      for (int x = 0; x < 24; ++x) {
        const Hit& hit = frame.at(x, y);
        if (!hit.hit()) continue;
        ++seen;
        const Ray ray = camera.ray(x + 0.5, y + 0.5);
        EXPECT_NEAR(ray.origin.z + ray.direction.z * double(hit.distance), 0, 1e-4);
        EXPECT_EQ(hit.normal, (Vec3f{0, 0, 1}));
      }
    }
    EXPECT_GT(seen, 30u);
  }
}

TEST(Renderer, StyleOpenscadDrawsOutlinesWhereTheyAreThere) {
  ReadOptions options;
  options.outlines = true;
  const Model with = read_csg(kDrawing, "<test>", options)->model, without = model_of(kDrawing);
  const auto red_pixels = [](const Model& model, Style style) {
    Result<Renderer> renderer = Renderer::make(model, {});
    const Camera camera = renderer->camera(small_view());
    EXPECT_TRUE(renderer->prepare(camera));
    ShadeSettings settings;
    settings.style = style;
    const Picture picture = *renderer->shade(*renderer->trace(camera), camera, settings, 1);
    size_t count = 0;
    for (size_t i = 0; i < picture.rgba.size(); i += 4)
      count += picture.rgba[i] == 255 && picture.rgba[i + 1] == 0;
    return count;
  };
  EXPECT_GT(red_pixels(with, Style::kOpenscad), 40u);
  EXPECT_EQ(red_pixels(without, Style::kOpenscad), 0u);
  EXPECT_EQ(red_pixels(with, Style::kStudio), 0u);
}

TEST(Renderer, AutoIsABackendThatIsNamed) {
  const Model model = model_of(kPart);
  Result<Renderer> renderer = Renderer::make(model, {});
  ASSERT_TRUE(bool(renderer));
  EXPECT_NE(renderer->backend(), Backend::kAuto);
  ASSERT_TRUE(renderer->prepare(renderer->camera(small_view())));
  EXPECT_STREQ(renderer->tracer().name(), name_of(backend_choices(), renderer->backend()));
}

TEST(Renderer, TheOracleHasNeitherHalfSpacesNorCells) {
  const Model model = model_of(kPart);
  Result<Renderer> renderer = Renderer::make(model, {.backend = Backend::kOracle, .subdivide = {}});
  ASSERT_TRUE(bool(renderer));
  ASSERT_TRUE(renderer->prepare(renderer->camera(small_view())));
  EXPECT_STREQ(renderer->tracer().name(), "oracle");
  EXPECT_EQ(renderer->scene(), nullptr);
  EXPECT_EQ(renderer->cells(), nullptr);
  EXPECT_EQ(renderer->cpu_tracer(), nullptr);
}

TEST(Renderer, StepsCanBeRepeated) {
  const Model model = model_of(kPart);
  const Camera camera = camera_of(model, small_view());
  Result<Renderer> renderer = Renderer::make(model, {});
  ASSERT_TRUE(bool(renderer));
  std::vector<Picture> pictures;
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(renderer->prepare(camera));
    const Frame frame = *renderer->trace(camera);
    EXPECT_EQ(renderer->cpu_tracer()->stats().rays, uint64_t(24 * 24)) << "the tracer is a new one";
    pictures.push_back(*renderer->shade(frame, camera, {}, 4));
  }
  EXPECT_EQ(pictures[0].rgba, pictures[1].rgba);
}

TEST(Renderer, ThePixelThresholdReachesTheCells) {
  const Model model = model_of(kPart);
  const Camera camera = camera_of(model, small_view());
  const auto cells = [&](double threshold) {
    RendererSettings settings;
    settings.subdivide.leaf_size = 1;
    settings.pixel_threshold = threshold;
    Result<Renderer> renderer = Renderer::make(model, settings);
    EXPECT_TRUE(bool(renderer));
    EXPECT_TRUE(renderer->prepare(camera, Refine::kAll));
    return statistics_of(*renderer->cells()).cell_count();
  };
  EXPECT_EQ(cells(1000), 1u) << "all of the model is smaller";
  EXPECT_LT(cells(8), cells(2));
}

constexpr const char* kManyCuts =
    "difference() { cube(20, center = true); sphere(12); translate([4, 4, 4]) sphere(9);"
    "translate([-8, 2, 9]) cylinder(r = 4, h = 30, center = true); }";

TEST(Renderer, KeepsItsCellsForOtherCamerasAndShowsWhatAFreshOneShows) {
  const Model model = model_of(kManyCuts);
  ShadeSettings look;
  look.shadows = true;
  for (const uint32_t leaf_size : {2u, kAutoLeafSize}) {
    RendererSettings settings = paper_settings(Backend::kCpu);
    settings.subdivide.leaf_size = leaf_size;
    Result<Renderer> kept = Renderer::make(model, settings);
    ViewOptions view;
    ASSERT_TRUE(kept->prepare(kept->camera(small_view())));
    uint64_t refined = 0;
    for (int step = 0; step < 12; ++step) {
      SCOPED_TRACE(step);
      // Around, near and far; some pictures are larger.
      view.width = view.height = step % 5 == 4 ? 96 : 64;
      view.rotation_degrees = Vec3{55, 0, 7.0 * step};
      view.distance = 60 + 30 * (step % 3);
      view.orthographic = step == 7;
      Result<Renderer> fresh = Renderer::make(model, settings);
      const Camera camera = fresh->camera(view);
      ASSERT_TRUE(fresh->prepare(camera));
      const Frame frame = *kept->trace(camera), expected = *fresh->trace(camera);
      ASSERT_EQ(frame.hits.size(), expected.hits.size());
      EXPECT_EQ(
          std::memcmp(frame.hits.data(), expected.hits.data(), frame.hits.size() * sizeof(Hit)), 0);
      // Places between pixels, and what lights see.
      EXPECT_EQ(kept->shade(frame, camera, look, 4)->rgba,
                fresh->shade(expected, camera, look, 4)->rgba);
      if (step > 0) refined += statistics_of(*fresh->cells()).refined;
    }
    EXPECT_LT(statistics_of(*kept->cells()).refined, refined / 2);
  }
}

TEST(Renderer, WithALeafSizeOfAutoAPictureOfAnotherSizeHasItsOwnCells) {
  const Model model = model_of(kManyCuts);
  RendererSettings settings;
  settings.backend = Backend::kCpu;
  settings.pixel_threshold = 1;
  ViewOptions view = small_view();
  Result<Renderer> kept = Renderer::make(model, settings), fresh = Renderer::make(model, settings);
  ASSERT_TRUE(kept->prepare(kept->camera(view), Refine::kAll));
  view.width = view.height = 400;
  const Camera camera = kept->camera(view);
  ASSERT_TRUE(kept->trace(camera));
  ASSERT_TRUE(fresh->prepare(camera, Refine::kAll));
  EXPECT_EQ(statistics_of(*kept->cells()).cells, statistics_of(*fresh->cells()).cells);
}

TEST(Renderer, ShadesAPictureAsItsOwnCameraSeesIt) {
  const Model model = model_of(kManyCuts);
  Result<Renderer> renderer = Renderer::make(model, paper_settings(Backend::kCpu));
  ViewOptions view = small_view();
  const Camera near = renderer->camera(view);
  view.distance = 2000;
  const Camera far = renderer->camera(view);
  ASSERT_TRUE(renderer->prepare(near));
  const Frame frame = *renderer->trace(near);
  const Picture expected = *renderer->shade(frame, near, {}, 4);
  ASSERT_TRUE(renderer->trace(far));
  EXPECT_EQ(renderer->shade(frame, near, {}, 4)->rgba, expected.rgba);
}

TEST(Renderer, OnlyASolidWithAnEndHasAGround) {
  const auto has_ground = [](const char* text) {
    const Model model = model_of(text);
    Result<Renderer> renderer = Renderer::make(model, {.backend = Backend::kCpu, .subdivide = {}});
    const Camera camera = renderer->camera(small_view());
    EXPECT_TRUE(renderer->prepare(camera));
    const Frame frame = *renderer->trace(camera);
    ShadeSettings look;
    look.style = Style::kStudio;
    look.background = false;
    const auto pixels = [&](bool ground) {
      look.ground = ground;
      return renderer->shade(frame, camera, look, 1)->rgba;
    };
    return pixels(true) != pixels(false);
  };
  EXPECT_TRUE(has_ground("cube(9);"));
  // A bar that goes down without end below a cube.
  EXPECT_FALSE(
      has_ground("union() { cube(9); intersection() {"
                 "halfspace(n = [0, 0, 1], d = 0); halfspace(n = [1, 0, 0], d = 5);"
                 "halfspace(n = [-1, 0, 0], d = -4); halfspace(n = [0, 1, 0], d = 5);"
                 "halfspace(n = [0, -1, 0], d = -4); } }"));
}

TEST(Renderer, AnEmptyModelIsBackgroundWithEveryBackend) {
  const Model model = model_of("");
  for (const Backend backend : {Backend::kCpu, Backend::kOracle}) {
    for (const Hit& hit : frame_of(model, {.backend = backend, .subdivide = {}}).hits)
      EXPECT_FALSE(hit.hit());
  }
}

}  // namespace
}  // namespace whittle
