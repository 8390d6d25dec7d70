// What arguments mean. The expected values are OpenSCAD 2021.01's, as it dumps these statements,
// except where a test says otherwise.
#include "csg/statements.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "csg/read_csg.h"
#include "csg/test_support.h"

namespace whittle {
namespace {

/// The shape of the only primitive of a text.
template <class S>
S only(const std::string& text, const ReadOptions& options = {}) {
  const Read read = read_good(text, options);
  if (read.model.primitives.size() != 1) {
    ADD_FAILURE() << "not one primitive: " << text;
    return {};
  }
  return std::get<S>(read.model.primitives[0].shape);
}

bool warns(const std::string& text) {
  return !read_good(text).warnings.empty();
}

TEST(CsgStatements, Cube) {
  const std::pair<const char*, Cube> cases[] = {
      {"cube();", {{1, 1, 1}, false}},
      {"cube(2);", {{2, 2, 2}, false}},
      {"cube([1, 2, 3], true);", {{1, 2, 3}, true}},
      {"cube(center = true, size = [1, 2, 3,],);", {{1, 2, 3}, true}},
      {"cube(2, 1);", {{2, 2, 2}, false}},
      {"cube(3, size = 2);", {{2, 2, 2}, false}},
      {"cube(size = 1, size = 2);", {{2, 2, 2}, false}},
      {"cube(--3);", {{3, 3, 3}, false}},
      {"cube(PI);", {{M_PI, M_PI, M_PI}, false}},
      {"cube(size = \"a\");", {{1, 1, 1}, false}},
      {"cube([1, 2]);", {{1, 1, 1}, false}},
      {"cube([1, 2, 3, 4]);", {{1, 1, 1}, false}},
      // As the current OpenSCAD does; 2021.01 takes true for the size.
      {"cube(size = 5, true);", {{5, 5, 5}, true}},
  };
  for (const auto& [text, expected] : cases) {
    EXPECT_EQ(only<Cube>(text).size, expected.size) << text;
    EXPECT_EQ(only<Cube>(text).center, expected.center) << text;
  }
  EXPECT_TRUE(warns("cube([1, 2]);"));
  EXPECT_FALSE(warns("cube([1, 2, 3]);"));
}

TEST(CsgStatements, Sphere) {
  EXPECT_EQ(only<Sphere>("sphere();").r, 1);
  EXPECT_EQ(only<Sphere>("sphere(3);").r, 3);
  EXPECT_EQ(only<Sphere>("sphere(d = 4);").r, 2);
  EXPECT_EQ(only<Sphere>("sphere(d = 4, r = 7);").r, 2);
  EXPECT_TRUE(warns("sphere(d = 4, r = 7);"));
  EXPECT_EQ(only<Sphere>("sphere(\"a\");").r, 1);
  EXPECT_EQ(only<Sphere>("sphere(r = undef);").r, 1);
}

TEST(CsgStatements, Cylinder) {
  const std::pair<const char*, Cylinder> cases[] = {
      {"cylinder();", {1, 1, 1, false, 0}},
      {"cylinder(1, 2, 3, true);", {1, 2, 3, true, 0}},
      {"cylinder(h = 5, r = 2);", {5, 2, 2, false, 0}},
      {"cylinder(h = 5, d = 2);", {5, 1, 1, false, 0}},
      {"cylinder(h = 5, d1 = 2, d2 = 8);", {5, 1, 4, false, 0}},
      {"cylinder(r = 3, r1 = 4);", {1, 4, 3, false, 0}},
      {"cylinder(d = 4, d1 = 6, r2 = 5, h = -1);", {-1, 3, 5, false, 0}},
      {"cylinder(r2 = 4);", {1, 1, 4, false, 0}},
      // As the current OpenSCAD does; 2021.01 takes 3 for the height.
      {"cylinder(h = 5, 3);", {5, 3, 1, false, 0}},
  };
  for (const auto& [text, expected] : cases) {
    const Cylinder cylinder = only<Cylinder>(text);
    EXPECT_EQ(cylinder.h, expected.h) << text;
    EXPECT_EQ(cylinder.r1, expected.r1) << text;
    EXPECT_EQ(cylinder.r2, expected.r2) << text;
    EXPECT_EQ(cylinder.center, expected.center) << text;
  }
  EXPECT_TRUE(warns("cylinder(r = 3, r1 = 4);"));
  EXPECT_TRUE(warns("cylinder(1, 2, 3, true, 5);"));
}

TEST(CsgStatements, Halfspace) {
  EXPECT_EQ(only<Halfspace>("halfspace();").n, (Vec3{0, 0, 1}));
  EXPECT_EQ(only<Halfspace>("halfspace(n = [1, 2, -3], d = -4);").n, (Vec3{1, 2, -3}));
  EXPECT_EQ(only<Halfspace>("halfspace(n = [1, 2, -3], d = -4);").d, -4);
  EXPECT_EQ(only<Halfspace>("halfspace([1, 0, 0], 5);").d, 5);
  EXPECT_TRUE(warns("halfspace(n = [1, 2]);"));
  EXPECT_TRUE(warns("halfspace(d = [1]);"));
}

TEST(CsgStatements, Polyhedron) {
  const Polyhedron tetrahedron = only<Polyhedron>(
      "polyhedron(points = [[0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],"
      "faces = [[0, 1, 2], [0, 1], [0, 3, 1], [1, 3, 2], [2, 3, 0]], convexity = 1);");
  EXPECT_EQ(tetrahedron.points.size(), 4u);
  EXPECT_EQ(tetrahedron.points[0], (Vec3{0, 0, 0}));
  EXPECT_EQ(tetrahedron.faces.size(), 4u);
  EXPECT_EQ(tetrahedron.faces[1], (std::vector<uint32_t>{0, 3, 1}));
  EXPECT_EQ(tetrahedron.planes.size(), 4u);
  EXPECT_EQ(only<Polyhedron>("polyhedron([[0,0,0],[1,0,0],[0,1,0],[0,0,1]], triangles = [[0,1,2],"
                             "[0,3,1],[1,3,2],[2,3,0]]);")
                .planes.size(),
            4u);
  EXPECT_TRUE(only<Polyhedron>("polyhedron();").planes.empty());
  EXPECT_TRUE(only<Polyhedron>("polyhedron(points = undef, faces = [[]]);").planes.empty());
}

TEST(CsgStatements, ShapesThatAreNotFiniteOrPositiveStayAsEmptyOnes) {
  for (const char* text :
       {"cube(0);", "cube([1, -2, 3]);", "cube([inf, 1, 1]);", "cube([1, nan, 1]);",
        "cube(size = [-inf, 1, 1]);", "cube(1e999);", "cube(1e-999);", "sphere(r = inf);",
        "sphere(r = -nan);", "sphere(0);", "cylinder(h = inf, r = 1);", "cylinder(h = 0);",
        "cylinder(r1 = 0, r2 = 0);", "cylinder(r1 = -1, r2 = 1);", "halfspace(n = [0, 0, 0]);",
        "halfspace(d = nan);"}) {
    const Model model = read_good(text).model;
    ASSERT_EQ(model.nodes.size(), 2u) << text;
    EXPECT_TRUE(is_empty(model.primitives[0].shape)) << text;
  }
}

TEST(CsgStatements, FacetsFollowTheFragmentSettings) {
  const auto facets = [](const std::string& text, Curves curves = Curves::kAuto) {
    return only<Sphere>(text, {.curves = curves}).facets;
  };
  EXPECT_EQ(facets("sphere($fn = 0, $fa = 12, $fs = 2, r = 1);"), 0);
  EXPECT_EQ(facets("sphere($fn = 8, r = 1);"), 8);
  EXPECT_EQ(facets("sphere($fn = 8, r = 1);", Curves::kSmooth), 0);
  EXPECT_EQ(facets("sphere($fn = 0, $fa = 12, $fs = 2, r = 10);", Curves::kFacets), 30);
  EXPECT_EQ(facets("sphere($fn = 0, $fa = 12, $fs = 2, r = 1);", Curves::kFacets), 5);
  EXPECT_EQ(facets("sphere($fn = 8, r = 0);"), 0);
  EXPECT_EQ(
      only<Cylinder>("cylinder($fa = 1, $fs = 1, r1 = 1, r2 = 10);", {.curves = Curves::kFacets})
          .facets,
      63);
}

TEST(CsgStatements, FragmentSettingsAreInherited) {
  const auto facets = [](const std::string& text) { return only<Sphere>(text).facets; };
  EXPECT_EQ(facets("$fn = 7; sphere();"), 7);
  EXPECT_EQ(facets("sphere(); $fn = 7;"), 7);
  EXPECT_EQ(facets("$fn = 7; sphere($fn = 5);"), 5);
  EXPECT_EQ(facets("$fn = 7; sphere($fn = 0);"), 0);
  EXPECT_EQ(facets("translate([1,0,0], $fn = 9) sphere();"), 9);
  EXPECT_EQ(facets("$fn = 7; translate([1,0,0], $fa = 9) { group() sphere(); }"), 7);
  EXPECT_EQ(facets("render($fn = 9) scale(2, $fn = 8) rotate(3, $fa = 1) sphere();"), 8);
  EXPECT_EQ(facets("translate([1,0,0], $fn = 9) {} sphere();"), 0);
  // These four hand nothing on.
  for (const char* name : {"group", "union", "difference", "intersection"}) {
    EXPECT_EQ(facets(std::string(name) + "($fn = 9) sphere();"), 0) << name;
  }
}

/// The map above the only primitive.
Affine map_of(const std::string& text) {
  const Model model = read_good(text + " cube();").model;
  return model.transforms.empty() ? Affine{} : model.transforms[0];
}

void expect_near(const Affine& a, const Affine& b, const std::string& what) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(a.row[i][j], b.row[i][j], 1e-6) << what << i << j;
    EXPECT_NEAR(a.translation[i], b.translation[i], 1e-6) << what << i;
  }
}

TEST(CsgStatements, Multmatrix) {
  EXPECT_EQ(map_of("multmatrix([[1,2,3,4],[5,6,7,8],[9,10,11,12],[0,0,0,1]])"),
            (Affine{{{1, 2, 3}, {5, 6, 7}, {9, 10, 11}}, {4, 8, 12}}));
  EXPECT_EQ(map_of("multmatrix([[2,0],[0,3]])"), scaling({2, 3, 1}));
  EXPECT_EQ(map_of("multmatrix([[1,2,undef],\"a\",[1]])"),
            (Affine{{{1, 2, 0}, {0, 1, 0}, {1, 0, 1}}, {}}));
  EXPECT_EQ(map_of("multmatrix([[2,0,0,4],[0,2,0,0],[0,0,2,0],[0,0,0,2]])"),
            translation({2, 0, 0}));
  EXPECT_EQ(map_of("multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,5],[7,7,7,1],[9]])"),
            translation({0, 0, 5}));
  EXPECT_EQ(map_of("multmatrix(m = [[1,0,0,-0.5]])"), translation({-0.5, 0, 0}));
  EXPECT_EQ(map_of("multmatrix(3)"), Affine{});
  EXPECT_TRUE(warns("multmatrix(3) cube();"));
}

TEST(CsgStatements, AMatrixThatIsNotFiniteStaysSoAndGivesAWarning) {
  for (const char* text :
       {"multmatrix([[inf]])", "multmatrix([[1,0,0,nan]])",
        "multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,0]])", "rotate(inf)"}) {
    EXPECT_FALSE(map_of(text).is_finite()) << text;
    EXPECT_TRUE(warns(std::string(text) + " cube();")) << text;
  }
  EXPECT_TRUE(warns("scale([1, 1, 0]) cube();"));
}

TEST(CsgStatements, TranslateAndScaleAndMirror) {
  EXPECT_EQ(map_of("translate([1, 2, 3])"), translation({1, 2, 3}));
  EXPECT_EQ(map_of("translate(v = [1, 2])"), translation({1, 2, 0}));
  EXPECT_EQ(map_of("scale(2)"), scaling({2, 2, 2}));
  EXPECT_EQ(map_of("scale([2, 3])"), scaling({2, 3, 1}));
  EXPECT_EQ(map_of("scale([1, 2, 3])"), scaling({1, 2, 3}));
  EXPECT_EQ(map_of("mirror()"), scaling({-1, 1, 1}));
  EXPECT_EQ(map_of("mirror([0, 1])"), scaling({1, -1, 1}));
  EXPECT_EQ(map_of("mirror([0, 0, 0])"), Affine{});
  expect_near(map_of("mirror([1, 1, 0])"), {{{0, -1, 0}, {-1, 0, 0}, {0, 0, 1}}, {}}, "mirror");
  for (const char* text : {"translate(5)", "translate([1])", "translate([1,2,3,4])", "scale([2])",
                           "scale([1,2,3,4])", "scale(\"x\")"}) {
    EXPECT_EQ(map_of(text), Affine{}) << text;
    EXPECT_TRUE(warns(std::string(text) + " cube();")) << text;
  }
}

TEST(CsgStatements, Rotate) {
  const double s = std::sqrt(0.5), c30 = std::sqrt(0.75);
  expect_near(map_of("rotate(30)"), {{{c30, -0.5, 0}, {0.5, c30, 0}, {0, 0, 1}}, {}}, "30");
  expect_near(map_of("rotate([10, 20, 30])"),
              {{{0.813798, -0.44097, 0.378522},
                {0.469846, 0.882564, 0.0180283},
                {-0.34202, 0.163176, 0.925417}},
               {}},
              "three angles");
  expect_near(map_of("rotate(a = 45, v = [1, 1, 0])"),
              {{{0.853553, 0.146447, 0.5}, {0.146447, 0.853553, -0.5}, {-0.5, 0.5, s}}, {}},
              "axis");
  EXPECT_EQ(map_of("rotate(a = 90, v = [1, 0])"), (Affine{{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, {}}));
  EXPECT_EQ(map_of("rotate([0, 0, 90])"), (Affine{{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}, {}}));
  EXPECT_EQ(map_of("rotate([90])"), (Affine{{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, {}}));
  EXPECT_EQ(map_of("rotate(45, [0, 0, 0])"), Affine{});
  EXPECT_EQ(map_of("rotate()"), Affine{});
  EXPECT_TRUE(warns("rotate([90, undef, 0]) cube();"));
  EXPECT_TRUE(warns("rotate([0, 0, 90], [1, 0, 0]) cube();"));
}

TEST(CsgStatements, Color) {
  const auto color = [](const std::string& argument) {
    const Model model = read_good("color(" + argument + ") cube();").model;
    return model.colors.empty() ? Rgba{} : model.colors[0];
  };
  const std::pair<const char*, Rgba> cases[] = {
      {"[0.1, 0.2, 0.3, 0.4]", {0.1f, 0.2f, 0.3f, 0.4f}},
      {"[0.1, 0.2, 0.3]", {0.1f, 0.2f, 0.3f, 1}},
      {"c = [1, 0]", {1, 0, 1, 1}},
      {"[]", {1, 1, 1, 1}},
      {"[1, undef, \"a\", 1]", {1, 0, 0, 1}},
      {"[0.1, 0.2, 0.3, 0.4], alpha = 0.9", {0.1f, 0.2f, 0.3f, 0.9f}},
      {"[-1, -1, -1, 0.3]", {-1, -1, -1, 0.3f}},
      {"alpha = 0.3", {-1, -1, -1, 0.3f}},
      {"[2, -0.5, 0.5]", {1, -1, 0.5f, 1}},
      {"\"red\", 0.5", {1, 0, 0, 0.5f}},
      {"\"ReD\"", {1, 0, 0, 1}},
      {"\"transparent\"", {0, 0, 0, 0}},
      {"\"rebeccapurple\"", {0.4f, 0.2f, 0.6f, 1}},
      {"\"aliceblue\"", {240 / 255.f, 248 / 255.f, 1, 1}},
      {"\"yellowgreen\"", {154 / 255.f, 205 / 255.f, 50 / 255.f, 1}},
      {"\"#abc\"", {170 / 255.f, 187 / 255.f, 204 / 255.f, 1}},
      {"\"#f0f8\"", {1, 0, 1, 136 / 255.f}},
      {"\"#abcdef\"", {171 / 255.f, 205 / 255.f, 239 / 255.f, 1}},
      {"\"#12345678\"", {18 / 255.f, 52 / 255.f, 86 / 255.f, 120 / 255.f}},
  };
  for (const auto& [text, expected] : cases) EXPECT_EQ(color(text), expected) << text;
  for (const char* text :
       {"\"nope\"", "\"\"", "\"#zzz\"", "\"#12\"", "\"#\"", "\"# 12\"", "\"#-ab\""}) {
    EXPECT_EQ(color(text), Rgba{}) << text;
    EXPECT_TRUE(warns("color(" + std::string(text) + ") cube();")) << text;
  }
}

TEST(CsgStatements, AColorIsWarnedOfOnce) {
  const auto warnings = [](const std::string& arguments) {
    return read_good("color(" + arguments + ") cube();").warnings;
  };
  EXPECT_EQ(
      warnings("[2, -0.5, 1e300]"),
      std::vector<std::string>{"t.csg:1:1: warning: color: a component is not between 0 and 1"});
  EXPECT_EQ(warnings("[inf, \"a\", -5]"),
            (std::vector<std::string>{
                "t.csg:1:1: warning: color: a component is not a number; it is read as 0",
                "t.csg:1:1: warning: color: a component is not between 0 and 1"}));
  EXPECT_TRUE(warnings("").empty());
  EXPECT_TRUE(warnings("undef, undef").empty());
  EXPECT_TRUE(warnings("[-1, -1, -1, 1]").empty());
}

TEST(CsgStatements, ArgumentsOfAWrongTypeAreIgnoredWithAWarning) {
  const std::pair<const char*, const char*> cases[] = {
      {"sphere(\"big\");", "sphere: r is not a number; it is ignored"},
      {"color(1) cube();", "color: c is neither a name nor a vector; nothing is coloured"},
      {"color(true) cube();", "color: c is neither a name nor a vector; nothing is coloured"},
      {"color(\"red\", \"half\") cube();", "color: alpha is not a number; it is ignored"},
      {"sphere(d = [1]);", "sphere: d is not a number; it is ignored"},
      {"cylinder(h = true);", "cylinder: h is not a number; it is ignored"},
      {"cylinder(r2 = \"a\");", "cylinder: r2 is not a number; it is ignored"},
      {"cube(center = 1);", "cube: center is neither true nor false; it is ignored"},
      {"sphere($fn = \"a\");", "sphere: $fn is not a number; it is ignored"},
      {"$fs = true; sphere();", "$fs is not a number; it is ignored"},
      {"$vpf = 180; sphere();", "$vpf is not a number between 0 and 180; it is ignored"},
      {"cube(size = 1, size = 2);", "cube: size is given more than once; the last one counts"},
      {"multmatrix([[1,0,0,0],\"a\"]) cube();",
       "multmatrix: not all of the matrix is four rows of four numbers; the rest is ignored"},
  };
  for (const auto& [text, expected] : cases) {
    const Read read = read_good(text);
    ASSERT_EQ(read.warnings.size(), 1u) << text;
    EXPECT_EQ(read.warnings[0], "t.csg:1:1: warning: " + std::string(expected));
    EXPECT_FALSE(read.unsupported) << text;
  }
  EXPECT_FALSE(warns("sphere(r = undef, d = undef); cylinder(h = undef, center = undef);"));
}

TEST(CsgStatements, ArgumentsThatAreNotKnownGiveAWarningButCountAsUnderstood) {
  const Read read = read_good("cube(size = 2,\n  colour = 3);");
  ASSERT_EQ(read.warnings.size(), 1u);
  EXPECT_EQ(read.warnings[0],
            "t.csg:2:3: warning: cube: the argument 'colour' is not known; it is ignored");
  EXPECT_FALSE(read.unsupported);
  EXPECT_FALSE(warns("cube(1, $other = 3, $fn = 5); render(convexity = 3) sphere();"));
}

}  // namespace
}  // namespace whittle
