// A section is an intersection with a half of space, and no more: what every backend sees of a
// model that is cut open is what the oracle sees of the intersection written out.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "model/explode.h"
#include "model/section.h"
#include "support/agreement.h"
#include "support/read_text.h"
#include "support/zoo.h"
#include "trace/oracle/oracle.h"
#include "whittle/renderer.h"
#include "whittle/section_text.h"

namespace whittle {
namespace {

struct CutCase {
  const char* sections;  ///< as on a command line, with ';' between them
  const char* kept;      ///< what is left, as .csg of the solid S()
};

/// `kept` with the model's text in place of S().
std::string written_out(std::string kept, const std::string& text) {
  for (size_t at; (at = kept.find("S()")) != std::string::npos;)
    kept.replace(at, 3, "union() { " + text + " }");
  return kept;
}

std::vector<Section> sections_of(std::string_view text) {
  std::vector<Section> sections;
  while (true) {
    const size_t end = text.find(';');
    sections.push_back(*parse_section(text.substr(0, end)));
    if (end == std::string_view::npos) return sections;
    text.remove_prefix(end + 1);
  }
}

std::vector<Backend> all_backends() {
  std::vector<Backend> all = {Backend::kCpu, Backend::kOracle};
  if (WHITTLE_HAS_VULKAN) all.push_back(Backend::kVulkanRaster);
  return all;
}

/// Compares ids by what they say: the same statement, or that both are where it is cut.
void expect_same(const Model& cut, const Model& expected, uint32_t statements) {
  const auto oracle = make_oracle_tracer(expected);
  for (const Backend backend : all_backends()) {
    Result<Renderer> renderer = Renderer::make(cut, {.backend = backend, .subdivide = {}});
    ASSERT_TRUE(renderer);
    for (const Camera& camera : cameras_for(expected, 48, 36)) {
      ASSERT_TRUE(renderer->prepare(camera));
      const Result<Frame> seen = renderer->trace(camera);
      ASSERT_TRUE(seen);
      const Frame wanted = oracle->render(camera);
      const auto accepts = [&](const Ray&, const Hit& hit, uint32_t id) {
        return hit.id <= statements ? cut.cut->statement_of(id) == hit.id || cut.cut->is_cap(id)
                                    : cut.cut->is_cap(id);
      };
      const AgreementReport report =
          check_pictures(expected, *seen, *oracle, wanted, camera, accepts);
      EXPECT_EQ(report.unexplained, 0) << int(backend) << ": " << report.first_difference;
    }
  }
}

constexpr const char* kParts =
    "difference() { cube(20, center = true); sphere(8); } "
    "translate([6, 0, 0]) color(\"red\") rotate([10, 20, 30]) cylinder(h = 30, r = 4, center = "
    "true);"
    " translate([-9, 3, 4]) color(\"blue\") sphere(6, $fn = 12);";

TEST(Sections, AreTheIntersectionWrittenOut) {
  const CutCase cases[] = {
      {"x=2", "intersection() { S() halfspace(n = [1, 0, 0], d = 2); }"},
      {"z<3.5", "intersection() { S() halfspace(n = [0, 0, -1], d = -3.5); }"},
      {"n=[1,1,0],d>3", "intersection() { S() halfspace(n = [1, 1, 0], d = 3); }"},
      // Each one cuts.
      {"x>0;y<0", "intersection() { S() translate([-100, 0, -100]) cube([100, 100, 200]); }"},
      // Both together take a quarter.
      {"x>0,y<0", "difference() { S() translate([0, -100, -100]) cube([100, 100, 200]); }"},
      {"x>1,y<2,z>-1", "difference() { S() translate([1, -98, -1]) cube([100, 100, 100]); }"},
      // What is nowhere takes nothing, and what is everywhere leaves nothing.
      {"x>1e100", "S()"},
      {"x>-1e100", "intersection() { S() translate([900, 0, 0]) cube(1); }"},
  };
  for (const CutCase& one : cases) {
    SCOPED_TRACE(one.sections);
    const Model cut = *cut_open(model_of(kParts), sections_of(one.sections));
    expect_same(cut, model_of(written_out(one.kept, kParts)), written_statements(cut));
  }
}

TEST(Sections, OfAllKindsOfModels) {
  for (const ZooScene& one : zoo()) {
    SCOPED_TRACE(one.name);
    const Model model = model_of(one.text, one.name);
    if (model.drawing) continue;
    const Bounds around = bounds(model);
    if (around.box.is_empty() || !around.bounded) continue;
    const Vec3 n = normalize(Vec3{0.3, -0.8, 0.52});
    const double d = dot(n, around.box.center());
    const Model cut = *cut_open(model, std::vector<Section>{{{{n, d}}}});
    // The same tree by hand.
    Model expected = model;
    expected.nodes.insert(expected.nodes.begin(), {.kind = NodeKind::kUnion, .where = {}});
    for (Node& node : expected.nodes) ++node.end;
    expected.nodes[1].kind = NodeKind::kUnion;
    expected.nodes.insert(expected.nodes.begin() + 1,
                          {.kind = NodeKind::kIntersection, .where = {}});
    for (Node& node : expected.nodes) ++node.end;
    const uint32_t size = uint32_t(expected.nodes.size());
    expected.nodes.push_back({.kind = NodeKind::kPrimitive,
                              .end = size + 1,
                              .payload = uint32_t(expected.primitives.size()),
                              .where = {}});
    expected.nodes[0].end = expected.nodes[1].end = size + 1;
    expected.primitives.push_back({Halfspace{n, d}, ++expected.statement_count});
    expect_same(cut, expected, written_statements(cut));
  }
}

TEST(Sections, LeaveChosenColoursWhole) {
  const Rgba red{1, 0, 0, 1};
  const struct {
    const char* text;
    const char* kept;
  } cases[] = {
      // A part of a union, under transforms; what is cut beside it.
      {"translate([0, 5, 0]) rotate([0, 0, 40]) { cube(9, center = true); "
       "color(\"red\") cylinder(h = 20, r = 3, center = true); }",
       "translate([0, 5, 0]) rotate([0, 0, 40]) color(\"red\") cylinder(h = 20, r = 3, center = "
       "true);"
       "intersection() { translate([0, 5, 0]) rotate([0, 0, 40]) cube(9, center = true); "
       "halfspace(n = [1, 0, 0], d = 0); }"},
      // The outermost colour counts.
      {"color(\"blue\") color(\"red\") cube(9, center = true); translate([0, 6, 0]) color(\"red\") "
       "color(\"blue\") sphere(5);",
       "intersection() { cube(9, center = true); halfspace(n = [1, 0, 0], d = 0); } "
       "translate([0, 6, 0]) sphere(5);"},
      // Of a difference what is cut has the material, of an intersection the first.
      {"difference() { union() { cube(12, center = true); color(\"red\") sphere(8); } "
       "color(\"red\") cylinder(h = 40, r = 2, center = true); }"
       "translate([0, 20, 0]) intersection() { color(\"red\") sphere(6); cube(10, center = true); "
       "}",
       "difference() { union() { intersection() { cube(12, center = true); halfspace(n = [1, 0, "
       "0], "
       "d = 0); } sphere(8); } cylinder(h = 40, r = 2, center = true); }"
       "translate([0, 20, 0]) intersection() { sphere(6); cube(10, center = true); }"},
  };
  for (const auto& one : cases) {
    SCOPED_TRACE(one.text);
    const Model cut = *cut_open(model_of(one.text), sections_of("x=0"), std::vector<Rgba>{red});
    const auto accepts_any = [](const Ray&, const Hit&, uint32_t) { return true; };
    const Model expected = model_of(one.kept);
    const auto oracle = make_oracle_tracer(expected);
    for (const Backend backend : all_backends()) {
      Result<Renderer> renderer = Renderer::make(cut, {.backend = backend, .subdivide = {}});
      ASSERT_TRUE(renderer);
      for (const Camera& camera : cameras_for(expected, 48, 36)) {
        ASSERT_TRUE(renderer->prepare(camera));
        const Result<Frame> seen = renderer->trace(camera);
        ASSERT_TRUE(seen);
        const AgreementReport report =
            check_pictures(expected, *seen, *oracle, oracle->render(camera), camera, accepts_any);
        EXPECT_EQ(report.unexplained, 0) << int(backend) << ": " << report.first_difference;
      }
    }
  }
}

TEST(Explode, IsTheTransformsWrittenOut) {
  const struct {
    const char* text;
    double factor;
    const char* moved;
  } cases[] = {
      // Boxes from -1 to 1, 3 to 5 and 9 to 11: the middle is 5.
      {"cube(2, center = true); translate([4, 0, 0]) sphere(1); translate([10, 0, 0]) cube(2, "
       "center "
       "= true);",
       0.5,
       "translate([-2.5, 0, 0]) cube(2, center = true); translate([3.5, 0, 0]) sphere(1); "
       "translate([12.5, 0, 0]) cube(2, center = true);"},
      // Below unions of one, colours and transforms; what is empty is no part, nor is a background.
      {"union() { color(\"red\") rotate([0, 0, 90]) scale([2, 1, 1]) { cube(0); %cube(99); "
       "cube([1, 1, "
       "1]); translate([3, 0, 0]) difference() { cube([1, 1, 1]); sphere(0.4); } } }",
       1,
       "color(\"red\") rotate([0, 0, 90]) scale([2, 1, 1]) { translate([-1.5, 0, 0]) cube([1, 1, "
       "1]); "
       "translate([4.5, 0, 0]) difference() { cube([1, 1, 1]); sphere(0.4); } }"},
      {"cube(3); sphere(2);", 0, "cube(3); sphere(2);"},
  };
  for (const auto& one : cases) {
    SCOPED_TRACE(one.text);
    const Result<Model> moved = explode(model_of(one.text), one.factor);
    ASSERT_TRUE(moved);
    const Model expected = model_of(one.moved);
    const auto oracle = make_oracle_tracer(expected);
    const auto accepts_any = [](const Ray&, const Hit&, uint32_t) { return true; };
    for (const Backend backend : {Backend::kCpu, Backend::kOracle}) {
      Result<Renderer> renderer = Renderer::make(*moved, {.backend = backend, .subdivide = {}});
      ASSERT_TRUE(renderer);
      for (const Camera& camera : cameras_for(expected, 48, 36)) {
        ASSERT_TRUE(renderer->prepare(camera));
        const AgreementReport report = check_pictures(expected, *renderer->trace(camera), *oracle,
                                                      oracle->render(camera), camera, accepts_any);
        EXPECT_EQ(report.unexplained, 0) << int(backend) << ": " << report.first_difference;
      }
    }
  }
}

}  // namespace
}  // namespace whittle
