#include "evaluate/dimensions.h"

#include <algorithm>
#include <variant>

namespace whittle {
namespace {

Dimension dimension_of(const Leaf& leaf) {
  if (std::holds_alternative<HeightMap>(leaf)) return Dimension::kSolid;
  const auto* const import = std::get_if<Import>(&leaf);
  return import && !is_flat_file(import->file) ? Dimension::kSolid : Dimension::kFlat;
}

bool makes_solids(const Operation& operation) {
  return std::holds_alternative<LinearExtrude>(operation) ||
         std::holds_alternative<RotateExtrude>(operation) ||
         std::holds_alternative<Roof>(operation);
}

bool takes_flat(const Operation& operation) {
  return makes_solids(operation) || std::holds_alternative<Offset>(operation) ||
         std::holds_alternative<Fill>(operation);
}

}  // namespace

bool is_flat_file(std::string_view file) {
  const auto ends_with = [&](std::string_view suffix) {
    return file.size() >= suffix.size() &&
           std::equal(suffix.begin(), suffix.end(), file.end() - std::ptrdiff_t(suffix.size()),
                      [](char a, char b) { return a == (b >= 'A' && b <= 'Z' ? b + 32 : b); });
  };
  return ends_with(".svg") || ends_with(".dxf");
}

std::vector<Dimension> dimensions(const Document& document) {
  const std::vector<Node>& nodes = document.model.nodes;
  std::vector<Dimension> all(nodes.size(), Dimension::kNone);
  // Children stand behind their parents.
  for (auto i = uint32_t(nodes.size()); i-- > 0;) {
    const Node& node = nodes[i];
    if (node.kind == NodeKind::kPrimitive) {
      all[i] = Dimension::kSolid;
      continue;
    }
    if (node.kind == NodeKind::kLeaf) {
      all[i] = dimension_of(document.leaves[node.payload]);
      continue;
    }
    for (uint32_t c = i + 1; c < node.end && all[i] == Dimension::kNone; c = nodes[c].end) {
      if (!nodes[c].background) all[i] = all[c];
    }
    if (node.kind != NodeKind::kOperation) continue;
    const Operation& operation = document.operations[node.payload];
    if (makes_solids(operation)) {
      all[i] = Dimension::kSolid;
    } else if (takes_flat(operation) || std::holds_alternative<Projection>(operation)) {
      all[i] = Dimension::kFlat;
    }
  }
  return all;
}

Dimension dimension_inside(const Document& document, uint32_t node,
                           const std::vector<Dimension>& dimensions) {
  const Node& n = document.model.nodes[node];
  if (n.kind != NodeKind::kOperation) return dimensions[node];
  const Operation& operation = document.operations[n.payload];
  if (takes_flat(operation)) return Dimension::kFlat;
  if (std::holds_alternative<Projection>(operation)) return Dimension::kSolid;
  return dimensions[node];
}

}  // namespace whittle
