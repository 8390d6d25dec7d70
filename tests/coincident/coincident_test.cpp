// Every scene of scenes.h is seen as its answer says: hit, owner, distance and normal, at every
// pixel but those through which an edge runs, and there as one side of the edge.
#include <gtest/gtest.h>

#include "coincident/answer.h"
#include "coincident/scenes.h"
#include "coincident/turned.h"
#include "support/read_text.h"
#include "trace/oracle/oracle.h"

namespace whittle {
namespace {

class Coincident : public testing::TestWithParam<CoincidentScene> {};

TEST_P(Coincident, Cpu) {
  const Model model = model_of(GetParam().text, GetParam().name);
  Answer answer(GetParam(), model, 512);
  if (GetParam().equal == kNothing)
    EXPECT_EQ(answer.least_share_of_hits(), 0);
  else
    EXPECT_GT(answer.least_share_of_hits(), 0.04) << "some view hardly looks at the scene";
  for (const uint32_t k : {2u, 6u}) {
    SCOPED_TRACE(k);
    const CpuSubject cpu(model, leaf_size(k));
    answer.expect_seen_by(*cpu.tracer);
    EXPECT_EQ(cpu.tracer->stats().disagreements, 0u);
  }
}

TEST_P(Coincident, Oracle) {
  const Model model = model_of(GetParam().text, GetParam().name);
  Answer(GetParam(), model, 96).expect_seen_by(*make_oracle_tracer(model));
}

/// The same scenes in another place, told in six digits.
class CoincidentTurned : public testing::TestWithParam<CoincidentScene> {};

TEST_P(CoincidentTurned, Cpu) {
  const Model model = model_of(GetParam().text, GetParam().name);
  Answer answer(GetParam(), model, 192);
  for (const bool mirrored : {false, true}) {
    SCOPED_TRACE(mirrored ? "mirrored" : "turned");
    const Affine turn = turn_of(model, mirrored);
    const CpuSubject cpu(turned(model, turn), leaf_size(6));
    answer.expect_seen_by(*cpu.tracer, turn);
  }
}

TEST_P(CoincidentTurned, Oracle) {
  const Model model = model_of(GetParam().text, GetParam().name);
  Answer answer(GetParam(), model, 96);
  for (const bool mirrored : {false, true}) {
    SCOPED_TRACE(mirrored ? "mirrored" : "turned");
    const Affine turn = turn_of(model, mirrored);
    const Model moved = turned(model, turn);
    answer.expect_seen_by(*make_oracle_tracer(moved), turn);
  }
}

std::vector<CoincidentScene> scenes() {
  std::vector<CoincidentScene> all;
  for (const auto& chapter : {flush_scenes, abutting_scenes, body_scenes, curved_scenes,
                              facet_scenes, algebra_scenes, tolerance_scenes, menger_scenes})
    for (CoincidentScene& scene : chapter()) all.push_back(std::move(scene));
  return all;
}

std::vector<CoincidentScene> scenes_that_turn() {
  std::vector<CoincidentScene> all = scenes();
  std::erase_if(all, [](const CoincidentScene& scene) { return !scene.turns; });
  return all;
}

TEST(CoincidentScenes, AreReadWithoutComplaint) {
  for (const CoincidentScene& scene : scenes())
    for (const std::string& text : {scene.text, scene.equal}) {
      const Result<Read> read = read_csg(text, scene.name);
      ASSERT_TRUE(read) << read.error().message;
      EXPECT_TRUE(read->warnings.empty()) << read->warnings[0] << '\n' << text;
      EXPECT_FALSE(read->unsupported);
    }
}

constexpr auto kName = [](const testing::TestParamInfo<CoincidentScene>& scene) {
  return scene.param.name;
};
INSTANTIATE_TEST_SUITE_P(Scenes, Coincident, testing::ValuesIn(scenes()), kName);
INSTANTIATE_TEST_SUITE_P(Scenes, CoincidentTurned, testing::ValuesIn(scenes_that_turn()), kName);

}  // namespace
}  // namespace whittle
