// A solid as a drawing in lines: its contours, its edges and where its surfaces meet, as far as
// they are seen.
//
// Based on: Appel, "The notion of quantitative invisibility and the machine rendering of solids",
// 1967: along an edge of a solid visibility changes only where a contour runs before it. What we
// changed: whether a part between two such places is seen is asked of one ray.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "base/result.h"
#include "base/vec.h"
#include "base/workers.h"
#include "model/model.h"
#include "trace/camera.h"
#include "trace/tracer.h"

namespace whittle {

enum class LineKind {
  kSilhouette,  ///< the solid looks to the eye on one side and away on the other
  kEdge,        ///< it looks to the eye on both sides
  kHidden,      ///< of both kinds
  kDimension,   ///< no line of the solid: says how large it is, or is a word
};

struct DrawnPath {
  LineKind kind = LineKind::kEdge;
  bool is_closed = false;  ///< the last point is joined to the first
  std::vector<Vec2> points;
};

struct LineDrawing {
  bool is_to_scale = false;      ///< units are millimetres, else pixels
  Vec2 corner, size;             ///< of the sheet; in pixels the picture's
  std::vector<DrawnPath> paths;  ///< by kind
};

struct LineSettings {
  bool hidden = false;  ///< hidden lines are drawn, too
  double scale = 1;     ///< of an orthographic drawing: millimetres for one unit of the model
  size_t most_facets = 4'000'000;
};

struct LineStats {
  size_t facets = 0;  ///< triangles of the solid that was looked at
  size_t edges = 0, parts = 0, paths = 0, points = 0;
  double solid_ms = 0, edges_ms = 0, split_ms = 0, look_ms = 0, join_ms = 0;
};

/// Told of the stages, by names that live forever.
using LineStage = std::function<void(const char*)>;

/// Seen from an orthographic camera, a drawing to scale of all of the solid; from any other the
/// lines of the camera's picture. True curves are drawn right to a tenth of a pixel, or a fortieth
/// of a millimetre. The same whatever the number of threads. A kInput error if the solid has no
/// end; one of kMachine if there is too much of it. Precondition: the model is no drawing itself.
Result<LineDrawing> draw_lines(const Model& model, const Camera& camera,
                               const LineSettings& settings, int threads,
                               LineStats* stats = nullptr, const LineStage& stage = {},
                               const Progress& progress = {});

}  // namespace whittle
