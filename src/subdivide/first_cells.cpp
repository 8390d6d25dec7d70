#include "subdivide/first_cells.h"

#include "subdivide/formula_size.h"

namespace whittle {
namespace {

/// Formulas of no more literals than this are looked at as a union of polytopes.
constexpr uint32_t kFewLiterals = 32;
constexpr double kSplitShare = 0.483;

/// With fewer tokens a cell is no work worth sharing.
constexpr size_t kManyTokens = 4096;
/// Farther down the searches go different ways.
constexpr size_t kLevels = 3;

bool is_worth_sharing(const FirstCells::Cell& cell) {
  return cell.truth == Truth::kVaries && cell.formula.size() >= kManyTokens && is_large(cell.size);
}

}  // namespace

int longest_axis(const Box& box) {
  const Vec3 size = box.size();
  return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

std::array<Box, 2> split(const Box& box, int axis) {
  std::array<Box, 2> parts{box, box};
  parts[0].hi[axis] = parts[1].lo[axis] =
      box.lo[axis] + kSplitShare * (box.hi[axis] - box.lo[axis]);
  return parts;
}

Truth simplify_for(const Box& box, const Formula& around, const Scene& scene,
                   Simplifier& simplifier, Formula& out) {
  return simplifier.simplify(around, box, expand_of(expanded_size(scene, around)), out);
}

bool is_large(const Simplifier::Size& size) {
  return size.is_crowded || size.literals > kFewLiterals;
}

FirstCells::FirstCells(const Scene& scene, const UnitBoxes& boxes, const Box& start,
                       const Workers& workers)
    : scene_(scene) {
  cells_.push_back({.box = start});
  for (size_t first = 0, level = 0; first < cells_.size(); ++level) {
    const size_t last = cells_.size();
    for_parts(&workers, last - first, 1, [&](size_t begin, size_t end, size_t) {
      Simplifier simplifier(scene, boxes, 0);
      for (size_t i = first + begin; i < first + end; ++i) {
        Cell& cell = cells_[i];
        cell.truth = simplify_for(cell.box, around(i), scene, simplifier, cell.formula);
        if (cell.truth == Truth::kVaries) cell.size = simplifier.size_of(cell.formula);
      }
    });
    for (; first < last; ++first)
      if (level < kLevels && is_worth_sharing(cells_[first])) add_parts(first);
  }
}

void FirstCells::add_parts(size_t i) {
  cells_[i].parts = cells_.size();
  const Box box = cells_[i].box;
  for (const Box& part : split(box, longest_axis(box)))
    cells_.push_back({.box = part, .parent = i});
}

}  // namespace whittle
