// Boundaries of the public API.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <filesystem>

#include "base/folder_for_test.h"
#include "whittle/whittle.h"

namespace whittle {
namespace {

constexpr LoadOptions kFacetted{.curves = Curves::kOpenscad2021};

BoundaryMesh boundary_of_text(const std::string& text) {
  return Solid::parse(text, "text", kFacetted).boundary();
}

double six_volumes(const BoundaryMesh& boundary) {
  double sum = 0;
  for (const auto& [a, b, c] : boundary.triangles) {
    const Point &p = boundary.corners[a], &q = boundary.corners[b], &r = boundary.corners[c];
    sum += p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) +
           p[2] * (q[0] * r[1] - q[1] * r[0]);
  }
  return sum;
}

/// Twice the area that loops enclose, seen along the normal.
double two_areas(const BoundaryMesh& boundary, const BoundaryMesh::Face& face) {
  double sum = 0;
  for (const BoundaryMesh::Loop& loop : face.loops)
    for (size_t i = 0; i < loop.size(); ++i) {
      const Point &p = boundary.corners[loop[i]],
                  &q = boundary.corners[loop[(i + 1) % loop.size()]];
      sum += face.normal[0] * (p[1] * q[2] - p[2] * q[1]) +
             face.normal[1] * (p[2] * q[0] - p[0] * q[2]) +
             face.normal[2] * (p[0] * q[1] - p[1] * q[0]);
    }
  return sum;
}

TEST(Boundary, FacesArePolygonsWithHoles) {
  const BoundaryMesh boundary = boundary_of_text(
      "difference() { color([1, 0.5, 0, 1]) cube([8, 8, 2]);\n"
      "multmatrix([[1, 0, 0, 3], [0, 1, 0, 3], [0, 0, 1, -1], [0, 0, 0, 1]]) cube([2, 2, 4]); }");
  EXPECT_EQ(boundary.corners.size(), 16u);
  EXPECT_EQ(boundary.triangles.size(), 32u);
  EXPECT_DOUBLE_EQ(six_volumes(boundary), 6 * (8 * 8 - 2 * 2) * 2);
  ASSERT_EQ(boundary.faces.size(), 10u);
  double area = 0;
  size_t with_hole = 0, of_cutter = 0, triangles = 0;
  for (const BoundaryMesh::Face& face : boundary.faces) {
    area += two_areas(boundary, face) / 2;
    with_hole += face.loops.size() == 2;
    of_cutter += face.id == 2;
    EXPECT_EQ(face.color.has_value(), face.id == 1);
    EXPECT_EQ(face.first_triangle, triangles);
    triangles += face.triangle_count;
  }
  EXPECT_EQ(with_hole, 2u);
  EXPECT_EQ(of_cutter, 4u);
  EXPECT_EQ(triangles, boundary.triangles.size());
  EXPECT_NEAR(area, 2 * (64 - 4) + 4 * 16 + 4 * 4, 1e-9);
  EXPECT_EQ(boundary.faces[0].color.value_or(std::array<float, 4>{}),
            (std::array<float, 4>{1, 0.5f, 0, 1}));
}

TEST(Boundary, WritesWhatTheProgramWrites) {
  const TestFolder folder;
  const BoundaryMesh boundary = boundary_of_text("sphere(r = 3, $fn = 9);");
  for (const std::string name : {"a.stl", "a.off", "a.obj", "a.3mf", "a.amf"}) {
    boundary.write(folder / name);
    const Solid again = Solid::load(folder / name, kFacetted);
    EXPECT_NEAR(six_volumes(again.boundary()), six_volumes(boundary),
                (name == "a.stl" ? 1e-4 : 1e-9));
  }
  EXPECT_THROW(boundary.write(folder / "a.png"), Failure);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.png"));
}

TEST(Boundary, OfWhatCanNotBeIsRefused) {
  EXPECT_THROW(static_cast<void>(Solid::parse("sphere(r = 3);").boundary()), Failure);
  EXPECT_THROW(static_cast<void>(boundary_of_text("group();")), Failure);
  EXPECT_THROW(static_cast<void>(boundary_of_text("square(3);")), Failure);
  BoundaryMesh made;
  made.triangles = {{0, 1, 2}};
  made.faces.push_back({.id = 1, .triangle_count = 1});
  EXPECT_THROW(made.write("x.off"), Failure) << "there are no corners";
}

TEST(Boundary, OfWhatIsNoneNoFileIsMade) {
  const TestFolder folder;
  const BoundaryMesh cube = boundary_of_text("cube(1);");
  const auto expect_refused = [&](const BoundaryMesh& mesh, const std::string& message) {
    for (const std::string name : {"x.stl", "x.off"}) {
      try {
        mesh.write(folder / name);
        ADD_FAILURE() << message;
      } catch (const Failure& failure) {
        EXPECT_EQ(std::string(failure.what()), message);
      }
      EXPECT_FALSE(std::filesystem::exists(folder / name));
    }
  };
  const std::string edges = "every edge of a boundary must be there once each way";
  BoundaryMesh bad = cube;
  bad.triangles[3][1] = bad.triangles[3][0];
  expect_refused(bad, edges);
  bad = cube;
  std::swap(bad.triangles[5][0], bad.triangles[5][1]);
  expect_refused(bad, edges);
  bad = cube;
  bad.triangles.pop_back();
  --bad.faces.back().triangle_count;
  expect_refused(bad, edges);
  // Each edge twice each way.
  bad = cube;
  bad.triangles.insert(bad.triangles.end(), cube.triangles.begin(), cube.triangles.end());
  bad.faces.push_back({.id = 1, .first_triangle = 12, .triangle_count = 12});
  expect_refused(bad, edges);
  bad = cube;
  bad.faces.pop_back();
  expect_refused(bad, "the faces of a boundary must have its triangles in a row");
  for (const double number : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    bad = cube;
    bad.corners[2][1] = number;
    expect_refused(bad, "the corners of a boundary must be finite");
  }
  cube.write(folder / "x.stl");
}

TEST(Boundary, StopsAndTellsHowFarItIs) {
  const Solid solid = Solid::parse("sphere(r = 3, $fn = 40);", "text", kFacetted);
  std::atomic<double> last = 0;
  Control control;
  control.progress = [&](double share) { last = std::max(last.load(), share); };
  ASSERT_TRUE(solid.boundary(control));
  EXPECT_EQ(last, 1);
  std::stop_source stop;
  control.stop = stop.get_token();
  control.progress = [&](double) { stop.request_stop(); };
  EXPECT_FALSE(solid.boundary(control));
}

}  // namespace
}  // namespace whittle
