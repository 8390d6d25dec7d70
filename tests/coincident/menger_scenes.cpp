// The Menger sponge, levels 1 to 3, as a cube minus bars that end flush with its faces, and as a
// union of cubes that only touch; whole, and cut along planes in which walls of its holes lie. The
// answer comes from the cells of the grid (grid.h), whose solid ones are checked against the digits
// of their coordinates in grid_test.cpp.
#include <fmt/format.h>

#include "coincident/grid.h"
#include "coincident/scenes.h"

namespace whittle {
namespace {

int cells_of(int level) {
  return level == 0 ? 1 : 3 * cells_of(level - 1);
}
int side_of(int level) {
  return cells_of(level) * sponge_cell(level);
}

std::string box(int x, int y, int z, int dx, int dy, int dz) {
  return fmt::format("translate([{}, {}, {}]) cube([{}, {}, {}]);\n", x, y, z, dx, dy, dz);
}

/// With the bars of all levels, also those that run inside larger ones.
std::string by_bars(int level) {
  const int side = side_of(level);
  std::string text = fmt::format("difference() {{\ncube({});\n", side);
  for (int i = 0; i < level; ++i) {
    const int cells = cells_of(i), width = side / (3 * cells);
    for (int a = 0; a < cells; ++a)
      for (int b = 0; b < cells; ++b) {
        const int u = (3 * a + 1) * width, v = (3 * b + 1) * width;
        text += box(u, v, 0, width, width, side) + box(0, u, v, side, width, width) +
                box(u, 0, v, width, side, width);
      }
  }
  return text + "}\n";
}

void add_cubes(std::string& text, int x, int y, int z, int side, int level) {
  if (level == 0) {
    text += box(x, y, z, side, side, side);
    return;
  }
  const int third = side / 3;
  for (int i = 0; i < 27; ++i) {
    const int a = i % 3, b = i / 3 % 3, c = i / 9;
    if ((a == 1) + (b == 1) + (c == 1) < 2)
      add_cubes(text, x + a * third, y + b * third, z + c * third, third, level - 1);
  }
}

std::string by_cubes(int level) {
  std::string text;
  add_cubes(text, 0, 0, 0, side_of(level), level);
  return text;
}

/// Looked at, besides from outside, from `eye` to `target`, in shares of its side.
CoincidentScene sponge(const std::string& name, const std::string& text, int level,
                       Vec3 eye = {0.52, 0.53, 0.51}, Vec3 target = {0.9, 0.7, 0.8}) {
  const double s = side_of(level);
  return {.name = name,
          .text = text,
          .equal = "",
          .looks = {{eye * s, target * s, 1}},
          .formula = grid_formula(text, sponge_cell(level))};
}

}  // namespace

std::vector<CoincidentScene> menger_scenes() {
  std::vector<CoincidentScene> scenes;
  for (int level = 1; level <= 3; ++level) {
    const std::string n = std::to_string(level);
    scenes.push_back(sponge("sponge_by_bars_" + n, by_bars(level), level));
    // Nearly half of it: the plane runs along walls of the smallest holes.
    const int middle = cells_of(level) / 2 * sponge_cell(level);
    scenes.push_back(sponge("half_sponge_" + n,
                            fmt::format("intersection() {{ {} halfspace(n = [0, 0, 1], d = {}); }}",
                                        by_bars(level), middle),
                            level, {0.3, 0.4, 0.9}, {0.5, 0.55, 0.3}));
    if (level < 3) scenes.push_back(sponge("sponge_by_cubes_" + n, by_cubes(level), level));
  }
  return scenes;
}

}  // namespace whittle
