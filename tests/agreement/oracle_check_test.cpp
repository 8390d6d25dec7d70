// What `whittle bench` looks at before it tells a time: a wrong picture must show.
#include "apps/whittle/oracle_check.h"

#include <gtest/gtest.h>

#include "support/adapted_tracer.h"
#include "support/read_text.h"
#include "trace/oracle/oracle.h"

namespace whittle {
namespace {

Camera seen_from_above() {
  Camera camera;
  camera.width = camera.height = 96;
  camera.half_height = 0.15;
  camera.eye = {0, 0, 50};
  camera.forward = {0, 0, -1};
  camera.right = {1, 0, 0};
  camera.up = {0, 1, 0};
  return camera;
}

constexpr const char* kSolid =
    "difference(){ sphere(6); translate([0,0,5]) cube(4, center=true); }";

OracleCheck check_changed(const AdaptedTracer::ChangeHit& change) {
  const Model model = model_of(kSolid);
  const auto oracle = make_oracle_tracer(model), inner = make_oracle_tracer(model);
  AdaptedTracer subject(*inner, {}, change);
  return check_against_oracle(subject, *oracle, seen_from_above());
}

TEST(OracleCheck, FindsWhatIsWrongAndNothingElse) {
  const OracleCheck right = check_changed({});
  EXPECT_EQ(right.certain, size_t(kCheckedSide * kCheckedSide));
  EXPECT_EQ(right.wrong, 0u);
  EXPECT_TRUE(right.first.empty());

  const OracleCheck missed = check_changed([](Hit) { return Hit{}; });
  EXPECT_GT(missed.wrong, 200u);
  EXPECT_NE(missed.first.find("it shows nothing, where the oracle sees id "), std::string::npos);

  const auto counts = [](const AdaptedTracer::ChangeHit& change) {
    return check_changed(change).wrong;
  };
  EXPECT_GT(counts([](Hit hit) { return hit.distance *= 1.001f, hit; }), 200u);
  EXPECT_GT(counts([](Hit hit) { return ++hit.id, hit; }), 200u);
  EXPECT_GT(counts([](Hit hit) { return hit.normal.z = -hit.normal.z, hit; }), 200u);
}

TEST(OracleCheck, EdgesThatRoundingDecidesDoNotCount) {
  // Two of its sides lie where a column of places looks, an eighth of a unit a pixel.
  const Model model = model_of("cube([2.25, 3, 3], center=true);");
  Camera camera = seen_from_above();
  camera.orthographic = true;
  camera.half_height = 6;
  const auto oracle = make_oracle_tracer(model), inner = make_oracle_tracer(model);
  AdaptedTracer subject(*inner, [](Camera c) { return c.eye.x += 1e-7, c; }, {});
  const OracleCheck check = check_against_oracle(subject, *oracle, camera);
  EXPECT_GT(check.ambiguous, 5u);
  EXPECT_EQ(check.wrong, 0u);
}

}  // namespace
}  // namespace whittle
