// The public API, seen as its users see it: through its header alone.
#include "whittle/whittle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "base/folder_for_test.h"

namespace {

namespace fs = std::filesystem;
using whittle::Backend;
using whittle::Curves;
using whittle::Failure;
using whittle::LoadOptions;
using whittle::Rendering;
using whittle::RenderOptions;
using whittle::SessionOptions;
using whittle::Solid;
using whittle::Style;
using whittle::TestFolder;

constexpr const char* kCubeText = "cube(0); cube(10, center = true);";

/// What a call that must fail says.
template <class Call>
Failure failure_of(const Call& call) {
  try {
    call();
  } catch (const Failure& failure) {
    return failure;
  }
  ADD_FAILURE() << "it does not fail";
  return {Failure::Cause::kInput, ""};
}

RenderOptions from_above() {
  RenderOptions options;
  options.width = 31;
  options.height = 21;
  options.eye = {0, 0, 50};
  options.center = {0, 0, 0};
  return options;
}

TEST(Solid, TellsWhatItIs) {
  const Solid solid = Solid::parse(kCubeText);
  EXPECT_TRUE(solid.is_complete());
  EXPECT_TRUE(solid.warnings().empty());
  EXPECT_EQ(solid.statement_count(), 2u);
  const auto bounds = solid.bounds();
  ASSERT_TRUE(bounds);
  EXPECT_EQ((*bounds)[0], (whittle::Point{-5, -5, -5}));
  EXPECT_EQ((*bounds)[1], (whittle::Point{5, 5, 5}));
}

TEST(Solid, HasNoBoundsIfEmptyOrUnbounded) {
  EXPECT_FALSE(Solid::parse("").bounds());
  EXPECT_FALSE(Solid::parse("halfspace(n = [0, 0, 1], d = 0);").bounds());
}

TEST(Solid, IsNotCompleteIfSomethingIsNotSupported) {
  const Solid solid = Solid::parse("\nroof() square(1);", "part");
  EXPECT_FALSE(solid.is_complete());
  ASSERT_EQ(solid.warnings().size(), 1u);
  EXPECT_EQ(solid.warnings()[0].find("part:2:1: warning: "), 0u);
}

TEST(Solid, LoadsFilesAndSaysWhyNot) {
  const fs::path file = fs::temp_directory_path() / "whittle-api-test.csg";
  std::ofstream(file) << kCubeText;
  EXPECT_EQ(Solid::load(file.string()).statement_count(), 2u);
  fs::remove(file);
  const Failure absent = failure_of([&] { (void)Solid::load(file.string()); });
  EXPECT_EQ(absent.cause(), Failure::Cause::kInput);
  EXPECT_NE(std::string(absent.what()).find("No such file"), std::string::npos);
  const Failure broken = failure_of([] { (void)Solid::parse("cube(", "part"); });
  EXPECT_EQ(broken.cause(), Failure::Cause::kInput);
  EXPECT_EQ(std::string(broken.what()).find("part:1:"), 0u);
}

TEST(Solid, CurvesAreChosenWhenLoading) {
  const auto normal_z = [](Curves curves) {
    const Solid ball = Solid::parse("sphere(10, $fn = 4);", "ball", {.curves = curves});
    return ball.render(from_above()).normal[3 * (10 * 31 + 20) + 2];
  };
  EXPECT_EQ(normal_z(Curves::kAuto), normal_z(Curves::kFacets));
  EXPECT_NE(normal_z(Curves::kAuto), normal_z(Curves::kSmooth));
}

TEST(Solid, AStyleBringsItsFacetsAlong) {
  constexpr const char* kBall = "sphere(10);";
  const RenderOptions look = from_above();
  RenderOptions openscad = look;
  openscad.style = Style::kOpenscad;
  const Solid for_openscad = Solid::parse(kBall, "ball", {.style = Style::kOpenscad});
  const Solid facets = Solid::parse(kBall, "ball", {.curves = Curves::kFacets});
  EXPECT_EQ(for_openscad.render(look).rgba, facets.render(openscad).rgba);
  EXPECT_NE(for_openscad.render(look).rgba, facets.render(look).rgba);
  EXPECT_NE(for_openscad.render(look).rgba, Solid::parse(kBall).render(openscad).rgba);
}

TEST(Solid, KnowsWhereItsStatementsStand) {
  const Solid solid = Solid::parse("cube(0);\ngroup() {\n  *sphere(1);\n  cube(10); }");
  EXPECT_EQ(solid.statement_count(), 3u);
  EXPECT_EQ(solid.place(3), (whittle::Place{4, 3}));
  EXPECT_EQ(solid.place(2), std::nullopt) << "it was left out";
  for (const std::uint32_t id : {0u, 4u, UINT32_MAX}) EXPECT_EQ(solid.place(id), std::nullopt);
}

TEST(Rendering, HoldsTheFactsOfEveryPixel) {
  const Rendering made = Solid::parse(kCubeText).render(from_above());
  ASSERT_EQ(made.width, 31);
  ASSERT_EQ(made.height, 21);
  ASSERT_EQ(made.id.size(), size_t(31 * 21));
  ASSERT_EQ(made.distance.size(), made.id.size());
  ASSERT_EQ(made.normal.size(), 3 * made.id.size());
  ASSERT_EQ(made.rgba.size(), 4 * made.id.size());
  const size_t middle = 10 * 31 + 15;
  EXPECT_EQ(made.id[middle], 2u);
  EXPECT_FLOAT_EQ(made.distance[middle], 45);
  EXPECT_EQ(made.normal[3 * middle + 2], 1);
  EXPECT_EQ(made.rgba[3], 255) << "the background is opaque";
  EXPECT_EQ(made.id[0], 0u);
  EXPECT_TRUE(std::isinf(made.distance[0]));
  EXPECT_EQ(made.backend, Backend::kCpu);
}

TEST(Rendering, DoesNotDependOnThreadsNorItsFactsOnTheBackend) {
  const Solid solid = Solid::parse("difference() { cube(10, center = true); sphere(6); }");
  const RenderOptions options{.width = 40, .height = 40};
  const Rendering one = solid.render(options, {.threads = 1});
  const Rendering three = solid.render(options, {.threads = 3});
  EXPECT_EQ(one.rgba, three.rgba);
  EXPECT_EQ(one.distance, three.distance);
  EXPECT_EQ(one.normal, three.normal);
  const Rendering oracle = solid.render(options, {.backend = Backend::kOracle});
  EXPECT_EQ(oracle.backend, Backend::kOracle);
  size_t differing = 0;
  for (size_t i = 0; i < one.id.size(); ++i) differing += one.id[i] != oracle.id[i];
  EXPECT_LE(differing, 2u) << "rays along edges";
}

TEST(Rendering, DoesNotDependOnTheMemoryOfCells) {
  const Solid solid = Solid::parse(
      "difference() { cube(10, center = true); sphere(6); translate([5, 0, 0]) sphere(3); }");
  const RenderOptions options{.width = 40, .height = 40};
  const Rendering many = solid.render(options);
  for (const size_t bytes : {0u, 10'000u, 100'000u}) {
    const Rendering few = solid.render(options, {.cell_memory = bytes});
    EXPECT_EQ(few.id, many.id) << bytes;
    EXPECT_EQ(few.rgba, many.rgba) << bytes;
  }
}

TEST(Solid, RefusesWhatPassesALimit) {
  const auto refusal = [](const LoadOptions& options) {
    return std::string(
        failure_of([&] { Solid::parse("group() { cube([1, 2, 3]); }", "t", options); }).what());
  };
  LoadOptions depth, nodes, values, facets;
  depth.limits.depth = 0;
  EXPECT_NE(refusal(depth).find("the limit 'depth' can be raised"), std::string::npos);
  nodes.limits.nodes = 1;
  EXPECT_NE(refusal(nodes).find("the limit 'nodes' can be raised"), std::string::npos);
  values.limits.values = 3;
  EXPECT_NE(refusal(values).find("the limit 'values' can be raised"), std::string::npos);
  facets.limits.facets = 5;
  EXPECT_NO_THROW(Solid::parse("cube(1);", "t", facets));
  EXPECT_THROW(Solid::parse("cylinder($fn = 4);", "t", facets), Failure);
}

TEST(Rendering, IsTransparentWithoutBackground) {
  RenderOptions options = from_above();
  options.background = false;
  EXPECT_GT(Solid::parse(kCubeText).render(options).rgba[3], 0) << "the shadow on the ground";
  options.ground = false;
  const Rendering made = Solid::parse(kCubeText).render(options);
  EXPECT_TRUE(made.transparent);
  EXPECT_EQ(made.rgba[3], 0);
}

TEST(Rendering, RefusesOptionsThatDoNotExist) {
  const Solid solid = Solid::parse(kCubeText);
  const auto refused = [&](const auto& change) {
    RenderOptions options = from_above();
    change(options);
    const Failure failure = failure_of([&] { (void)solid.render(options); });
    EXPECT_EQ(failure.cause(), Failure::Cause::kUsage) << failure.what();
    return std::string(failure.what());
  };
  EXPECT_NE(refused([](auto& o) { o.color_scheme = "x"; }).find("Cornfield"), std::string::npos);
  refused([](auto& o) { o.width = 0; });
  refused([](auto& o) { o.height = 70000; });
  refused([](auto& o) { o.antialias = 17; });
  refused([](auto& o) { o.fov_degrees = 180; });
  refused([](auto& o) { o.distance = -1; });
  refused([](auto& o) { o.eye = {NAN, 0, 0}; });
  refused([](auto& o) { o.shadows = true, o.style = Style::kOpenscad; });
  EXPECT_EQ(failure_of([] { (void)Solid::parse("", "x", {.threads = -1}); }).cause(),
            Failure::Cause::kUsage);
  EXPECT_EQ(failure_of([&] { (void)solid.render({}, {.threads = 1025}); }).cause(),
            Failure::Cause::kUsage);
}

TEST(Rendering, IsWrittenByTheEndingOfTheName) {
  const TestFolder folder;
  Rendering made = Solid::parse(kCubeText).render(from_above());
  made.write(folder / "x.png");
  made.write(folder / "x.exr");
  EXPECT_GT(fs::file_size(folder / "x.png"), 100u);
  EXPECT_GT(fs::file_size(folder / "x.exr"), 300u);
  EXPECT_EQ(failure_of([&] { made.write(folder / "x.gif"); }).cause(), Failure::Cause::kUsage);
  EXPECT_EQ(failure_of([&] { made.write(folder / "absent/x.png"); }).cause(),
            Failure::Cause::kMachine);
  made.rgba.pop_back();
  EXPECT_EQ(failure_of([&] { made.write(folder / "y.png"); }).cause(), Failure::Cause::kUsage);
  EXPECT_FALSE(fs::exists(folder / "y.png"));
}

}  // namespace
