#include "evaluate/resize.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "evaluate/flat_values.h"
#include "model/instances.h"

namespace whittle {
namespace {

/// Moves the last entries of a table into another.
template <class T>
void move_tail(std::vector<T>& from, size_t count, std::vector<T>& to) {
  const auto first = from.end() - std::ptrdiff_t(count);
  to.insert(to.end(), std::make_move_iterator(first), std::make_move_iterator(from.end()));
  from.erase(first, from.end());
}

}  // namespace

void resize_solid(Model& model, uint32_t node, const Resize& how, const EvaluateOptions& options,
                  Budget& budget) {
  const auto end = uint32_t(model.nodes.size());
  model.nodes[node].end = end;
  // To find a box costs more than to compute with a corner.
  constexpr uint64_t kPerBox = 1000, kPerNode = 20;
  if (!budget.work(kPerBox + kPerNode * (end - node))) return;
  // What the node holds, as a model of its own: the last entries of all tables.
  Model part;
  part.file = model.file;
  part.statement_count = model.statement_count;
  part.nodes.reserve(end - node);
  part.nodes.push_back({.kind = NodeKind::kUnion, .end = end - node, .where = {1, 1}});
  size_t transforms = 0, colors = 0, primitives = 0;
  for (uint32_t i = node + 1; i < end; ++i) {
    const NodeKind kind = model.nodes[i].kind;
    transforms += kind == NodeKind::kTransform;
    colors += kind == NodeKind::kColor;
    primitives += kind == NodeKind::kPrimitive;
  }
  const size_t transforms_before = model.transforms.size() - transforms;
  const size_t colors_before = model.colors.size() - colors;
  const size_t primitives_before = model.primitives.size() - primitives;
  for (uint32_t i = node + 1; i < end; ++i) {
    Node& copy = part.nodes.emplace_back(model.nodes[i]);
    copy.end -= node;
    if (copy.kind == NodeKind::kTransform) copy.payload -= uint32_t(transforms_before);
    if (copy.kind == NodeKind::kColor) copy.payload -= uint32_t(colors_before);
    if (copy.kind == NodeKind::kPrimitive) copy.payload -= uint32_t(primitives_before);
  }
  move_tail(model.transforms, transforms, part.transforms);
  move_tail(model.colors, colors, part.colors);
  move_tail(model.primitives, primitives, part.primitives);
  const Box box = options.solid_box ? options.solid_box(part) : bounds(part).box;
  move_tail(part.transforms, transforms, model.transforms);
  move_tail(part.colors, colors, model.colors);
  move_tail(part.primitives, primitives, model.primitives);
  if (!box.is_empty() && box.is_finite()) {
    model.transforms[model.nodes[node].payload] = resize_map(how, box.size());
  }
}

}  // namespace whittle
