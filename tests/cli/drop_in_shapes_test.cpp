// What people bring from openscad that is more than solids put together: flat shapes, meshes,
// resized bodies.
#include "image/exr.h"
#include "support/program.h"

namespace whittle {
namespace {

class DropInShapes : public ProgramTest {
 protected:
  Ended good(const std::vector<std::string>& arguments) {
    Ended done = run(arguments);
    EXPECT_EQ(done.exit_code, 0) << done.err;
    return done;
  }
  /// Both draw the same; ids and names may be others.
  void expect_same(const std::string& a, const std::string& b) {
    EXPECT_EQ(good({a, "-o", "a.exr", "--imgsize", "60,40"}).err, "");
    good({b, "-o", "b.exr", "--imgsize", "60,40"});
    const Ended compared = run({"compare", "a.exr", "b.exr"});
    EXPECT_EQ(compared.exit_code, 0) << a << " and " << b << ": " << compared.out;
  }
  /// A cube from the origin, in twelve triangles.
  static std::string cube_mesh() {
    const char* corners[] = {"0 0 0", "2 0 0", "2 2 0", "0 2 0",
                             "0 0 2", "2 0 2", "2 2 2", "0 2 2"};
    const int triangles[12][3] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                                  {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
    std::string text = "solid cube\n";
    for (const auto& triangle : triangles) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (const int corner : triangle) text += std::string("vertex ") + corners[corner] + "\n";
      text += "endloop\nendfacet\n";
    }
    return text + "endsolid\n";
  }
};

TEST_F(DropInShapes, AMisturnedPrismIsAPrism) {
  write("prism.scad",
        "polyhedron(points = [[0,0,0],[10,0,0],[5,8,0],[0,0,4],[10,0,4],[5,8,4]],\n"
        "           faces = [[0,1,2],[5,4,3],[0,3,4,1],[1,4,5,2],[0,3,5,2]]);\n");
  write("turned.csg",
        "polyhedron(points = [[0,0,0],[10,0,0],[5,8,0],[0,0,4],[10,0,4],[5,8,4]],\n"
        "           faces = [[0,1,2],[5,4,3],[0,3,4,1],[1,4,5,2],[2,5,3,0]]);\n");
  expect_same("prism.scad", "turned.csg");
}

TEST_F(DropInShapes, AResizedCubeIsAPlate) {
  write("plate.scad", "resize([0, 0, 0.4]) cube(10);\n");
  write("plate.csg", "*cube(1); cube([10, 10, 0.4]);\n");
  expect_same("plate.scad", "plate.csg");
}

TEST_F(DropInShapes, AMinkowskiSumDoesNotDecideTheFramingByItsTools) {
  write("sum.scad",
        "difference() {\n"
        "  translate([40, 0, 0]) minkowski() { cube([20, 10, 5]); cylinder(r = 2, h = 1); }\n"
        "  translate([40, -9, -9]) cube(30);\n"
        "}\n");
  write("cut.csg", "difference() { cube(1); cube(2); }");
  const Ended sum = run({"sum.scad", "-o", "x.png", "--imgsize", "16,16", "--lenient"});
  EXPECT_EQ(sum.exit_code, 0) << sum.err;
  EXPECT_EQ(sum.err.find("union of its children"), std::string::npos) << sum.err;
}

TEST_F(DropInShapes, ADrillThatIsAnExtrusionDrills) {
  write("drilled.scad",
        "difference() { cube(20, center = true); linear_extrude(30, center = true) circle(5); }");
  write("drilled.csg",
        "difference() { cube(20, center = true); cylinder(h = 30, r = 5, center = true); }");
  expect_same("drilled.scad", "drilled.csg");
}

TEST_F(DropInShapes, BackgroundIsNoPartOfTheModel) {
  write("strict.csg", "cube(1); %import(file=\"x.stl\");");
  EXPECT_EQ(good({"strict.csg", "-o", "x.png", "--strict", "--imgsize", "8,8"}).exit_code, 0);
}

TEST_F(DropInShapes, AShapeWithoutEndInItsSizeIsSaid) {
  write("inf.csg", "cube(1); sphere(r=inf);");
  const Ended done = run({"inf.csg", "-o", "x.png", "--imgsize", "8,8"});
  EXPECT_NE(done.err.find("inf.csg:1:10: warning: "), std::string::npos) << done.err;
}

TEST_F(DropInShapes, AMeshIsOpened) {
  write("box.csg", "cube(2);");
  const std::string name = "it's a \"box\".stl";
  write(name, cube_mesh());
  expect_same(name, "box.csg");
  write("BOX.STL", cube_mesh());
  expect_same("BOX.STL", "box.csg");
  expect_same("./BOX.STL", "box.csg");
  good({"BOX.STL", "-o", "x.png", "-d", "deps", "--imgsize", "8,8"});
  EXPECT_EQ(read("deps"), "x.png: \\\n\tBOX.STL\n");
}

TEST_F(DropInShapes, AMeshThatIsOpenIsSaid) {
  const std::string whole = cube_mesh();
  const size_t facet = whole.find("facet");
  write("open.stl", whole.substr(0, facet) + whole.substr(whole.find("facet normal", facet + 1)));
  const Ended done = run({"open.stl", "-o", "x.png", "--imgsize", "8,8"});
  EXPECT_EQ(done.exit_code, 1);
  EXPECT_EQ(done.err.find("open.stl: warning: 3 edges are open, the first at ["), 0u) << done.err;
}

TEST_F(DropInShapes, DependenciesHoldWhatIsImported) {
  write("box.stl", cube_mesh());
  write("main.csg", "import(file = \"box.stl\"); import(file = \"box.stl\");");
  good({"main.csg", "-o", "x.png", "-d", "deps", "--imgsize", "8,8"});
  EXPECT_EQ(read("deps"), "x.png: \\\n\tmain.csg \\\n\tbox.stl\n");
}

}  // namespace
}  // namespace whittle
