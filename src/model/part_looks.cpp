#include "model/part_looks.h"

namespace whittle {
namespace {

/// A primitive or a body, or 0.
uint32_t id_of(const Model& model, uint32_t node) {
  const Node& n = model.nodes[node];
  if (n.kind == NodeKind::kBody) return n.payload;
  return n.kind == NodeKind::kPrimitive ? model.primitives[n.payload].id : 0;
}

bool look_alike(const Appearance& a, const Appearance& b) {
  return a.color == b.color && a.cut == b.cut;
}

/// By node, whose look its material has: 0 if there is none, kSeveral if it has several looks.
constexpr uint32_t kSeveral = UINT32_MAX;

std::vector<uint32_t> materials(const Model& model, const std::vector<Appearance>& looks) {
  const std::vector<Node>& nodes = model.nodes;
  std::vector<uint32_t> of(nodes.size(), 0);
  // Children stand behind their parents.
  for (uint32_t i = uint32_t(nodes.size()); i-- > 0;) {
    of[i] = id_of(model, i);
    if (of[i] != 0) continue;
    const bool first_alone =
        nodes[i].kind == NodeKind::kDifference || nodes[i].kind == NodeKind::kIntersection;
    for (uint32_t c = i + 1; c < nodes[i].end; c = nodes[c].end) {
      if (nodes[c].background) continue;
      const uint32_t own = of[c];
      if (of[i] == 0)
        of[i] = own;
      else if (own == kSeveral ||
               (own != 0 && of[i] != kSeveral && !look_alike(looks[of[i]], looks[own])))
        of[i] = kSeveral;
      if (first_alone) break;
    }
  }
  return of;
}

}  // namespace

bool set_part_looks(const Model& model, std::vector<Appearance>& looks) {
  const std::vector<Node>& nodes = model.nodes;
  const std::vector<Appearance> written = looks;
  const std::vector<uint32_t> material = materials(model, written);
  struct Difference {
    uint32_t end = 0, first_end = 0, material = 0;
  };
  bool all_known = true;
  std::vector<Difference> open;
  for (uint32_t i = 0; i < nodes.size();) {
    const Node& node = nodes[i];
    if (node.background) {
      i = node.end;
      continue;
    }
    while (!open.empty() && open.back().end <= i) open.pop_back();
    if (node.kind == NodeKind::kDifference) {
      uint32_t first = i + 1;
      while (first < node.end && nodes[first].background) first = nodes[first].end;
      if (first < node.end) open.push_back({node.end, nodes[first].end, material[first]});
    }
    const uint32_t id = id_of(model, i);
    // Caps have looks of their own.
    if (id != 0 && !(model.cut && model.cut->is_plane(id))) {
      for (const Difference& outer : open) {
        if (i < outer.first_end) continue;  // It is of what is cut.
        if (outer.material == kSeveral)
          all_known = false;
        else if (outer.material != 0)
          looks[id] = written[outer.material];
        break;
      }
    }
    i = node.kind == NodeKind::kBody ? node.end : i + 1;
  }
  return all_known;
}

}  // namespace whittle
