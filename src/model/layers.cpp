#include "model/layers.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "model/copy_nodes.h"

namespace whittle {
namespace {

/// What the material of a subtree is.
using Class = uint32_t;
constexpr Class kNothing = 0;  ///< there is none
constexpr Class kOpaque = 1;
constexpr Class kMixed = 2;   ///< of several classes, and can be taken apart
constexpr Class kWhole = 3;   ///< see-through somewhere, and cannot be
constexpr Class kColors = 4;  ///< this and all above: of one see-through colour

bool is_tool_user(NodeKind kind) {
  return kind == NodeKind::kDifference || kind == NodeKind::kIntersection;
}

/// Classes of nodes, and what they are found from.
class Classes {
 public:
  Classes(const Model& model, std::span<const Appearance> looks)
      : model_(model), looks_(looks), of_(model.nodes.size(), kNothing) {
    // Children stand behind their parents.
    for (uint32_t i = uint32_t(model.nodes.size()); i-- > 0;) of_[i] = find(i);
  }

  Class of(uint32_t node) const { return of_[node]; }
  size_t colors() const { return colors_.size(); }
  bool has_many_colors() const { return has_many_colors_; }

 private:
  const Node& node(uint32_t i) const { return model_.nodes[i]; }

  Class find(uint32_t i) {
    switch (node(i).kind) {
      case NodeKind::kPrimitive:
        return of_look(model_.primitives[node(i).payload].id);
      case NodeKind::kBody:
        return of_look(node(i).payload);
      case NodeKind::kDifference:
        return of_difference(i);
      case NodeKind::kIntersection:
        return of_intersection(i);
      default:
        return of_union(i);
    }
  }

  Class of_look(uint32_t id) {
    if (id >= looks_.size() || !(opacity(looks_[id]) < 1)) return kOpaque;
    const Rgba& color = looks_[id].color;
    const auto known = std::ranges::find(colors_, color);
    if (known != colors_.end()) return kColors + Class(known - colors_.begin());
    if (colors_.size() == kMostSeeThroughColors) {
      has_many_colors_ = true;
      return kWhole;
    }
    colors_.push_back(color);
    return kColors + Class(colors_.size() - 1);
  }

  template <class Visit>
  void for_operands(uint32_t i, const Visit& visit) const {
    for (uint32_t c = i + 1; c < node(i).end; c = node(c).end)
      if (!node(c).background) visit(of_[c]);
  }

  Class of_union(uint32_t i) const {
    Class all = kNothing;
    for_operands(i, [&](Class own) {
      if (own == kNothing || own == all) return;
      all = all == kNothing ? own : kMixed;
    });
    return all;
  }

  Class of_difference(uint32_t i) const {
    std::optional<Class> first;
    bool are_cutters_opaque = true;
    for_operands(i, [&](Class own) {
      if (first)
        are_cutters_opaque &= own == kNothing || own == kOpaque;
      else
        first = own;
    });
    const Class own = first.value_or(kNothing);
    // A see-through cutter leaves see-through walls in what is opaque.
    return are_cutters_opaque || own >= kColors || own == kNothing ? own : kWhole;
  }

  Class of_intersection(uint32_t i) const {
    Class all = kNothing;
    for_operands(i, [&](Class own) {
      if (own == kNothing || (own == kOpaque && all != kNothing)) return;
      // Of two that can be taken apart each piece would have to meet each.
      if (own == all && own != kMixed) return;
      all = all == kNothing || all == kOpaque ? own : kWhole;
    });
    return all;
  }

  const Model& model_;
  std::span<const Appearance> looks_;
  bool has_many_colors_ = false;
  std::vector<Class> of_;
  std::vector<Rgba> colors_;
};

/// What of a model is of one class; `found` is set if anything is.
Model part_of(const Model& model, const Classes& classes, Class wanted, bool& found) {
  Model part;
  found = false;
  NodeCopier copier(model, part);
  // What takes apart: unions, and differences and intersections whose other operands are tools.
  struct Scope {
    uint32_t end = 0;
    NodeKind kind = NodeKind::kUnion;
    uint32_t operands = 0;
  };
  std::vector<Scope> scopes{{uint32_t(model.nodes.size())}};
  uint32_t whole_end = 0;  // All before this is taken as it is.
  for (uint32_t i = 1; i < model.nodes.size();) {
    const Node& node = model.nodes[i];
    if (node.background) {
      i = node.end;
      continue;
    }
    copier.close_before(i);
    if (i < whole_end) {
      copier.open(i++);
      continue;
    }
    while (scopes.back().end <= i) scopes.pop_back();
    Scope& around = scopes.back();
    const Class own = classes.of(i);
    const bool is_first = around.operands++ == 0;
    const bool is_tool = (around.kind == NodeKind::kDifference && !is_first) ||
                         (around.kind == NodeKind::kIntersection && own != kMixed);
    if (is_tool || own == wanted) {
      found |= !is_tool;
      whole_end = node.end;
    } else if (own == kMixed) {
      scopes.push_back({node.end, is_tool_user(node.kind) ? node.kind : NodeKind::kUnion});
    } else {
      i = node.end;
      continue;
    }
    copier.open(i++);
  }
  copier.finish();
  return part;
}

/// Adds a layer for each class that there is. What is opaque is one of them, or goes to
/// `opaque_part`.
void add_layers(const Model& model, std::span<const Appearance> looks, LayerKind kind,
                Layers& layers, Model* opaque_part) {
  const Classes classes(model, looks);
  layers.has_many_colors |= classes.has_many_colors();
  const auto add = [&](Class own) {
    bool found = false;
    Model part = part_of(model, classes, own, found);
    if (found) layers.see_through.push_back({kind, std::move(part)});
  };
  bool is_opaque = false;
  if (opaque_part)
    *opaque_part = part_of(model, classes, kOpaque, is_opaque);
  else
    add(kOpaque);
  for (Class own = kWhole; own < kColors + classes.colors(); ++own) add(own);
}

/// For each node whether `#` marks it: as it is written, or as all that it is made of is.
std::vector<bool> marked(const Model& model) {
  std::vector<bool> is_marked(model.nodes.size());
  for (uint32_t i = uint32_t(model.nodes.size()); i-- > 1;) {
    const Node& node = model.nodes[i];
    bool all = node.kind != NodeKind::kPrimitive && node.kind != NodeKind::kBody;
    uint32_t operands = 0;
    for (uint32_t c = i + 1; all && c < node.end; c = model.nodes[c].end) {
      if (model.nodes[c].background) continue;
      ++operands;
      all = is_marked[c];
      if (node.kind == NodeKind::kDifference) break;
    }
    is_marked[i] = node.highlight || (all && operands > 0);
  }
  return is_marked;
}

/// Splits off what `#` marks. `shown`: the model without the marked operands of its outermost
/// unions, which are seen as highlights alone.
Model split_highlights(const Model& model, Model& shown) {
  const std::vector<bool> is_marked = marked(model);
  struct Scope {
    uint32_t end = 0;
    bool is_union = true;
    Affine world_from_parent;
  };
  Model highlights;
  NodeCopier show(model, shown), highlight(model, highlights);
  std::vector<Scope> scopes{{uint32_t(model.nodes.size()), true, {}}};
  uint32_t highlight_end = 0;  // All before this is one, and goes there.
  uint32_t hidden_end = 0;     // All before this is not shown.
  uint32_t body_end = 0;       // All before this is one body, in which marks mean nothing.
  for (uint32_t i = 1; i < model.nodes.size();) {
    const Node& node = model.nodes[i];
    if (node.background) {
      i = node.end;
      continue;
    }
    while (scopes.back().end <= i) scopes.pop_back();
    const Scope around = scopes.back();
    show.close_before(i);
    highlight.close_before(i);
    if (i >= highlight_end && i >= body_end && is_marked[i]) {
      highlight_end = node.end;
      if (around.is_union) hidden_end = node.end;
      if (around.world_from_parent != Affine{})
        highlight.open_transform(around.world_from_parent, i);
    }
    if (i < highlight_end) highlight.open(i);
    if (i >= hidden_end) show.open(i);
    Scope own{node.end, around.is_union && !is_tool_user(node.kind), around.world_from_parent};
    if (node.kind == NodeKind::kBody) body_end = node.end;
    if (node.kind == NodeKind::kTransform)
      own.world_from_parent = around.world_from_parent * model.transforms[node.payload];
    scopes.push_back(own);
    ++i;
  }
  show.finish();
  highlight.finish();
  return highlights;
}

/// All bodies side by side, whatever was to become of them.
Model thrown_together(const Model& model) {
  Model all;
  NodeCopier copier(model, all);
  for (uint32_t i = 1; i < model.nodes.size();) {
    const Node& node = model.nodes[i];
    if (node.background) {
      i = node.end;
      continue;
    }
    copier.close_before(i);
    copier.open(i);
    if (node.kind == NodeKind::kBody) {
      // What a body is made of is one thing.
      for (uint32_t k = i + 1; k < node.end; ++k) {
        copier.close_before(k);
        copier.open(k);
      }
      i = node.end;
      continue;
    }
    if (is_tool_user(node.kind)) all.nodes.back().kind = NodeKind::kUnion;
    ++i;
  }
  copier.finish();
  return all;
}

bool has_highlights(const Model& model) {
  return std::ranges::any_of(model.nodes, [](const Node& node) { return node.highlight; });
}

}  // namespace

Layers layers_of(const Model& model, std::span<const Appearance> looks,
                 const LayerSettings& settings) {
  Layers layers;
  // What is flat is seen in its plane alone.
  if (model.drawing) return layers;
  const bool highlights = settings.ghosts && has_highlights(model);
  Model shown, marked_part;
  if (highlights) marked_part = split_highlights(model, shown);
  if (settings.thrown_together) shown = thrown_together(highlights ? shown : model);
  const bool is_changed = highlights || settings.thrown_together;
  const Model& solid = is_changed ? shown : model;
  const auto is_see_through = [&](const Appearance& look) { return opacity(look) < 1; };
  const bool any = std::ranges::any_of(looks, is_see_through);
  if (any) {
    add_layers(solid, looks, LayerKind::kPart, layers, &layers.opaque);
    layers.is_whole = !is_changed && layers.see_through.empty();
    if (layers.is_whole) layers.opaque = {};
  } else if (is_changed) {
    layers.is_whole = false;
    layers.opaque = std::move(shown);
  }
  if (settings.ghosts && model.background) {
    const std::vector<Appearance> own = ghost_looks(*model.background);
    add_layers(*model.background, own, LayerKind::kGhost, layers, nullptr);
  }
  if (highlights) layers.see_through.push_back({LayerKind::kHighlight, std::move(marked_part)});
  return layers;
}

std::vector<Appearance> ghost_looks(const Model& ghosts) {
  std::vector<Appearance> looks = appearances(ghosts);
  for (Appearance& look : looks)
    if (!look.color.is_valid()) look.color = kGhostColor;
  return looks;
}

std::vector<Appearance> highlight_looks(const Model& highlights) {
  return std::vector<Appearance>(highlights.statement_count + 1, {.color = kHighlightColor});
}

}  // namespace whittle
