// Several views of one solid on a sheet, as a drawing in first- or third-angle projection has them
// (ISO 128-3): all at one scale, so that the same feature is in one row or column of them, with the
// dimensions of the solid's box (ISO 129-1).
#pragma once

#include <string>
#include <vector>

#include "base/box.h"
#include "base/result.h"
#include "sheet/stroke_font.h"
#include "trace/camera.h"
#include "trace/named_view.h"

namespace whittle {

enum class ProjectionAngle {
  kFirst,  ///< the view from above is drawn below the one from the front, as in Europe
  kThird,  ///< above it, as in America
};

struct SheetSettings {
  std::vector<NamedView> views;  ///< one or more, each once
  ProjectionAngle angle = ProjectionAngle::kThird;
  std::string title;
};

struct SheetView {
  NamedView view = NamedView::kFront;
  Vec2 corner, size;  ///< of its place on the sheet; the middle of the box is in its middle
  Vec2 drawn;         ///< width and height of the box as it is seen; no more than `size`

  Vec2 middle() const { return corner + size * 0.5; }
};

/// Lengths are pixels or millimetres; x runs to the right and y down.
struct Sheet {
  Vec2 size;
  double scale = 1;  ///< of them for one unit of the model
  std::vector<SheetView> views;
  std::vector<Stroke> lines;  ///< dimensions and words
};

/// A sheet of that many pixels, with the largest scale that fits. Places of views are whole pixels.
/// A kUsage error if nothing of the solid would be seen. Preconditions here and below: the box is
/// finite and not empty.
Result<Sheet> sheet_of_pixels(const SheetSettings& settings, const Box& box, int width, int height);

/// A sheet to scale, in millimetres, as large as is needed.
Sheet sheet_to_scale(const SheetSettings& settings, const Box& box, double scale);

/// The orthographic camera of a view, which looks at the middle of the box. `width` and `height`
/// are its picture's, and `scale` pixels are one unit of the model.
Camera sheet_camera(NamedView view, const Box& box, double scale, int width, int height);

/// A length as it stands in a drawing: to five digits of the longest.
std::string length_text(double length, double longest);

}  // namespace whittle
