// Rays that run exactly along faces, edges, axes and the planes between cells, and eyes that stand
// exactly on them. There the answer may be that of either side, and nothing else; beside them
// there is one answer.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <vector>

#include "agreement/cpu_subject.h"
#include "numbers/accuracy.h"
#include "support/read_text.h"

namespace whittle {
namespace {

constexpr uint32_t kLeafSizes[] = {1, 2, 6, 16};

/// What may be seen under a letter of a map; id 0 is nothing.
struct Sight {
  uint32_t id;
  double distance;
};
using Legend = std::map<char, std::vector<Sight>>;
using Map = std::vector<std::string>;

/// Parallel rays along `forward` through the points of a grid of whole numbers about the origin,
/// one for each letter of the map, from 20 away. Rows run against `up`, letters with `right`.
Camera grid(Vec3 right, Vec3 up, const Map& map) {
  Camera camera;
  camera.right = right;
  camera.up = up;
  camera.forward = -cross(right, up);
  camera.eye = camera.forward * -20.0;
  camera.orthographic = true;
  camera.ortho_reach = 100;
  camera.width = int(map[0].size());
  camera.height = int(map.size());
  camera.half_height = camera.height / 2.0;
  return camera;
}

void expect_map(const std::string& text, const Camera& camera, const Map& map,
                const Legend& legend) {
  const Model model = model_of(text);
  for (const uint32_t leaf_size : kLeafSizes) {
    SubdivideSettings settings;
    settings.leaf_size = leaf_size;
    CpuSubject cpu(model, settings);
    const Frame frame = cpu.tracer->render(camera, {});
    for (int y = 0; y < camera.height; ++y)
      for (int x = 0; x < camera.width; ++x) {
        const char letter = map[size_t(y)][size_t(x)];
        const Hit& hit = frame.at(x, y);
        bool allowed = false;
        for (const Sight& sight : legend.at(letter))
          allowed |= hit.id == sight.id &&
                     (hit.id == 0 || std::fabs(double(hit.distance) - sight.distance) < 1e-5);
        EXPECT_TRUE(allowed) << "leaf size " << leaf_size << ", (" << x << ", " << y << ") '"
                             << letter << "': id " << hit.id << " at " << hit.distance;
      }
    EXPECT_EQ(cpu.tracer->stats().disagreements, 0u);
  }
}

const Vec3 kAxes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

TEST(OnTheLine, RaysInTheFacesOfACubeWithAHole) {
  // The cube from -5 to 5 with a square hole from -2 to 2 along the line of sight. The middle of
  // the map lies in the planes between the cells.
  const Map map = {
      ".............",  //
      ".eeeeeeeeeee.",  //
      ".e111111111e.",  //
      ".e111111111e.",  //
      ".e11eeeee11e.",  //
      ".e11e...e11e.",  //
      ".e11e...e11e.",  //
      ".e11e...e11e.",  //
      ".e11eeeee11e.",  //
      ".e111111111e.",  //
      ".e111111111e.",  //
      ".eeeeeeeeeee.",  //
      ".............",
  };
  const Legend legend = {{'.', {{0, 0}}}, {'1', {{1, 15}}}, {'e', {{0, 0}, {1, 15}}}};
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 right = kAxes[(axis + 1) % 3], up = kAxes[(axis + 2) % 3];
    const Vec3 size = Vec3{4, 4, 4} + kAxes[axis] * 16.0;
    const std::string text = "difference() { cube(10, center = true); cube([" +
                             std::to_string(size.x) + ", " + std::to_string(size.y) + ", " +
                             std::to_string(size.z) + "], center = true); }";
    expect_map(text, grid(right, up, map), map, legend);
    expect_map(text, grid(-right, up, map), map, legend);
    expect_map(text, grid(right, -up, map), map, legend);
  }
}

TEST(OnTheLine, RaysBetweenBodiesThatTouch) {
  // Two blocks that share the face x = 0, which is also where the cells part, and a third on top of
  // both. Nothing shines through the seam.
  const std::string text =
      "translate([-5, -2, -2]) cube([5, 4, 4]); translate([0, -2, -2]) cube([5, 4, 4]);"
      "translate([-5, -2, 2]) cube([10, 4, 1]);";
  const Legend legend = {{'.', {{0, 0}}},
                         {'1', {{1, 18}}},
                         {'2', {{2, 18}}},
                         {'b', {{1, 18}, {2, 18}}},
                         {'x', {{0, 0}, {1, 18}, {3, 22}}},
                         {'y', {{0, 0}, {2, 18}, {3, 22}}},
                         {'z', {{0, 0}, {1, 18}, {2, 18}, {3, 22}}},
                         {'t', {{0, 0}, {3, 18}}},
                         {'p', {{0, 0}, {1, 18}, {3, 18}}},
                         {'q', {{0, 0}, {2, 18}, {3, 18}}},
                         {'l', {{1, 18}, {3, 18}}},
                         {'m', {{1, 18}, {2, 18}, {3, 18}}},
                         {'r', {{2, 18}, {3, 18}}}};
  const Map from_below = {
      ".............",  //
      ".xxxxxzyyyyy.",  //
      ".x1111b2222y.",  //
      ".x1111b2222y.",  //
      ".x1111b2222y.",  //
      ".xxxxxzyyyyy.",  //
      ".............",
  };
  expect_map(text, grid(kAxes[0], -kAxes[1], from_below), from_below, legend);
  const Map from_the_front = {
      ".............",  //
      ".ttttttttttt.",  //
      ".pllllmrrrrq.",  //
      ".x1111b2222y.",  //
      ".x1111b2222y.",  //
      ".x1111b2222y.",  //
      ".xxxxxzyyyyy.",  //
      ".............",  //
      ".............",
  };
  expect_map(text, grid(kAxes[0], kAxes[2], from_the_front), from_the_front, legend);
}

TEST(OnTheLine, RaysInTheWallOfACylinder) {
  // Radius 5: (3, 4), (4, 3) and (5, 0) are points of the wall.
  const std::string text = "cylinder(h = 4, r = 5, center = true);";
  const Map map = {
      ".............",  //
      "......e......",  //
      "...e11111e...",  //
      "..e1111111e..",  //
      "..111111111..",  //
      "..111111111..",  //
      ".e111111111e.",  //
      "..111111111..",  //
      "..111111111..",  //
      "..e1111111e..",  //
      "...e11111e...",  //
      "......e......",  //
      ".............",
  };
  const Legend legend = {{'.', {{0, 0}}}, {'1', {{1, 18}}}, {'e', {{0, 0}, {1, 18}}}};
  expect_map(text, grid(kAxes[0], kAxes[1], map), map, legend);
  expect_map(text, grid(kAxes[1], -kAxes[0], map), map, legend);
  // The hole that such a cylinder leaves shows the same rays from the other side.
  Map hole = map;
  for (std::string& row : hole)
    for (char& letter : row) letter = letter == '.' ? '1' : letter == '1' ? '.' : letter;
  expect_map(
      "difference() { cube([20, 20, 4], center = true);"
      " cylinder(h = 9, r = 5, center = true); }",
      grid(kAxes[0], kAxes[1], map), hole, legend);
}

TEST(OnTheLine, RaysThroughTheEdgesAndTheTipOfAnOctahedron) {
  const std::string text =
      "polyhedron(points = [[4,0,0],[0,4,0],[-4,0,0],[0,-4,0],[0,0,4],[0,0,-4]],"
      " faces = [[4,1,0],[4,2,1],[4,3,2],[4,0,3],[5,0,1],[5,1,2],[5,2,3],[5,3,0]]);";
  const Map map = {
      ".....e.....",  //
      "....e1e....",  //
      "...e121e...",  //
      "..e12321e..",  //
      ".e1234321e.",  //
      "..e12321e..",  //
      "...e121e...",  //
      "....e1e....",  //
      ".....e.....",
  };
  const Legend legend = {{'.', {{0, 0}}},  {'e', {{0, 0}, {1, 20}}}, {'1', {{1, 19}}},
                         {'2', {{1, 18}}}, {'3', {{1, 17}}},         {'4', {{1, 16}}}};
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 right = kAxes[(axis + 1) % 3], up = kAxes[(axis + 2) % 3];
    expect_map(text, grid(right, up, map), map, legend);
    expect_map(text, grid(-up, right, map), map, legend);
  }
}

TEST(OnTheLine, AnEyeInThePlaneOfAFaceOrBetweenCells) {
  const std::string text =
      "difference() { cube(10, center = true); cube([20, 4, 4], center = true); }";
  const Answer answer = [](const ExactRay& ray) {
    return seen_of_difference(
        ray, {box(1, ray, {-5, -5, -5}, {5, 5, 5}), box(2, ray, {-10, -2, -2}, {10, 2, 2})});
  };
  // Odd sizes: the middle column and row run in the plane itself.
  for (const Vec3 eye : {Vec3{-20, 5, 5}, Vec3{-20, 5, 1}, Vec3{-20, 2, 2}, Vec3{-20, 0, 0},
                         Vec3{0, -20, 0}, Vec3{0, -20, 5}, Vec3{-20, -2, 0.5}}) {
    SCOPED_TRACE(testing::Message() << eye.x << ", " << eye.y << ", " << eye.z);
    for (const Vec3 ahead : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{1, 0.25, 0}}) {
      const PictureCounts counts = expect_known(text, look(eye, eye + ahead, 60, 65, 49), answer);
      EXPECT_LE(counts.undecided, 2 * (65 + 49));
    }
  }
  // In the hollow, where all cells meet, and in the material.
  for (const Vec3 eye : {Vec3{0, 0, 0}, Vec3{0, 3, 0}, Vec3{0, 0, 4}})
    for (const Vec3 ahead : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 1, 1}})
      expect_known(text, look(eye, eye + ahead, 90, 65, 49), answer);
}

/// An eye on the surface itself does not see what it stands on, only what lies beyond. The oracle
/// makes no such promise.
Answer beyond_the_eye(const Answer& answer) {
  return [answer](ExactRay ray) {
    ray.t_min = 1e-12L;
    return answer(ray);
  };
}

TEST(OnTheLine, AnEyeOnAFaceAnEdgeOrACorner) {
  const std::string text = "cube(10, center = true); translate([0, 0, 12]) sphere(3);";
  const Answer answer = beyond_the_eye([](const ExactRay& ray) {
    return seen_of_union(ray,
                         {box(1, ray, {-5, -5, -5}, {5, 5, 5}), sphere(2, ray, {0, 0, 12}, 3)});
  });
  for (const Vec3 eye : {Vec3{0, 0, 5}, Vec3{1, 2, 5}, Vec3{5, 1.25, 0.5}, Vec3{-5, 0, 0},
                         Vec3{5, 5, 0}, Vec3{5, 5, 5}, Vec3{0, 0, 9}, Vec3{0, 3, 12}}) {
    SCOPED_TRACE(testing::Message() << eye.x << ", " << eye.y << ", " << eye.z);
    for (const Vec3 ahead :
         {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{1, 0.5, 0.25}, Vec3{-1, 0.3, 1}, Vec3{0, 1, 0}})
      expect_known(text, look(eye, eye + ahead, 90, 64, 48), answer);
  }
}

TEST(OnTheLine, AnEyeOnACurvedSurface) {
  const std::string text = "sphere(5); translate([20, 0, 0]) cylinder(h = 4, r1 = 2, r2 = 0);";
  const Answer answer = beyond_the_eye([](const ExactRay& ray) {
    return seen_of_union(ray, {sphere(1, ray, {}, 5), cone(2, ray, {20, 0, 0}, 2, 4)});
  });
  for (const Vec3 eye :
       {Vec3{5, 0, 0}, Vec3{3, 4, 0}, Vec3{0, -3, 4}, Vec3{20, 0, 4}, Vec3{21, 0, 2},
        Vec3{20, -2, 0}, Vec3{20 + 0x1p-10, 0, 4 - 0x1p-9}, Vec3{20, -0x1p-20, 4 - 0x1p-19}}) {
    SCOPED_TRACE(testing::Message() << eye.x << ", " << eye.y << ", " << eye.z);
    for (const Vec3 ahead : {Vec3{3, 4, 0.5}, Vec3{-3, -4, -0.5}, Vec3{1, 0, 0}, Vec3{0, 1, -1}})
      expect_known(text, look(eye, eye + ahead, 90, 64, 48), answer);
  }
}

}  // namespace
}  // namespace whittle
