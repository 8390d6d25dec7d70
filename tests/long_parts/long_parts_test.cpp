// A small part beside a long one, or in a large empty space, takes no more work than by itself.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <ostream>
#include <string>

#include "host/read_file.h"
#include "support/agreement.h"
#include "support/read_text.h"
#include "trace/oracle/oracle.h"
#include "whittle/renderer.h"

namespace whittle {
namespace {

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

std::string moved(double x, double y, double z, const std::string& what) {
  return "translate([" + number(x) + "," + number(y) + "," + number(z) + "]) " + what;
}

std::string block(double x, double y, double z) {
  return "cube([" + number(x) + "," + number(y) + "," + number(z) + "]);\n";
}

/// 64 holes of twelve sides, to be subtracted from a plate 48 wide and 5 thick.
std::string holes() {
  std::string text;
  for (int x = 3; x < 48; x += 6)
    for (int y = 3; y < 48; y += 6) text += moved(x, y, -1, "cylinder(h=9,r=2,$fn=12);\n");
  return text;
}

std::string plate() {
  return "difference(){ cube([48,48,5]);\n" + holes() + "}\n";
}

struct Case {
  const char* name;
  /// The plate, and what is `length` long or so far away.
  std::function<std::string(double length)> text;
};
void PrintTo(const Case& one, std::ostream* out) {
  *out << one.name;
}

const Case kCases[] = {
    {"Bar", [](double l) { return moved(-20, 0, 0, block(6, 6, l)) + plate(); }},
    {"BarBothWays",
     [](double l) { return moved(0, -20, 0, moved(-l / 2, 0, 0, block(l, 6, 6))) + plate(); }},
    {"DiagonalBar",
     [](double l) {
       return moved(-20, 0, 0, "rotate([0,-35.264,135]) " + block(l, 6, 6)) + plate();
     }},
    {"BarInThePlate", [](double l) { return moved(0, 21, 1, block(l, 1, 3)) + plate(); }},
    {"BarInTheUnionThatIsDrilled",
     [](double l) {
       return "difference(){ union(){ cube([48,48,5]);" + moved(-20, 0, 0, block(6, 6, l)) + "}\n" +
              holes() + "}";
     }},
    {"FacettedBar",
     [](double l) {
       return moved(-20, 0, 0, "cylinder(r=3,$fn=64,h=" + number(l) + ");") + plate();
     }},
    {"Sheet", [](double l) { return moved(-l / 2, -l / 2, -30, block(l, l, 1)) + plate(); }},
    {"FarBall", [](double l) { return moved(l, l, l, "sphere(3);") + plate(); }},
    {"FarPlate", [](double l) { return moved(0, 0, -50 - l, plate()) + plate(); }},
    {"ManyBars",
     [](double l) {
       std::string text;
       for (int i = 0; i < 12; ++i) text += moved(-20 - 10 * i, 0, 0, block(6, 6, l));
       return text + plate();
     }},
    {"RodOfManyParts",
     [](double l) {
       std::string text;
       for (int i = 0; i < 300; ++i)
         text +=
             moved(-20, 0, l / 300 * i, "cylinder(r1=3,r2=4,$fn=24,h=" + number(l / 300) + ");\n");
       return text + plate();
     }},
    {"PlainPlate", [](double l) { return moved(-20, 0, 0, block(6, 6, l)) + block(48, 48, 5); }},
};

ViewOptions view_of_the_plate(int width, int height) {
  ViewOptions view;
  view.width = width, view.height = height;
  view.target = Vec3{24, 24, 0};
  view.rotation_degrees = Vec3{55, 0, 25};
  view.distance = 144;
  return view;
}

/// What a picture took, for each ray where nothing else is said.
struct Work {
  size_t largest_leaf = 0;  ///< half-spaces
  double cells = 0, leaves = 0, literals = 0;
  double classified = 0;  ///< in all: operands, when cells were made
};

Work work_of(Renderer& renderer, const Camera& camera) {
  EXPECT_TRUE(renderer.prepare(camera));
  EXPECT_TRUE(renderer.trace(camera));
  const TraceStats trace = renderer.cpu_tracer()->stats();
  const SubdivideStats cells = statistics_of(*renderer.cells());
  const auto rays = double(trace.rays);
  return {cells.leaves_by_size.size() - 1, double(trace.cells) / rays, double(trace.leaves) / rays,
          double(trace.literals) / rays, double(cells.classified)};
}

RendererSettings on_the_cpu() {
  RendererSettings settings;
  settings.backend = Backend::kCpu;
  return settings;
}

Work work_of(const std::string& text, const ViewOptions& view) {
  const Model model = model_of(text);
  Renderer renderer = *Renderer::make(model, on_the_cpu());
  return work_of(renderer, renderer.camera(view));
}

/// Beyond the six of a truth table are only leaves that hardly any ray meets.
constexpr size_t kLongestLeaf = 12;

class LongParts : public testing::TestWithParam<Case> {};

TEST_P(LongParts, CostNoMoreThanShortOnes) {
  const ViewOptions view = view_of_the_plate(200, 150);
  // Long enough to be seen to the picture's side, so that the same rays meet it.
  const Work without = work_of(GetParam().text(120), view);
  EXPECT_LE(without.largest_leaf, kLongestLeaf);
  for (double ratio = 100; ratio < 2e10; ratio *= 10) {
    SCOPED_TRACE(ratio);
    const Work with = work_of(GetParam().text(6 * ratio), view);
    EXPECT_LE(with.largest_leaf, kLongestLeaf);
    // Nodes are looked at for many rays together, and a few more lead to what is far away.
    EXPECT_LE(with.cells, 2 * without.cells + 30);
    EXPECT_LE(with.leaves, 2 * without.leaves);
    EXPECT_LE(with.literals, 2 * without.literals);
    EXPECT_LE(with.classified, 2 * without.classified + 1000);
  }
}

TEST_P(LongParts, AreSeenAsByTheOracle) {
  for (const double ratio : {1.0, 1e2, 1e4, 1e6, 1e8, 1e10}) {
    SCOPED_TRACE(ratio);
    const Model model = model_of(GetParam().text(6 * ratio));
    Renderer renderer = *Renderer::make(model, on_the_cpu());
    const Camera camera = renderer.camera(view_of_the_plate(40, 30));
    ASSERT_TRUE(renderer.prepare(camera));
    const auto oracle = make_oracle_tracer(model);
    const AgreementReport report = check_agreement(model, renderer.tracer(), *oracle, camera);
    EXPECT_EQ(report.unexplained, 0) << report.first_difference;
    EXPECT_GT(report.hits, 400);
    EXPECT_LT(report.ambiguous, 40);
  }
}

INSTANTIATE_TEST_SUITE_P(All, LongParts, testing::ValuesIn(kCases),
                         [](const testing::TestParamInfo<Case>& one) { return one.param.name; });

TEST(LongBarBesidePlate, HasNoLongLeaves) {
  const Model model =
      read_file(std::string(WHITTLE_LONG_PARTS) + "/long_bar_beside_plate.csg", {})->model;
  Renderer renderer = *Renderer::make(model, on_the_cpu());
  const Work work = work_of(renderer, renderer.camera(view_of_the_plate(200, 150)));
  EXPECT_LE(work.largest_leaf, kLongestLeaf);
  EXPECT_LT(work.literals, 6);
}

/// A camera that comes nearer, by and by, and one that looks from all sides.
TEST(Renderer, MakesFinerCellsForACameraThatComesNearerAndKeepsThem) {
  const Model model = model_of(kCases[0].text(6e4));
  Renderer renderer = *Renderer::make(model, on_the_cpu());
  ViewOptions view = view_of_the_plate(200, 150);
  view.distance = 2e5;
  ASSERT_TRUE(renderer.prepare(renderer.camera(view)));
  size_t made = 0;
  std::shared_ptr<RefinerPool> cells = renderer.cells()->refiner_pool;
  const auto look = [&] {
    ASSERT_TRUE(renderer.trace(renderer.camera(view)));
    made += renderer.cells()->refiner_pool != cells;
    cells = renderer.cells()->refiner_pool;
  };
  for (; *view.distance > 100; *view.distance *= 0.9) look();
  EXPECT_GE(made, 2u);
  EXPECT_LE(made, 8u) << "not for every step";
  made = 0;
  for (int turn = 0; turn < 360; turn += 10) {
    view.rotation_degrees->z = turn;
    look();
  }
  for (; *view.distance < 2e5; *view.distance *= 1.5) look();
  EXPECT_LE(made, 1u) << "finer cells serve all others";
}

}  // namespace
}  // namespace whittle
