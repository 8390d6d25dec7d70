#include "image/draw_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "lower/lower.h"
#include "subdivide/subdivide.h"
#include "support/read_text.h"
#include "trace/view.h"

namespace whittle {
namespace {

struct CutUp {
  Scene scene;
  CellTree cells;

  CutUp(const char* text, uint32_t leaf_size) : scene(*lower(model_of(text))) {
    SubdivideSettings settings;
    settings.leaf_size = leaf_size;
    cells = subdivide(scene, settings);
  }
  /// The boxes of the cells with a surface in them, in the world.
  std::vector<Box> boxes() const {
    std::vector<Box> found;
    for_each_leaf(cells, [&](CellLink link, const Box& box) {
      if (link.kind() != CellKind::kEmpty && link.kind() != CellKind::kFull)
        found.push_back({box.lo + scene.origin, box.hi + scene.origin});
    });
    return found;
  }
  /// Over white, with a frame in which everything is that far away.
  Picture picture(const Camera& camera, CellView view,
                  float distance = std::numeric_limits<float>::infinity()) const {
    Frame frame(camera.width, camera.height);
    for (Hit& hit : frame.hits) hit.distance = distance;
    Picture picture(camera.width, camera.height);
    std::fill(picture.rgba.begin(), picture.rgba.end(), uint8_t(255));
    draw_cells(cells, scene.origin, camera, frame, view, picture);
    return picture;
  }
};

Camera cells_camera(bool orthographic) {
  ViewOptions options;
  options.orthographic = orthographic;
  options.width = 150, options.height = 120;
  return make_camera(options, {}, Box{{-8, -8, -8}, {8, 8, 8}});
}

std::tuple<int, int, int> pixel_of(const Picture& p, int x, int y) {
  return {p.at(x, y)[0], p.at(x, y)[1], p.at(x, y)[2]};
}
constexpr std::tuple<int, int, int> kWhitePixel{255, 255, 255};

/// How far a ray passes from a segment.
double gap(const Ray& ray, Vec3 from, Vec3 to) {
  // Between two lines; where that is beyond an end, the end counts.
  const Vec3 way = to - from, d = ray.direction, between = from - ray.origin;
  const double a = dot(way, way), b = dot(way, d), e = dot(way, between), f = dot(d, between);
  const double t = std::clamp((b * f - e) / (a - b * b), 0.0, 1.0);
  const Vec3 p = between + way * t;
  return length(p - d * dot(p, d));
}

TEST(DrawCells, InkIsWhereRaysPassEdgesAndNowhereElse) {
  const CutUp ball("sphere(5);", 1);
  ASSERT_EQ(ball.boxes().size(), 1u);
  const Box box = ball.boxes()[0];
  for (const bool orthographic : {false, true}) {
    const Camera camera = cells_camera(orthographic);
    const Picture picture = ball.picture(camera, CellView::kEdges);
    // Of a pixel where the box is.
    const double away = orthographic ? 1 : length(box.center() - camera.eye);
    const double width = camera.units_per_pixel() * away;
    int inked = 0;
    for (int y = 0; y < camera.height; ++y) {
      for (int x = 0; x < camera.width; ++x) {
        double least = 1e9;
        for (int corner = 0; corner < 8; ++corner)
          for (int axis = 0; axis < 3; ++axis)
            if ((corner >> axis & 1) == 0)
              least = std::min(least, gap(camera.ray(x + 0.5, y + 0.5), box.corner(corner),
                                          box.corner(corner | 1 << axis)));
        const auto pixel = pixel_of(picture, x, y);
        if (least < 0.04 * width) {
          const Rgb8 ink = cell_color(CellKind::kConjunction);
          EXPECT_EQ(pixel, std::tuple(ink.r, ink.g, ink.b)) << x << ", " << y;
          ++inked;
        }
        if (least > 1.4 * width) {
          EXPECT_EQ(pixel, kWhitePixel) << x << ", " << y;
        }
      }
    }
    EXPECT_GT(inked, 20);
  }
}

TEST(DrawCells, CellsWithoutASurfaceAreNotDrawn) {
  const CutUp nothing("difference() { cube(10, center = true); cube(20, center = true); }", 1);
  EXPECT_TRUE(nothing.boxes().empty());
  const Picture picture = nothing.picture(cells_camera(false), CellView::kFaces);
  for (const uint8_t byte : picture.rgba) ASSERT_EQ(byte, 255);
}

TEST(DrawCells, WhatStandsInFrontHidesEdges) {
  const CutUp ball("sphere(5);", 1);
  const Camera camera = cells_camera(false);
  const Picture hidden = ball.picture(camera, CellView::kEdges, 1.0f);
  for (const uint8_t byte : hidden.rgba) ASSERT_EQ(byte, 255);
}

/// Whether a ray passes any edge by less than a line's reach.
bool is_near_an_edge(const Camera& camera, const Ray& ray, const std::vector<Box>& boxes) {
  for (const Box& box : boxes) {
    for (int corner = 0; corner < 8; ++corner) {
      const double away = camera.orthographic ? 1 : length(box.corner(corner) - camera.eye);
      const double reach = 3 * camera.units_per_pixel() * away;
      for (int axis = 0; axis < 3; ++axis)
        if (gap(ray, box.corner(corner), box.corner(corner ^ 1 << axis)) < reach) return true;
    }
  }
  return false;
}

/// The nearest box that a ray enters from outside, found corner by corner of the definition: the
/// point of the face is in the box, and the ray comes from the face's outer side.
std::pair<const Box*, int> nearest_face(const Ray& ray, const std::vector<Box>& boxes) {
  double nearest = kInfinity;
  std::pair<const Box*, int> found{nullptr, 0};
  for (const Box& box : boxes) {
    for (int axis = 0; axis < 3; ++axis) {
      const double direction = ray.direction[axis];
      if (direction == 0) continue;
      const double t =
          ((direction > 0 ? box.lo[axis] : box.hi[axis]) - ray.origin[axis]) / direction;
      Vec3 p = ray.origin + ray.direction * t;
      p[axis] = box.lo[axis];
      if (t > ray.t_min && t < nearest && box.contains(p)) nearest = t, found = {&box, axis};
    }
  }
  return found;
}

TEST(DrawCells, FacesAreThoseOfTheNearestBoxesThatRaysEnter) {
  const CutUp balls("sphere(3); translate([6,-5,0]) sphere(3); translate([-5,4,3]) sphere(2);", 1);
  const std::vector<Box> boxes = balls.boxes();
  ASSERT_GE(boxes.size(), 3u);
  ASSERT_LE(boxes.size(), 30u) << "the test would take too long";
  Camera inside = cells_camera(false);
  inside.eye = boxes[0].center();
  std::set<std::tuple<int, int, int>> colors[3];
  for (const Camera& camera : {cells_camera(false), cells_camera(true), inside}) {
    const Picture picture = balls.picture(camera, CellView::kFaces);
    for (int y = 0; y < camera.height; ++y) {
      for (int x = 0; x < camera.width; ++x) {
        const Ray ray = camera.ray(x + 0.5, y + 0.5);
        const auto [box, axis] = nearest_face(ray, boxes);
        if (is_near_an_edge(camera, ray, boxes)) continue;
        if (box == nullptr) {
          EXPECT_EQ(pixel_of(picture, x, y), kWhitePixel) << x << ", " << y;
        } else {
          colors[axis].insert(pixel_of(picture, x, y));
        }
      }
    }
  }
  std::set<std::tuple<int, int, int>> all{kWhitePixel};
  for (const auto& of_axis : colors) {
    EXPECT_EQ(of_axis.size(), 1u) << "all are conjunctions, so faces of an axis look alike";
    all.insert(of_axis.begin(), of_axis.end());
  }
  EXPECT_EQ(all.size(), 4u) << "and no others do";
}

}  // namespace
}  // namespace whittle
