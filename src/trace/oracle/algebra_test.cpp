// Laws that hold for solids whatever they are, on random trees.
#include <gtest/gtest.h>

#include "base/degrees.h"
#include "support/adapted_tracer.h"
#include "support/agreement.h"
#include "support/random_tree.h"
#include "support/read_text.h"
#include "trace/oracle/oracle.h"

namespace whittle {
namespace {

std::string node(const char* name, const std::string& children) {
  return std::string(name) + "() {\n" + children + "}\n";
}

/// Two random solids as text, each one statement.
struct Pair {
  std::string a, b;
  uint32_t a_count = 0, b_count = 0;  ///< primitive statements in each
};

Pair random_pair(uint64_t seed, bool coincident) {
  const RandomTreeOptions options{.primitives = 6, .coincident = coincident};
  Pair pair{.a = node("union", random_tree(2 * seed, options)),
            .b = node("union", random_tree(2 * seed + 1, options))};
  pair.a_count = model_of(pair.a).statement_count;
  pair.b_count = model_of(pair.b).statement_count;
  return pair;
}

/// Expects that both texts show the same solid. `relabel` turns ids of `right` into those of
/// `left`.
void expect_same(const std::string& left, const std::string& right,
                 const std::function<uint32_t(uint32_t)>& relabel) {
  const Model left_model = model_of(left, "left"), right_model = model_of(right, "right");
  const auto left_oracle = make_oracle_tracer(left_model, 1);
  const auto right_oracle = make_oracle_tracer(right_model, 1);
  AdaptedTracer relabelled(*right_oracle, {}, [&](Hit hit) {
    hit.id = relabel(hit.id);
    return hit;
  });
  for (const Camera& camera : cameras_for(left_model, 24, 18)) {
    const AgreementReport report = check_agreement(left_model, relabelled, *left_oracle, camera);
    EXPECT_EQ(report.unexplained + report.ambiguous_unmatched, 0)
        << report.first_difference << left << right;
  }
}

class Algebra : public testing::TestWithParam<bool> {
 protected:
  /// Runs `law` on many pairs of solids, off the grid and on it.
  template <class Law>
  void for_pairs(const Law& law) {
    for (uint64_t seed = 1; seed <= 25; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      law(random_pair(seed, GetParam()));
      if (HasFailure()) return;
    }
  }
};

INSTANTIATE_TEST_SUITE_P(Trees, Algebra, testing::Bool(), [](const auto& instance) {
  return std::string(instance.param ? "coincident" : "general");
});

TEST_P(Algebra, UnionWithItselfIsItself) {
  for_pairs([](const Pair& p) {
    expect_same(p.a, node("union", p.a + p.a), [](uint32_t id) { return id; });
  });
}

TEST_P(Algebra, IntersectionWithItselfIsItself) {
  for_pairs([](const Pair& p) {
    expect_same(p.a, node("intersection", p.a + p.a), [](uint32_t id) { return id; });
  });
}

TEST_P(Algebra, MinusItselfIsNothing) {
  for_pairs([](const Pair& p) {
    const Model model = model_of(node("difference", p.a + p.a));
    const auto oracle = make_oracle_tracer(model, 1);
    for (const Camera& camera : cameras_for(model_of(p.a), 24, 18))
      for (const Hit& hit : oracle->render(camera).hits) ASSERT_FALSE(hit.hit());
  });
}

TEST_P(Algebra, MinusTheDifferenceIsTheIntersection) {
  for_pairs([](const Pair& p) {
    const uint32_t a = p.a_count;
    expect_same(node("intersection", p.a + p.b),
                node("difference", p.a + node("difference", p.a + p.b)),
                [a](uint32_t id) { return id > a ? id - a : id; });
  });
}

TEST_P(Algebra, DeMorgan) {
  // In a box W that holds both: W - (A + B) = (W - A) * (W - B).
  const std::string w = "cube(size = [120, 120, 120], center = true);\n";
  for_pairs([&](const Pair& p) {
    const uint32_t a = p.a_count;
    expect_same(node("difference", w + node("union", p.a + p.b)),
                node("intersection", node("difference", w + p.a) + node("difference", w + p.b)),
                [a](uint32_t id) { return id == a + 2  ? 1
                                          : id > a + 2 ? id - 1
                                                       : id; });
  });
}

TEST_P(Algebra, DifferenceOfManyIsDifferenceOfTheirUnion) {
  for_pairs([](const Pair& p) {
    const std::string box = "cube(size = [9, 9, 9], center = true);\n";
    expect_same(node("difference", box + p.a + p.b),
                node("difference", box + node("union", p.a + p.b)), [](uint32_t id) { return id; });
  });
}

/// The model moved as a whole.
Model moved(Model model, const Affine& map) {
  for (Node& n : model.nodes) ++n.end;
  model.transforms.push_back(map);
  model.nodes.insert(model.nodes.begin() + 1, Node{.kind = NodeKind::kTransform,
                                                   .end = uint32_t(model.nodes.size()) + 1,
                                                   .payload = uint32_t(model.transforms.size()) - 1,
                                                   .where = {}});
  return model;
}

TEST_P(Algebra, MovingModelAndCameraTogetherChangesNothing) {
  Affine turn{.row = {{cos_degrees(35), -sin_degrees(35), 0},
                      {sin_degrees(35), cos_degrees(35), 0},
                      {0, 0, 1}},
              .translation = {3, -2, 1}};
  const Affine tilt{.row = {{1, 0, 0},
                            {0, cos_degrees(70), -sin_degrees(70)},
                            {0, sin_degrees(70), cos_degrees(70)}},
                    .translation = {}};
  const Affine map = tilt * turn;
  for_pairs([&](const Pair& p) {
    const Model still = model_of(node("difference", p.a + p.b)), gone = moved(still, map);
    const auto still_oracle = make_oracle_tracer(still, 1),
               gone_oracle = make_oracle_tracer(gone, 1);
    AdaptedTracer back(
        *gone_oracle,
        [&](Camera camera) {
          camera.eye = map.point(camera.eye);
          for (Vec3* axis : {&camera.right, &camera.up, &camera.forward}) *axis = map.vector(*axis);
          return camera;
        },
        [&](Hit hit) {
          const Vec3 n = map.transposed_vector(
              {double(hit.normal.x), double(hit.normal.y), double(hit.normal.z)});
          hit.normal = {float(n.x), float(n.y), float(n.z)};
          return hit;
        });
    for (const Camera& camera : cameras_for(still, 24, 18)) {
      const AgreementReport report = check_agreement(still, back, *still_oracle, camera);
      EXPECT_EQ(report.unexplained, 0) << report.first_difference;
    }
  });
}

TEST_P(Algebra, WhatIsEnteredIsLeft) {
  // Every solid is bounded: from any hit on, the surfaces met are entered and left in turn, and
  // the last one is left.
  for_pairs([](const Pair& p) {
    const Model model = model_of(node("union", p.a + p.b));
    const auto oracle = make_oracle_tracer(model, 1);
    for (const Camera& camera : cameras_for(model, 12, 9)) {
      const Frame frame = oracle->render(camera);
      const std::vector<uint8_t> ambiguous = ambiguous_pixels(*oracle, camera, frame);
      for (int i = 0; i < 12 * 9; ++i) {
        const Hit& hit = frame.hits[size_t(i)];
        if (!hit.hit() || ambiguous[size_t(i)]) continue;
        const Ray ray = camera.ray(i % 12 + 0.5, i / 12 + 0.5);
        const auto leaves = [&](const Hit& h) {
          return dot({double(h.normal.x), double(h.normal.y), double(h.normal.z)}, ray.direction) >
                 0;
        };
        // On from beyond the hit by more than the rounding of its distance.
        const Vec3 beyond = ray.origin + ray.direction * (double(hit.distance) + 1e-5);
        const Hit next = trace_one(*oracle, beyond, ray.direction);
        if (!leaves(hit)) {
          ASSERT_TRUE(next.hit());
        }
        if (next.hit()) {
          ASSERT_NE(leaves(next), leaves(hit));
        }
      }
    }
  });
}

}  // namespace
}  // namespace whittle
