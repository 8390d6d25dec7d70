#include "lower/lower.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <string>

#include "lower/evaluate.h"
#include "lower/half_space_table.h"
#include "lower/primitive_faces.h"
#include "shape/shape.h"
#include "support/read_text.h"

namespace whittle {
namespace {

Scene lowered(const std::string& text) {
  return *lower(model_of(text));
}

bool inside(const Scene& scene, Vec3 world) {
  return contains(scene, scene.formula, world - scene.origin);
}

/// Boxes side by side, on and almost on one another, walls, balls and meshes, nested at random.
std::string crowded_text(std::mt19937_64& random, int primitives) {
  const auto pick = [&](int n) { return int(random() % uint64_t(n)); };
  // Whole numbers, and what differs from them by about the tolerance, or a 1500th of it.
  const auto number = [&] {
    const double off[] = {0, 0, 0, 2e-8, 1e-5, 3e-5, 6e-5};
    return fmt::format("{}", pick(9) + off[pick(7)] * (pick(3) - 1));
  };
  const auto place = [&] {
    return fmt::format("translate([{}, {}, {}]) ", number(), number(), number());
  };
  std::string text;
  int open = 0;
  for (int i = 0; i < primitives; ++i) {
    if (pick(8) == 0) {
      const char* const groups[] = {"union() {",  "difference() {",        "intersection() {",
                                    "%group() {", "color([1, 0, 0, 1]) {", "rotate([0, 0, 90]) {"};
      text += groups[pick(6)];
      ++open;
    }
    text += place();
    switch (pick(6)) {
      case 0:
        text += "sphere(r = 1, $fn = 0);";
        break;
      case 1:
        text += fmt::format("cylinder(h = {}, r1 = 1, r2 = {});", 1 + pick(3), pick(3));
        break;
      case 2:
        text += "sphere(r = 1, $fn = 8);";
        break;
      case 3:
        text += "linear_extrude(1) polygon([[0, 0], [2, 0], [2, 2], [1, 1], [0, 2]]);";
        break;
      case 4:
        text += "sphere(r = 0);";
        break;
      default:
        text += fmt::format("cube([{}, 1, 1]);", 1 + pick(2));
    }
    if (open > 0 && pick(6) == 0) text += '}', --open;
    text += '\n';
  }
  return text + std::string(size_t(open), '}');
}

template <class Row>
bool same_bytes(const Row& a, const Row& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](auto& x, auto& y) {
           return std::memcmp(&x, &y, sizeof x) == 0;
         });
}

void expect_same(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.half_spaces.size(), b.half_spaces.size());
  for (size_t i = 0; i < a.half_spaces.size(); ++i) {
    const HalfSpace &x = a.half_spaces[i], &y = b.half_spaces[i];
    ASSERT_TRUE(x.center == y.center && x.f.diag == y.f.diag && x.f.off == y.f.off &&
                x.f.b == y.f.b && x.f.c == y.f.c && x.kind == y.kind && x.tip == y.tip)
        << i;
  }
  EXPECT_EQ(a.tips, b.tips);
  EXPECT_TRUE(same_bytes(a.faces, b.faces));
  ASSERT_EQ(a.units.size(), b.units.size());
  for (size_t i = 0; i < a.units.size(); ++i) {
    const Unit &x = a.units[i], &y = b.units[i];
    ASSERT_TRUE(x.id == y.id && x.first_face == y.first_face && x.face_count == y.face_count &&
                x.outer == y.outer && x.inner_center == y.inner_center &&
                x.inner_radius == y.inner_radius && x.first_box == y.first_box &&
                x.box_frame == y.box_frame && x.boundary == y.boundary && x.inward == y.inward)
        << i;
  }
  EXPECT_TRUE(same_bytes(a.face_boxes, b.face_boxes));
  EXPECT_EQ(a.box_frames, b.box_frames);
  ASSERT_EQ(a.boundaries.size(), b.boundaries.size());
  for (size_t i = 0; i < a.boundaries.size(); ++i) {
    EXPECT_EQ(a.boundaries[i].slack(), b.boundaries[i].slack());
    EXPECT_TRUE(same_bytes(a.boundaries[i].triangles(), b.boundaries[i].triangles()));
  }
  EXPECT_EQ(a.formula, b.formula);
}

TEST(Lower, AnyNumberOfThreadsMakesTheSame) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 3; ++i) {
    const Model model = model_of(crowded_text(random, 6000));
    const Scene alone = *lower(model);
    // Far fewer half-spaces than faces: these scenes are crowded.
    EXPECT_LT(3 * alone.half_spaces.size(), 2 * alone.faces.size());
    for (const int threads : {2, 5}) {
      const Workers workers(threads);
      expect_same(*lower(model, &workers), alone);
    }
  }
}

TEST(Lower, SlackOfABoundaryIsThatOfWhatIsLookedAt) {
  // Of the million that the body is long four are looked at, and there its right side is the box's.
  const Scene scene = lowered(
      "intersection() { cube(4); linear_extrude(4) "
      "polygon([[4, 2], [2.5, 5], [2.5, 0], [7.5, 5], [2, 1e6]]); }");
  ASSERT_EQ(scene.boundaries.size(), 1u);
  EXPECT_EQ(scene.half_spaces.size(), 10u);
  EXPECT_LT(scene.boundaries[0].slack(), 2e-5);
}

TEST(Lower, FlushFacesShareAHalfSpace) {
  // The pocket's top lies in the cube's top.
  const Scene scene = lowered("difference(){cube(10); translate([2,2,5]) cube([6,6,5]);}");
  EXPECT_EQ(scene.half_spaces.size(), 11u);
  EXPECT_EQ(scene.faces.size(), 12u);
}

TEST(Lower, AbuttingFacesAreComplements) {
  const Scene scene = lowered("cube(10); translate([10,0,0]) cube(10);");
  // Four side planes are shared, and x = 10 is the end of one and the start of the other.
  EXPECT_EQ(scene.half_spaces.size(), 12u - 4u - 1u);
  int complements = 0;
  for (const Face& face : scene.faces) complements += face.literal & 1;
  EXPECT_EQ(complements, 1);
}

TEST(Lower, SixDigitTextIsNoObstacleToSharing) {
  // The same plane through two rotations by 30 degrees, as OpenSCAD prints them.
  const Scene scene = lowered(
      "multmatrix([[0.866025,-0.5,0,0],[0.5,0.866025,0,0],[0,0,1,0],[0,0,0,1]]) cube(10);"
      "multmatrix([[0.866025,-0.5,0,8.66025],[0.5,0.866025,0,5],[0,0,1,0],[0,0,0,1]]) cube(10);");
  EXPECT_EQ(scene.half_spaces.size(), 7u);
}

TEST(Lower, CurvedWallsShareAQuadric) {
  const Scene scene = lowered(
      "difference(){cylinder(r=5,h=10); translate([0,0,4]) cylinder(r=5,h=20);}"
      "rotate([0,0,33]) translate([0,0,-3]) cylinder(r=5,h=1);");
  int quadrics = 0;
  for (const HalfSpace& h : scene.half_spaces) quadrics += !h.is_plane();
  EXPECT_EQ(quadrics, 1);
}

TEST(Lower, DifferentCurvedWallsStayDifferent) {
  const Scene scene = lowered("sphere(5); sphere(5.001); translate([0.001,0,0]) sphere(5);");
  EXPECT_EQ(scene.half_spaces.size(), 3u);
}

TEST(Lower, APrimitiveIsNeverEatenByTheTolerance) {
  // The tolerance of this model is 2; the small parts keep their faces to a thousandth of their own
  // width.
  const Scene scene = lowered(
      "cube(1000000); translate([-5,0,0]) cube(0.000001); translate([-5,9,0]) cube([1,1,0.001]);"
      "translate([-9,0,0]) difference(){sphere(0.01); sphere(0.0099);}");
  EXPECT_GE(scene.tolerance, 2.0);
  for (const Unit& unit : scene.units)
    for (uint32_t i = 0; i < unit.face_count; ++i)
      for (uint32_t j = 0; j < i; ++j)
        EXPECT_NE(scene.faces[unit.first_face + i].literal >> 1,
                  scene.faces[unit.first_face + j].literal >> 1);
  EXPECT_NE(scene.faces.back().literal, scene.faces[scene.faces.size() - 2].literal);
}

TEST(HalfSpaceTable, NearlyEqualPlanesDoNotChain) {
  const double tolerance = 1e-6;
  HalfSpaceTable table(1, 1e-6);
  const Reach reach{{}, 1, 1, tolerance};
  for (int i = 0; i < 100; ++i)
    table.add({{0, 0, i * 0.75 * tolerance}, {{}, {}, {0, 0, 0.5}, 0}, SurfaceKind::kPlane}, reach,
              {});
  // Each representative takes in the next one and no more.
  EXPECT_EQ(table.size(), 50u);
}

TEST(HalfSpaceTable, FindsEqualsAcrossBucketBorders) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  HalfSpaceTable table(1, 1e-6);
  for (int i = 0; i < 5000; ++i) {
    const HalfSpace h{{unit(random), unit(random), unit(random)},
                      {{}, {}, normalize(Vec3{unit(random), unit(random), unit(random)}) * 0.5, 0},
                      SurfaceKind::kPlane};
    HalfSpace moved = h;
    moved.center += moved.f.b * (1.9e-6 * unit(random));
    HalfSpace turned = moved;
    turned.f.b = -turned.f.b;
    const Reach reach{h.center, 1, 1, 1e-6};
    const Literal first = table.add(h, reach, {});
    EXPECT_EQ(table.add(moved, reach, {}), first);
    EXPECT_EQ(table.add(turned, reach, {}), first ^ 1);
  }
}

/// Whether a point is in a shape, in the shape's own coordinates and by its own definition.
bool in_shape(const Shape& shape, Vec3 p) {
  if (const auto* c = std::get_if<Cube>(&shape)) {
    const Vec3 q = c->center ? p + c->size * 0.5 : p;
    return q.x >= 0 && q.y >= 0 && q.z >= 0 && q.x <= c->size.x && q.y <= c->size.y &&
           q.z <= c->size.z;
  }
  if (is_flat(shape)) {
    for (const Plane& plane : facet_planes(shape))
      if (dot(plane.n, p) > plane.d) return false;
    return true;
  }
  if (const auto* s = std::get_if<Sphere>(&shape)) return dot(p, p) <= s->r * s->r;
  const auto& c = std::get<Cylinder>(shape);
  const double z = c.center ? p.z + c.h / 2 : p.z;
  const double r = c.r1 + (c.r2 - c.r1) * z / c.h;
  return z >= 0 && z <= c.h && p.x * p.x + p.y * p.y <= r * r;
}

TEST(PrimitiveFaces, TheirConjunctionIsThePrimitive) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(-1, 1);
  const Shape shapes[] = {Cube{{1, 2, 3}, false},
                          Cube{{1, 2, 3}, true},
                          Sphere{1.3, 0},
                          Sphere{1.3, 7},
                          Cylinder{2, 1, 1, false, 0},
                          Cylinder{2, 1.5, 0.25, true, 0},
                          Cylinder{2, 0, 1, false, 0},
                          Cylinder{2, 1, 0, true, 0},
                          Cylinder{2, 1, 0.5, false, 5},
                          Halfspace{{1, 2, -1}, 0.5}};
  for (const Shape& shape : shapes) {
    int in = 0;
    for (int i = 0; i < 50; ++i) {
      Affine map;
      for (Vec3& row : map.row) row = {unit(random), unit(random), unit(random)};
      map.translation = Vec3{unit(random), unit(random), unit(random)} * 5.0;
      if (std::fabs(map.determinant()) < 0.05) continue;
      LoweredPrimitive lowered;
      lower_primitive(shape, map, lowered);
      for (int j = 0; j < 50; ++j) {
        const Vec3 p = Vec3{unit(random), unit(random), unit(random)} * 2.5;
        bool conjunction = true, close = false;
        for (const HalfSpace& surface : lowered.half_spaces) {
          const double f = Kernels<double>::quadric_value(surface.f, map.point(p) - surface.center);
          conjunction &= f <= 0;
          close |= std::fabs(f) < 1e-9;
        }
        in += conjunction;
        EXPECT_TRUE(close || conjunction == in_shape(shape, p)) << shape.index();
      }
    }
    EXPECT_GT(in, 0) << shape.index();
  }
}

TEST(PrimitiveFaces, ValueIsAtMostTheDistance) {
  // |gradient| <= 1 at the surface, and 1 where it is steepest: tolerances are lengths.
  LoweredPrimitive lowered;
  lower_primitive(Sphere{2, 0}, scaling({3, 1, 1}), lowered);
  const HalfSpace& h = lowered.half_spaces[0];
  using K = Kernels<double>;
  EXPECT_NEAR(2 * length(K::quadric_half_gradient(h.f, {0, 2, 0})), 1, 1e-12);
  EXPECT_NEAR(2 * length(K::quadric_half_gradient(h.f, {6, 0, 0})), 1.0 / 3, 1e-12);
}

TEST(Lower, OperatorsMeanWhatTheySay) {
  const Vec3 in_a{2, 5, 5}, in_both{7, 5, 5}, in_b{12, 5, 5}, in_none{20, 5, 5};
  const std::string a = "cube(10);", b = "translate([5,0,0]) cube(10);";
  struct Case {
    std::string text;
    bool a, both, b, none;
  };
  const Case cases[] = {
      {"union(){" + a + b + "}", true, true, true, false},
      {"difference(){" + a + b + "}", true, false, false, false},
      {"intersection(){" + a + b + "}", false, true, false, false},
      {"difference(){union(){" + a + b + "} intersection(){" + a + b + "}}", true, false, true,
       false},
      {"difference(){" + a + "difference(){" + a + b + "}}", false, true, false, false},
      {"intersection(){" + a + "difference(){" + a + "}}", true, true, false, false},
      // An empty but present operand counts.
      {"difference(){group(); cube(10);}", false, false, false, false},
      {"intersection(){group(); cube(10);}", false, false, false, false},
      {"intersection(){cube(10); cube([0,1,1]);}", false, false, false, false},
      {"difference(){cube(10); group(); intersection(){} difference(){}}", true, true, false,
       false},
      {"difference(){cube(10); sphere(0);}", true, true, false, false},
      // A background operand does not.
      {"difference(){%sphere(100); cube(10); " + b + "}", true, false, false, false},
      {"intersection(){%sphere(0); cube(10);}", true, true, false, false},
  };
  for (const Case& c : cases) {
    const Scene scene = lowered(c.text);
    EXPECT_EQ(inside(scene, in_a), c.a) << c.text;
    EXPECT_EQ(inside(scene, in_both), c.both) << c.text;
    EXPECT_EQ(inside(scene, in_b), c.b) << c.text;
    EXPECT_EQ(inside(scene, in_none), c.none) << c.text;
  }
}

TEST(Lower, GroupsOfOneKindBecomeOne) {
  const Scene scene =
      lowered("union(){union(){sphere(1); union(){sphere(2); sphere(3);}} group(){sphere(4);}}");
  int groups = 0;
  for (const Token token : scene.formula) groups += token.is_group();
  EXPECT_EQ(groups, 1);
  EXPECT_EQ(scene.formula.size(), 5u);
}

TEST(Lower, AChainOf100000OperandsIsOneConjunction) {
  // ((cube - s1) - s2) - ...: nested as OpenSCAD programs nest it, and flat once lowered.
  const int n = 100000;
  std::string text;
  for (int i = 0; i < n; ++i) text += "difference(){";
  text += "cube(10);";
  for (int i = 0; i < n; ++i) text += "translate([0,0," + std::to_string(i) + "]) sphere(0.3);}";
  const Scene scene = lowered(text);
  EXPECT_EQ(scene.units.size(), size_t(n) + 1);
  size_t conjunctions = 0;
  for (const Token token : scene.formula) conjunctions += token.kind() == TokenKind::kAnd;
  // Each translate() is a union of one, negated: a conjunction inside of one.
  EXPECT_EQ(conjunctions, 1u);
  EXPECT_FALSE(inside(scene, {0.1, 0.1, 3}));
  EXPECT_TRUE(inside(scene, {5, 5, 3}));
}

TEST(Lower, AlternatingNestingOf10000Passes) {
  std::string text, tail;
  for (int i = 0; i < 10000; ++i) {
    text += i % 2 ? "union(){" : "intersection(){";
    tail = (i % 2 ? "sphere(1);}" : "sphere(100);}") + tail;
  }
  const Scene scene = lowered(text + "cube(10);" + tail);
  EXPECT_TRUE(inside(scene, {5, 5, 5}));
  EXPECT_TRUE(inside(scene, {-0.5, 0, 0}));
  EXPECT_FALSE(inside(scene, {-1.5, 0, 0}));
}

TEST(Lower, NothingIsAFalseFormula) {
  for (const char* text : {"", "sphere(0);", "difference(){group(); cube(1);}"}) {
    const Scene scene = lowered(text);
    EXPECT_TRUE(scene.region.is_empty()) << text;
    EXPECT_FALSE(inside(scene, {0.5, 0.5, 0.5})) << text;
  }
}

TEST(Lower, FarFromTheOriginNothingIsLost) {
  const Scene scene = lowered("translate([1e6,-1e6,1e6]) difference(){cube(10); sphere(0.01);}");
  EXPECT_FALSE(inside(scene, {1e6 + 0.001, -1e6 + 0.001, 1e6 + 0.001}));
  EXPECT_TRUE(inside(scene, {1e6 + 0.02, -1e6 + 0.001, 1e6 + 0.001}));
}

}  // namespace
}  // namespace whittle
