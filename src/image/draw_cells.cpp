#include "image/draw_cells.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/result.h"
#include "image/line_layer.h"
#include "trace/pixel_rect.h"

namespace whittle {
namespace {

/// Boxes that look smaller than this, pixels, have fainter lines, but no fainter than that.
constexpr double kFullSize = 24, kLeastStrength = 0.25;
constexpr float kFaceStrength = 0.5f;
/// How bright the faces square to x, y and z are, so that a box looks like one.
constexpr Vec3f kFaceBrightness{0.82f, 0.66f, 1.0f};
constexpr float kEdgeOfFaceBrightness = 0.45f;

bool is_drawn(CellKind kind) {
  return is_leaf(kind) || kind == CellKind::kIgnored;
}

/// Calls visit(box in the world, kind).
template <class Visit>
void for_each_drawn(const CellTree& cells, Vec3 origin, const Visit& visit) {
  for_each_leaf(cells, [&](CellLink link, const Box& box) {
    if (is_drawn(link.kind())) visit(Box{box.lo + origin, box.hi + origin}, link.kind());
  });
}

/// Where a ray enters a box, and through the face of which axis; kInfinity if it does not, or
/// starts inside.
std::pair<double, int> entry(const Ray& ray, const Box& box) {
  double enter = -kInfinity, leave = kInfinity;
  int axis = 0;
  for (int k = 0; k < 3; ++k) {
    const double inverse = 1 / ray.direction[k];
    double near = (box.lo[k] - ray.origin[k]) * inverse;
    double far = (box.hi[k] - ray.origin[k]) * inverse;
    if (inverse < 0) std::swap(near, far);
    if (near > enter) enter = near, axis = k;
    leave = std::min(leave, far);
  }
  return {enter <= leave && enter > ray.t_min ? enter : kInfinity, axis};
}

/// The nearest front face of any box, a pixel each.
struct Faces {
  std::vector<double> distances;
  std::vector<Ink> inks;
};

Faces front_faces(const CellTree& cells, Vec3 origin, const Camera& camera) {
  const size_t pixels = size_t(camera.width) * size_t(camera.height);
  Faces faces{std::vector<double>(pixels, kInfinity), std::vector<Ink>(pixels)};
  for_each_drawn(cells, origin, [&](const Box& box, CellKind kind) {
    const Vec3f color = to_unit(cell_color(kind));
    const PixelRect rect = pixels_covering(camera, box);
    for (int y = rect.y0; y < rect.y1; ++y) {
      for (int x = rect.x0; x < rect.x1; ++x) {
        const auto [distance, axis] = entry(camera.ray(x + 0.5, y + 0.5), box);
        const size_t i = size_t(y) * size_t(camera.width) + size_t(x);
        if (!(distance < faces.distances[i])) continue;
        faces.distances[i] = distance;
        faces.inks[i] = {color * kFaceBrightness[axis], kFaceStrength};
      }
    }
  });
  return faces;
}

/// How strong the lines of a cell are, by how large it looks. What was ignored is always small.
float line_strength(const Camera& camera, const Box& box, CellKind kind) {
  if (kind == CellKind::kIgnored) return 1;
  const double away = camera.orthographic ? 1 : length(box.center() - camera.eye);
  const double pixels = box.diagonal() / (away * camera.units_per_pixel());
  return float(std::clamp(pixels / kFullSize, kLeastStrength, 1.0));
}

void draw_edges(LineLayer& lines, const Box& box, const Ink& ink) {
  for (int corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      if ((corner >> axis & 1) == 0)
        lines.draw(box.corner(corner), box.corner(corner | 1 << axis), ink);
    }
  }
}

}  // namespace

Rgb8 cell_color(CellKind kind) {
  WHITTLE_CHECK(is_drawn(kind));
  switch (kind) {
    case CellKind::kConjunction:
      return {38, 98, 190};
    case CellKind::kDisjunction:
      return {30, 140, 75};
    case CellKind::kTable:
      return {222, 120, 20};
    case CellKind::kProgram:
      return {140, 60, 170};
    default:
      return {210, 30, 40};
  }
}

void draw_cells(const CellTree& cells, Vec3 origin, const Camera& camera, const Frame& frame,
                CellView view, Picture& picture) {
  WHITTLE_CHECK(frame.width == camera.width && frame.height == camera.height);
  WHITTLE_CHECK(picture.width == camera.width && picture.height == camera.height);
  std::vector<double> occluders;
  if (view == CellView::kFaces) {
    Faces faces = front_faces(cells, origin, camera);
    lay_over(faces.inks, picture);
    occluders = std::move(faces.distances);
  } else {
    for (const Hit& hit : frame.hits) occluders.push_back(double(hit.distance));
  }
  const float brightness = view == CellView::kFaces ? kEdgeOfFaceBrightness : 1;
  LineLayer lines(camera, occluders);
  for_each_drawn(cells, origin, [&](const Box& box, CellKind kind) {
    draw_edges(lines, box,
               {to_unit(cell_color(kind)) * brightness, line_strength(camera, box, kind)});
  });
  lay_over(lines.inks(), picture);
}

}  // namespace whittle
