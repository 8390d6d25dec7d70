// Bodies of triangles: cells, which know the triangles near them, see what the oracle sees, which
// asks every triangle.
#include <gtest/gtest.h>

#include "agreement/cpu_subject.h"
#include "support/agreement.h"
#include "support/meshes.h"
#include "trace/oracle/oracle.h"

namespace whittle {
namespace {

struct MeshScene {
  const char* name;
  const char* text;  ///< cube(n) stands for the n-th mesh
  std::vector<TriangleMesh> meshes;
};

std::vector<MeshScene> scenes() {
  const Box box{{-1.7, -1.2, -0.9}, {1.3, 1.6, 2.1}};
  const TriangleMesh small = box_mesh({{-0.4, -0.5, -0.3}, {0.6, 0.5, 0.8}}, 1);
  return {
      {"box", "cube(1);", {box_mesh(box, 3)}},
      {"star", "cube(1);", {star_mesh(5, 1, 2.5, 1.3)}},
      {"torus", "cube(1);", {torus_mesh(3, 1.1, 17, 9)}},
      {"bumpy", "cube(1);", {bumpy_mesh(2, 0.2, 5, 1)}},
      {"overlapping", "cube(1);", {together({box_mesh(box, 2), torus_mesh(2, 0.7, 11, 7)})}},
      {"cavity",
       "difference() { cube(1); translate([1, 0, 0]) cube([3, 3.7, 4.1]); }",
       {together({box_mesh(box, 2), inside_out(small)})}},
      {"cutter", "difference() { sphere(2.6); cube(1); }", {star_mesh(7, 1, 2, 4)}},
      {"mesh minus mesh",
       "difference() { cube(1); rotate([20, 30, 40]) cube(2); }",
       {bumpy_mesh(2.5, 0.1, 6, 2), torus_mesh(2, 0.6, 13, 8)}},
      {"mesh and mesh",
       "intersection() { cube(1); translate([0.3, 0.2, -0.7]) cube(2); }",
       {bumpy_mesh(2.5, 0.3, 4, 3), star_mesh(6, 1.5, 3, 2)}},
      {"mirrored, sheared",
       "multmatrix([[-1, 0.3, 0, 1], [0, 1, 0.2, 0], [0.1, 0, 1.5, 0], [0, 0, 0, 1]]) "
       "difference() { cube(1); cylinder(h = 9, r = 0.8, center = true); }",
       {star_mesh(5, 1.2, 2.5, 1.3)}},
      {"flush",
       "difference() { cube(1); translate([-1.7, -1, -0.9]) cube([2, 1.1, 3]); "
       "translate([0.1, 0.5, 1.1]) cube([1.2, 3, 1]); }",
       {box_mesh(box, 3)}},
  };
}

class Meshes : public testing::TestWithParam<size_t> {};

TEST_P(Meshes, Agree) {
  const MeshScene scene = scenes()[GetParam()];
  SCOPED_TRACE(scene.name);
  const Model model = with_meshes(scene.text, scene.meshes);
  const auto oracle = make_oracle_tracer(model);
  for (const uint32_t k : {2u, 6u, kAutoLeafSize, 16u}) {
    SubdivideSettings settings;
    settings.leaf_size = k;
    CpuSubject cpu(model, settings);
    int hits = 0;
    for (const Camera& camera : cameras_for(model, 64, 48)) {
      const AgreementReport report = check_agreement(model, *cpu.tracer, *oracle, camera);
      EXPECT_EQ(report.unexplained, 0) << report.first_difference;
      EXPECT_EQ(report.ambiguous_unmatched, 0) << report.first_difference;
      hits += report.hits;
    }
    EXPECT_GT(hits, 500);
    EXPECT_EQ(cpu.tracer->stats().disagreements, 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Meshes, testing::Range<size_t>(0, 11));

}  // namespace
}  // namespace whittle
