// Tests of the yardstick: the oracle agrees with itself, and tracers that are wrong on purpose are
// caught.
#include <gtest/gtest.h>

#include <cmath>

#include "support/adapted_tracer.h"
#include "support/agreement.h"
#include "support/random_tree.h"
#include "support/read_text.h"
#include "support/zoo.h"
#include "trace/oracle/oracle.h"

namespace whittle {
namespace {

const char* const kScene =
    "difference() {\n"
    "  cube(size = [10, 10, 10], center = true);\n"
    "  sphere($fn = 0, $fa = 12, $fs = 2, r = 6);\n"
    "}\n"
    "cylinder($fn = 0, $fa = 12, $fs = 2, h = 8, r1 = 2, r2 = 1, center = true);\n";

/// The sum of the reports of a tracer over the standard views of kScene.
AgreementReport check(const Model& model, Tracer& subject) {
  const auto oracle = make_oracle_tracer(model);
  AgreementReport sum;
  for (const Camera& camera : cameras_for(model, 32, 24)) {
    sum += check_agreement(model, subject, *oracle, camera);
  }
  return sum;
}

/// kScene's oracle with changed hits or cameras.
AgreementReport check_changed(const AdaptedTracer::ChangeCamera& camera,
                              const AdaptedTracer::ChangeHit& hit) {
  const Model model = model_of(kScene);
  const auto inner = make_oracle_tracer(model);
  AdaptedTracer subject(*inner, camera, hit);
  return check(model, subject);
}

/// An oracle of other text, looked at as if it were kScene's.
AgreementReport check_other(const std::string& text) {
  const Model model = model_of(kScene), other = model_of(text);
  const auto subject = make_oracle_tracer(other);
  return check(model, *subject);
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  return text.replace(text.find(what), what.size(), with);
}

TEST(Agreement, OracleAgreesWithItselfOverTheZoo) {
  for (const ZooScene& scene : zoo()) {
    SCOPED_TRACE(scene.name);
    const Model model = model_of(scene.text, scene.name);
    const auto subject = make_oracle_tracer(model);
    const AgreementReport report = check(model, *subject);
    EXPECT_EQ(report.pixels, 3 * 32 * 24);
    EXPECT_EQ(report.unexplained, 0) << report.first_difference;
    EXPECT_EQ(report.ambiguous_unmatched, 0) << report.first_difference;
    // A share that grows would let faults hide.
    EXPECT_LE(report.ambiguous, report.pixels / 100);
  }
}

TEST(Agreement, RandomTreesAreSeenAndAreMostlyCertain) {
  int pixels = 0, hits = 0, ambiguous = 0;
  for (const bool coincident : {false, true})
    for (uint64_t seed = 0; seed < 40; ++seed) {
      const Model model = model_of(random_tree(seed, {.coincident = coincident}));
      const auto subject = make_oracle_tracer(model);
      const AgreementReport report = check(model, *subject);
      pixels += report.pixels;
      hits += report.hits;
      ambiguous += report.ambiguous;
    }
  EXPECT_GT(hits, pixels / 10) << "most random trees should not be empty";
  EXPECT_LE(ambiguous, pixels / 200);
}

TEST(RandomTree, IsReadWithoutComplaint) {
  for (const bool coincident : {false, true})
    for (uint64_t seed = 0; seed < 100; ++seed) {
      const std::string text = random_tree(seed, {.coincident = coincident, .halfspaces = true});
      const Result<Read> read = read_csg(text, "random.csg");
      ASSERT_TRUE(read) << read.error().message;
      EXPECT_TRUE(read->warnings.empty()) << read->warnings[0] << '\n' << text;
      EXPECT_FALSE(read->unsupported);
    }
}

TEST(RandomTree, IsTheSameFromTheSameSeed) {
  EXPECT_EQ(random_tree(5), random_tree(5));
  EXPECT_NE(random_tree(5), random_tree(6));
}

TEST(Agreement, DroppedSolidIsCaught) {
  EXPECT_GT(check_other(replaced(kScene, "r = 6", "r = 0")).unexplained, 100);
}

TEST(Agreement, SwappedOperatorIsCaught) {
  EXPECT_GT(check_other(replaced(kScene, "difference", "union")).unexplained, 100);
}

TEST(Agreement, SlightlyWrongSizeIsCaught) {
  EXPECT_GT(check_other(replaced(kScene, "r = 6", "r = 6.01")).unexplained, 100);
}

TEST(Agreement, HalfAPixelIsCaught) {
  const AgreementReport report = check_changed(
      [](Camera camera) {
        camera.forward = normalize(camera.forward + camera.right * (camera.half_height / 48));
        if (camera.orthographic) camera.eye += camera.right * (camera.half_height / 24);
        return camera;
      },
      {});
  EXPECT_GT(report.unexplained, 100);
}

TEST(Agreement, WrongDistanceIsCaught) {
  const AgreementReport report = check_changed({}, [](Hit hit) {
    hit.distance *= 1.0005f;
    return hit;
  });
  EXPECT_GT(report.unexplained, report.hits / 2);
}

TEST(Agreement, WrongNormalIsCaught) {
  const auto turned = check_changed({}, [](Hit hit) {
    hit.normal = -hit.normal;
    return hit;
  });
  EXPECT_GE(turned.unexplained + turned.ambiguous, turned.hits);
  const auto tilted = check_changed({}, [](Hit hit) {
    hit.normal = normalize(hit.normal + Vec3f{0.005f, 0, 0.005f});
    return hit;
  });
  EXPECT_GT(tilted.unexplained, tilted.hits / 4);
  const auto long_normal = check_changed({}, [](Hit hit) {
    hit.normal *= 2;
    return hit;
  });
  EXPECT_GE(long_normal.unexplained + long_normal.ambiguous, long_normal.hits);
}

TEST(Agreement, WrongOwnerIsCaughtAndDescribed) {
  const AgreementReport report = check_changed({}, [](Hit hit) {
    hit.id += hit.id == 2;
    return hit;
  });
  EXPECT_GT(report.unexplained, 100);
  EXPECT_NE(report.first_difference.find("adapted sees id 3"), std::string::npos)
      << report.first_difference;
  EXPECT_NE(report.first_difference.find("oracle sees id 2"), std::string::npos);
}

TEST(Agreement, RoundingIsForgiven) {
  const AgreementReport report = check_changed({}, [](Hit hit) {
    hit.distance *= 1.000001f;
    hit.normal = normalize(hit.normal + Vec3f{1e-4f, 0, 0});
    return hit;
  });
  EXPECT_EQ(report.unexplained, 0) << report.first_difference;
}

TEST(Agreement, AmbiguousPixelsAreThoseOnEdges) {
  const Model model = model_of("cube(size = [2, 2, 2], center = true);");
  const auto oracle = make_oracle_tracer(model);
  // Straight down, so that the edge x = 1 lies under the centres of column 12.
  Camera camera;
  camera.eye = {0, 0, 9};
  camera.right = {1, 0, 0};
  camera.up = {0, 1, 0};
  camera.forward = {0, 0, -1};
  camera.orthographic = true;
  camera.width = 17;
  camera.height = 1;
  camera.half_height = 0.125;
  const Frame frame = oracle->render(camera);
  const std::vector<uint8_t> ambiguous = ambiguous_pixels(*oracle, camera, frame);
  for (int x = 0; x < camera.width; ++x) EXPECT_EQ(ambiguous[size_t(x)], x == 4 || x == 12) << x;
}

TEST(Agreement, ARayThatTouchesMayHitOrMiss) {
  const Model model = model_of("sphere(r = 1);");
  const auto oracle = make_oracle_tracer(model);
  const Camera camera = camera_along({1, 0, 9}, {0, 0, -1});
  ASSERT_FALSE(oracle->render(camera).at(0, 0).hit());
  const auto unmatched = [&](const Vec3f& normal) {
    const auto inwards = [](Camera moved) {
      moved.eye.x -= 0.01;
      return moved;
    };
    AdaptedTracer touching(*oracle, inwards, [&](const Hit&) { return Hit{9, 1, normal}; });
    const AgreementReport report = check_agreement(model, touching, *oracle, camera);
    EXPECT_EQ(report.ambiguous, 1);
    return report.ambiguous_unmatched;
  };
  EXPECT_EQ(unmatched({1, 0, 0}), 0);
  EXPECT_EQ(unmatched({0, 1, 0}), 1) << "another place of the sphere";
  EXPECT_EQ(unmatched({0.98f, 0, 0.199f}), 1) << "no ray that touches";
}

TEST(Agreement, ACornerMayShowAnyOfItsFacets) {
  const Model model = model_of(
      "polyhedron(points = [[1,0,0],[-1,0,0],[0,2,0],[0,-2,0],[0,0,1],[0,0,-1]], faces = "
      "[[0,4,2],[2,4,1],[1,4,3],[3,4,0],[2,5,0],[1,5,2],[3,5,1],[0,5,3]]);");
  const auto oracle = make_oracle_tracer(model);
  const Camera camera = camera_along({1, 0, 9}, {0, 0, -1});
  const auto unmatched = [&](float distance) {
    const auto inwards = [](Camera moved) {
      moved.eye.x -= 0.01;
      return moved;
    };
    AdaptedTracer corner(*oracle, inwards, [&](const Hit&) {
      return Hit{distance, 1, {2 / 3.0f, 1 / 3.0f, -2 / 3.0f}};
    });
    const AgreementReport report = check_agreement(model, corner, *oracle, camera);
    EXPECT_EQ(report.ambiguous, 1);
    return report.ambiguous_unmatched;
  };
  EXPECT_EQ(unmatched(9), 0);
  EXPECT_EQ(unmatched(8.99f), 1) << "not at the corner";
}

TEST(Agreement, AnEyeFarFromTheOriginKnowsNoMoreThanItsOwnDigits) {
  const Model model = model_of("translate([999990, -5, -5]) cube(10);");
  const auto oracle = make_oracle_tracer(model);
  const Camera camera = camera_along({1e6 + 1e-6, 0, 0}, {-1, 0.1, 0});
  const auto differs = [&](float by) {
    AdaptedTracer subject(*oracle, {}, [&](Hit hit) {
      hit.distance += by;
      return hit;
    });
    const AgreementReport report = check_agreement(model, subject, *oracle, camera);
    EXPECT_EQ(report.hits, 1);
    return report.unexplained + report.ambiguous_unmatched;
  };
  EXPECT_EQ(differs(5e-10f), 0);
  EXPECT_EQ(differs(1e-8f), 1);
}

TEST(Agreement, AFilmThatHidesBetweenTheLooksMayBeSeenFromWithinRounding) {
  const Model model = model_of("translate([-5, -5, 0]) cube([10, 10, 1e-5]);");
  const auto oracle = make_oracle_tracer(model);
  Camera camera = camera_along({20, 0, 0}, {-1, 0, 0});
  camera.orthographic = true, camera.half_height = 1;
  const auto report = [&](double below) {
    camera.eye.z = -below;
    EXPECT_FALSE(oracle->render(camera).at(0, 0).hit());
    const auto upwards = [&](Camera moved) {
      moved.eye.z += 1.5 * below;
      return moved;
    };
    AdaptedTracer subject(*oracle, upwards, {});
    return check_agreement(model, subject, *oracle, camera);
  };
  const AgreementReport within = report(1e-14), beyond = report(1e-12);
  EXPECT_EQ(within.ambiguous, 1);
  EXPECT_EQ(within.unexplained + within.ambiguous_unmatched, 0) << within.first_difference;
  EXPECT_EQ(beyond.ambiguous, 0);
  EXPECT_EQ(beyond.unexplained, 1);
}

TEST(Agreement, DifferencesAreFoundWithoutLookingEverywhere) {
  const Model model = model_of(kScene);
  const auto oracle = make_oracle_tracer(model);
  for (const float stretch : {1.0f, 1.0005f}) {
    AdaptedTracer subject(*oracle, {}, [&](Hit hit) {
      hit.distance *= stretch;
      return hit;
    });
    for (const Camera& camera : cameras_for(model, 32, 24)) {
      const AgreementReport all = check_agreement(model, subject, *oracle, camera);
      const AgreementReport found = find_differences(model, subject, *oracle, camera);
      EXPECT_EQ(found.pixels, all.pixels);
      EXPECT_EQ(found.hits, all.hits);
      EXPECT_EQ(found.unexplained, all.unexplained);
      EXPECT_EQ(found.ambiguous_unmatched, all.ambiguous_unmatched);
      EXPECT_EQ(found.first_difference, all.first_difference);
      EXPECT_EQ(found.unexplained > 0, stretch != 1);
    }
  }
}

}  // namespace
}  // namespace whittle
