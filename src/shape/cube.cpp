#include "shape/cube.h"

namespace whittle {
namespace {

Box own_box(const Cube& cube) {
  return cube.center ? Box{cube.size * -0.5, cube.size * 0.5} : Box{{}, cube.size};
}

}  // namespace

bool Cube::is_empty() const {
  return !(is_size(size.x) && is_size(size.y) && is_size(size.z));
}

std::vector<Plane> Cube::facet_planes() const {
  const auto [lo, hi] = own_box(*this);
  return {{{-1, 0, 0}, -lo.x}, {{1, 0, 0}, hi.x},   {{0, -1, 0}, -lo.y},
          {{0, 1, 0}, hi.y},   {{0, 0, -1}, -lo.z}, {{0, 0, 1}, hi.z}};
}

std::vector<Vec3> Cube::outline() const {
  const Box box = own_box(*this);
  std::vector<Vec3> corners;
  corners.reserve(8);
  for (int i = 0; i < 8; ++i) corners.push_back(box.corner(i));
  return corners;
}

std::vector<Box> Cube::facet_boxes() const {
  std::vector<Box> boxes(6, own_box(*this));
  for (int axis = 0; axis < 3; ++axis) {
    Box &low = boxes[size_t(2 * axis)], &high = boxes[size_t(2 * axis + 1)];
    low.hi[axis] = low.lo[axis];
    high.lo[axis] = high.hi[axis];
  }
  return boxes;
}

Box Cube::box(const Affine& map) const {
  return transform(map, own_box(*this));
}

}  // namespace whittle
