// Line drawings of texts, and measures of them.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "lines/line_drawing.h"
#include "support/read_text.h"
#include "trace/view_for_test.h"

namespace whittle {

/// Seven numbers as view_of() has them, and a square picture.
inline Camera camera_of(const CameraNumbers& numbers, int side, bool orthographic = false) {
  ViewOptions view;
  view.width = view.height = side;
  view.orthographic = orthographic;
  return make_camera(view_of(numbers, view), {}, {});
}

inline Camera orthographic_camera(Vec3 degrees) {
  return camera_of({0, 0, 0, degrees.x, degrees.y, degrees.z, 100}, 512, true);
}

inline LineDrawing drawing_of(const Model& model, const Camera& camera,
                              const LineSettings& settings = {}, int threads = 2) {
  const Result<LineDrawing> drawing = draw_lines(model, camera, settings, threads);
  EXPECT_TRUE(drawing) << (drawing ? "" : drawing.error().message);
  return drawing ? *drawing : LineDrawing{};
}

/// The length of all paths of a kind, in the drawing's units.
inline double length_of(const LineDrawing& drawing, LineKind kind) {
  double sum = 0;
  for (const DrawnPath& path : drawing.paths) {
    if (path.kind != kind) continue;
    for (size_t i = 0; i + 1 < path.points.size(); ++i)
      sum += length(path.points[i + 1] - path.points[i]);
    if (path.is_closed) sum += length(path.points.front() - path.points.back());
  }
  return sum;
}

inline std::vector<DrawnPath> paths_of(const LineDrawing& drawing, LineKind kind) {
  std::vector<DrawnPath> paths;
  for (const DrawnPath& path : drawing.paths)
    if (path.kind == kind) paths.push_back(path);
  return paths;
}

}  // namespace whittle
