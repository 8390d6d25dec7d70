#include <algorithm>
#include <cmath>

#include "mesh/decode_png.h"
#include "mesh/formats.h"
#include "mesh/mesh_files.h"
#include "mesh/text_scanner.h"

namespace whittle {
namespace {

/// Rows from y = 0 up, each from x = 0.
struct Heights {
  size_t columns = 0, rows = 0;
  std::vector<double> values;
  double lowest = 1;  ///< of the values and of 1
  double at(size_t x, size_t y) const { return values[y * columns + x]; }
};

/// A row a line. What short rows lack is 0.
Result<Heights> read_text(std::string_view content, size_t most_values) {
  std::vector<std::vector<double>> rows;
  Heights heights;
  size_t values = 0;
  TextScanner scanner(content);
  while (!scanner.is_at_end()) {
    const std::string_view line = scanner.line();
    TextScanner words(line);
    std::vector<double> row;
    for (std::string_view word = words.word(); !word.empty(); word = words.word()) {
      if (row.empty() && word.starts_with('#')) break;
      const auto value = TextScanner::as_number<double>(word);
      if (!value || !(std::fabs(*value) <= kFarthest))
        return mesh_error("a height is not a number");
      row.push_back(*value);
      heights.lowest = std::min(heights.lowest, *value);
    }
    if (row.empty()) continue;
    values += row.size();
    heights.columns = std::max(heights.columns, row.size());
    rows.push_back(std::move(row));
    if (values > most_values || heights.columns * rows.size() > most_values)
      return too_many_triangles(4 * most_values);
  }
  heights.rows = rows.size();
  heights.values.resize(heights.columns * heights.rows, 0);
  for (size_t y = 0; y < rows.size(); ++y)
    std::copy(rows[y].begin(), rows[y].end(),
              heights.values.begin() + std::ptrdiff_t(y * heights.columns));
  return heights;
}

/// The brightness in percent; the bottom row of the picture is y = 0.
Result<Heights> read_png(std::string_view content, bool invert, size_t most_values) {
  const Result<PngPixels> pixels = decode_png(content, most_values);
  if (!pixels) return pixels.error();
  Heights heights{pixels->width, pixels->height, {}, 1};
  heights.values.reserve(heights.columns * heights.rows);
  for (size_t y = heights.rows; y-- > 0;)
    for (size_t x = 0; x < heights.columns; ++x) {
      const uint8_t* const rgb = &pixels->rgb[3 * (y * heights.columns + x)];
      const double luma = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
      // Of bytes, as OpenSCAD turns them over; not 255 less.
      const double height = (invert ? 1 - luma : luma) * 100 / 255;
      heights.values.push_back(height);
      heights.lowest = std::min(heights.lowest, height);
    }
  return heights;
}

/// Four triangles for each square of four heights, about their mean in its middle; four walls and a
/// bottom, one below the lowest height and never above 0.
RawMesh make_mesh(const Heights& heights, bool center) {
  RawMesh mesh;
  const size_t nx = heights.columns, ny = heights.rows;
  if (nx < 2 || ny < 2) return mesh;
  const double left = center ? -double(nx - 1) / 2 : 0, front = center ? -double(ny - 1) / 2 : 0;
  const double bottom = heights.lowest - 1;
  mesh.points.reserve(2 * nx * ny + 2 * (nx + ny));
  mesh.triangles.reserve(4 * nx * ny + 4 * (nx + ny));
  for (size_t y = 0; y < ny; ++y)
    for (size_t x = 0; x < nx; ++x)
      mesh.points.push_back({left + double(x), front + double(y), heights.at(x, y)});
  const auto corner = [&](size_t x, size_t y) { return uint32_t(y * nx + x); };
  for (size_t y = 0; y + 1 < ny; ++y)
    for (size_t x = 0; x + 1 < nx; ++x) {
      const uint32_t a = corner(x, y), b = corner(x + 1, y), c = corner(x + 1, y + 1),
                     d = corner(x, y + 1), middle = uint32_t(mesh.points.size());
      const double mean = (heights.at(x, y) + heights.at(x + 1, y) + heights.at(x, y + 1) +
                           heights.at(x + 1, y + 1)) /
                          4;
      mesh.points.push_back({left + double(x) + 0.5, front + double(y) + 0.5, mean});
      mesh.triangles.insert(mesh.triangles.end(),
                            {{a, b, middle}, {b, c, middle}, {c, d, middle}, {d, a, middle}});
    }
  // Once around, counter-clockwise seen from above.
  std::vector<uint32_t> rim;
  for (size_t x = 0; x + 1 < nx; ++x) rim.push_back(corner(x, 0));
  for (size_t y = 0; y + 1 < ny; ++y) rim.push_back(corner(nx - 1, y));
  for (size_t x = nx - 1; x > 0; --x) rim.push_back(corner(x, ny - 1));
  for (size_t y = ny - 1; y > 0; --y) rim.push_back(corner(0, y));
  const auto below = uint32_t(mesh.points.size()), n = uint32_t(rim.size());
  for (const uint32_t top : rim)
    mesh.points.push_back({mesh.points[top].x, mesh.points[top].y, bottom});
  const uint32_t middle = uint32_t(mesh.points.size());
  mesh.points.push_back({left + double(nx - 1) / 2, front + double(ny - 1) / 2, bottom});
  for (uint32_t k = 0; k < n; ++k) {
    const uint32_t next = (k + 1) % n;
    mesh.triangles.insert(mesh.triangles.end(), {{rim[k], below + k, below + next},
                                                 {rim[k], below + next, rim[next]},
                                                 {middle, below + next, below + k}});
  }
  mesh.is_closed = true;
  return mesh;
}

}  // namespace

Result<RawMesh> read_height_map(std::string_view content, const HeightMap& how,
                                size_t most_triangles) {
  const bool is_png = content.starts_with("\x89PNG");
  const Result<Heights> heights = is_png ? read_png(content, how.invert, most_triangles / 4)
                                         : read_text(content, most_triangles / 4);
  if (!heights) return heights.error();
  return make_mesh(*heights, how.center);
}

}  // namespace whittle
