#include "coincident/grid.h"

#include <cmath>
#include <map>
#include <tuple>

#include "model/instances.h"
#include "support/read_text.h"

namespace whittle {
namespace {

struct Cell {
  int x = 0, y = 0, z = 0;
  auto operator<=>(const Cell&) const = default;
  Vec3 center() const { return {x + 0.5, y + 0.5, z + 0.5}; }
  int& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  int operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
};

class Grid {
 public:
  Grid(const std::string& text, double cell)
      : cell_(cell), model_(model_of(text)), boxes_(model_.nodes.size()) {
    for (const Instance& instance : instances(model_)) {
      const Box box = instance_box(model_, instance);
      boxes_[instance.node] = {box.lo / cell, box.hi / cell};
    }
    Box box = bounds(model_).box;
    box = box.is_empty() ? Box{{}, {}} : Box{box.lo / cell, box.hi / cell};
    for (int axis = 0; axis < 3; ++axis) {
      low_[axis] = int(std::lround(box.lo[axis])) - 1;
      size_[axis] = int(std::lround(box.hi[axis])) + 1 - low_[axis];
    }
    solid_.resize(size_t(size_[0]) * size_t(size_[1]) * size_t(size_[2]));
    for (int z = 0; z < size_[2]; ++z)
      for (int y = 0; y < size_[1]; ++y)
        for (int x = 0; x < size_[0]; ++x)
          solid_[index({x + low_[0], y + low_[1], z + low_[2]})] =
              values({x + low_[0], y + low_[1], z + low_[2]})[0];
  }

  Hit trace(const Ray& world_ray) {
    const Ray ray{world_ray.origin / cell_, world_ray.direction, world_ray.t_min / cell_};
    // From the ray's start, or from outside the grid if that is nearer to it.
    double t = ray.t_min, end = kInfinity;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = (low_[axis] + 0.5 - ray.origin[axis]) / ray.direction[axis];
      const double b = (low_[axis] + size_[axis] - 0.5 - ray.origin[axis]) / ray.direction[axis];
      t = std::max(t, std::min(a, b));
      end = std::min(end, std::max(a, b));
    }
    if (t >= end) return {};
    const Vec3 start = ray.origin + ray.direction * t;
    Cell cell;
    double next[3];
    for (int axis = 0; axis < 3; ++axis) {
      cell[axis] = int(std::floor(start[axis]));
      next[axis] =
          (cell[axis] + (ray.direction[axis] > 0) - ray.origin[axis]) / ray.direction[axis];
    }
    for (;;) {
      const int axis =
          next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
      if (next[axis] >= end) return {};
      const int step = ray.direction[axis] > 0 ? 1 : -1;
      Cell ahead = cell;
      ahead[axis] += step;
      const bool solid = solid_[index(cell)], solid_ahead = solid_[index(ahead)];
      if (solid != solid_ahead) {
        Vec3f n;
        (axis == 0 ? n.x : axis == 1 ? n.y : n.z) = float(solid ? step : -step);
        return {float(next[axis] * cell_), owner(cell, ahead), n};
      }
      cell = ahead;
      next[axis] += 1 / std::fabs(ray.direction[axis]);
    }
  }

 private:
  size_t index(Cell c) const {
    return (size_t(c.z - low_[2]) * size_t(size_[1]) + size_t(c.y - low_[1])) * size_t(size_[0]) +
           size_t(c.x - low_[0]);
  }

  /// Of every node, in one cell.
  std::vector<bool> values(Cell cell) const {
    const Vec3 p = cell.center();
    std::vector<bool> value(model_.nodes.size());
    for (size_t i = model_.nodes.size(); i-- > 0;) {
      const Node& node = model_.nodes[i];
      if (node.kind == NodeKind::kPrimitive) {
        const Box& b = boxes_[i];
        value[i] = p.x > b.lo.x && p.x < b.hi.x && p.y > b.lo.y && p.y < b.hi.y && p.z > b.lo.z &&
                   p.z < b.hi.z;
        continue;
      }
      bool first = true, any = false, all = true, first_alone = false;
      for (uint32_t child = uint32_t(i) + 1; child < node.end; child = model_.nodes[child].end) {
        if (first) first_alone = value[child];
        if (!first && value[child]) first_alone = false;
        any = any || value[child];
        all = all && value[child];
        first = false;
      }
      value[i] = node.kind == NodeKind::kDifference     ? first_alone
                 : node.kind == NodeKind::kIntersection ? all && !first
                                                        : any;
    }
    return value;
  }

  uint32_t owner(Cell from, Cell to) {
    const auto [entry, fresh] = owners_.try_emplace({from, to}, 0);
    if (!fresh) return entry->second;
    const std::vector<bool> before = values(from), after = values(to);
    uint32_t i = 0;
    while (model_.nodes[i].kind != NodeKind::kPrimitive) {
      ++i;
      while (before[i] == after[i]) i = model_.nodes[i].end;
    }
    return entry->second = model_.primitives[model_.nodes[i].payload].id;
  }

  double cell_;
  Model model_;
  std::vector<Box> boxes_;  ///< of the nodes that are primitives
  int low_[3], size_[3];    ///< cells of the bounds and one layer around them
  std::vector<uint8_t> solid_;
  std::map<std::pair<Cell, Cell>, uint32_t> owners_;
};

}  // namespace

RayFormula grid_formula(const std::string& text, double cell) {
  // Filled when it is first asked: many scenes are named, and few looked at, by one test program.
  return
      [text, cell, grid = std::shared_ptr<Grid>()](const Ray& ray) mutable -> std::optional<Hit> {
        if (!grid) grid = std::make_shared<Grid>(text, cell);
        return grid->trace(ray);
      };
}

}  // namespace whittle
