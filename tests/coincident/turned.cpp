#include "coincident/turned.h"

#include <fmt/format.h>

#include "base/degrees.h"
#include "model/instances.h"

namespace whittle {
namespace {

Affine six_digits(Affine map) {
  const auto rounded = [](double x) { return std::stod(fmt::format("{:.6g}", x)); };
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) map.row[i][j] = rounded(map.row[i][j]);
    map.translation[i] = rounded(map.translation[i]);
  }
  return map;
}

}  // namespace

Affine turn_of(const Model& model, bool mirrored) {
  Affine turn;
  const double angles[] = {17, 31, 53};
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double c = cos_degrees(angles[axis]), s = sin_degrees(angles[axis]);
    Affine one;
    one.row[u][u] = c, one.row[u][v] = -s, one.row[v][u] = s, one.row[v][v] = c;
    turn = one * turn;
  }
  if (mirrored) turn = turn * scaling({1, -1, 1});
  return turn * translation(-bounds(model).box.center());
}

Model turned(const Model& model, const Affine& turn) {
  Model result = model;
  result.transforms = {Affine{}};
  std::vector<std::vector<Affine>> routes(model.nodes.size());
  size_t count = 0;
  for (const Instance& instance : instances(model)) {
    const Affine& before = instance.world_from_object;
    if (count++ % 2 == 0)
      routes[instance.node] = {six_digits(turn), six_digits(before)};
    else
      routes[instance.node] = {six_digits(turn * before)};
  }

  // Transforms stand in front of their primitive; what was a transform is left as a group.
  std::vector<uint32_t> moved(model.nodes.size() + 1);
  for (size_t i = 0; i < model.nodes.size(); ++i)
    moved[i + 1] = moved[i] + 1 + uint32_t(routes[i].size());
  result.nodes.clear();
  for (size_t i = 0; i < model.nodes.size(); ++i) {
    Node node = model.nodes[i];
    node.end = moved[node.end];
    for (const Affine& map : routes[i]) {
      Node transform = node;
      transform.kind = NodeKind::kTransform;
      transform.payload = uint32_t(result.transforms.size());
      result.transforms.push_back(map);
      result.nodes.push_back(transform);
    }
    if (node.kind == NodeKind::kTransform) node.kind = NodeKind::kUnion;
    result.nodes.push_back(node);
  }
  return result;
}

}  // namespace whittle
