#include "csg/document_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "base/limit_hint.h"
#include "csg/leaves.h"
#include "csg/maps.h"
#include "csg/operations.h"
#include "csg/polish.h"
#include "csg/solids.h"
#include "csg/tree_edit.h"

namespace whittle {
namespace {

constexpr uint32_t kNone = OpenStatement::kNone;

bool holds_nothing(NodeKind kind) {
  return kind == NodeKind::kPrimitive || kind == NodeKind::kLeaf;
}

/// Where an operation or a leaf keeps its $fn, $fa and $fs; null if it has none.
struct FragmentsOf {
  FragmentSettings* operator()(auto& shape) const {
    if constexpr (requires { shape.fragments; }) {
      return &shape.fragments;
    } else {
      return nullptr;
    }
  }
};

}  // namespace

DocumentBuilder::DocumentBuilder(const std::string& file, const ReadOptions& options,
                                 Warnings& warnings)
    : options_(options), warnings_(warnings), last_polished_(polished(last_written_)) {
  document_.model.file = file;
  document_.model.nodes.push_back({.kind = NodeKind::kUnion, .where = {1, 1}});
  scopes_.emplace_back();
}

std::optional<Mistake> DocumentBuilder::add(const Statement& statement, std::string_view name,
                                            StatementModifiers modifiers, bool is_dumped_text,
                                            const OpenStatement& parent, OpenStatement& open) {
  std::vector<Node>& nodes = document_.model.nodes;
  // The first node is no statement but the file.
  if (nodes.size() > std::min<size_t>(options_.limits.nodes, kNone - 2)) {
    return Mistake{statement.where, fmt::format("there are more statements than the limit of {}{}",
                                                options_.limits.nodes, limit_hint("nodes"))};
  }
  open.node = static_cast<uint32_t>(nodes.size());
  open.is_root = modifiers.root;
  open.is_background = parent.is_background || modifiers.background;
  const Meaning meaning = statement.type->meaning;
  open.needs_corners = parent.needs_corners || meaning == Meaning::kHull ||
                       meaning == Meaning::kMinkowski || meaning == Meaning::kProjection;
  if (modifiers.root) {
    if (root_ == kNone) {
      root_ = open.node;
    } else {
      warnings_.add("'!' is given more than once; the first one counts", statement.where,
                    "'!' is given more than once; the first one counts");
    }
  }
  const GivenFragments& given = statement.fragments;
  if (statement.type->passes_fragments && !is_childless(statement.type->meaning) &&
      (given.fn || given.fa || given.fs)) {
    open.scope = static_cast<uint32_t>(scopes_.size());
    inherits_fragments_ |= parent.scope == 0 && !given.is_complete();
    // Not the top level's, which may still change.
    scopes_.push_back(parent.scope == 0 ? given : given.within(scopes_[parent.scope]));
  }
  Node node{.background = modifiers.background,
            .highlight = modifiers.highlight,
            .where = statement.where};
  if (std::optional<Mistake> mistake = set_meaning(statement, name, is_dumped_text, open, node)) {
    return mistake;
  }
  nodes.push_back(node);
  take_fragments(statement, parent, open, node);
  if (node.kind == NodeKind::kOperation) add_extruded_file(statement, open);
  return std::nullopt;
}

std::optional<Mistake> DocumentBuilder::set_meaning(const Statement& statement,
                                                    std::string_view name, bool is_dumped_text,
                                                    OpenStatement& open, Node& node) {
  Model& model = document_.model;
  const Meaning meaning = statement.type->meaning;
  switch (meaning) {
    case Meaning::kUnion:
      break;
    case Meaning::kDifference:
      node.kind = NodeKind::kDifference;
      break;
    case Meaning::kIntersection:
      node.kind = NodeKind::kIntersection;
      break;
    case Meaning::kMultmatrix:
    case Meaning::kTranslate:
    case Meaning::kRotate:
    case Meaning::kScale:
    case Meaning::kMirror: {
      Affine map = make_transform(statement, warnings_);
      if (options_.polish && meaning == Meaning::kMultmatrix) map = polish(map);
      if (map == Affine{}) break;
      node.kind = NodeKind::kTransform;
      node.payload = static_cast<uint32_t>(model.transforms.size());
      model.transforms.push_back(map);
      break;
    }
    case Meaning::kColor: {
      const Rgba color = make_color(statement, warnings_);
      if (color == Rgba{}) break;
      node.kind = NodeKind::kColor;
      node.payload = static_cast<uint32_t>(model.colors.size());
      model.colors.push_back(color);
      break;
    }
    case Meaning::kCube:
      set_primitive(make_cube(statement, warnings_), node);
      break;
    case Meaning::kSphere:
      set_primitive(make_sphere(statement, warnings_), node);
      break;
    case Meaning::kCylinder:
      set_primitive(make_cylinder(statement, warnings_), node);
      break;
    case Meaning::kPolyhedron: {
      std::string mistake;
      set_primitive(make_polyhedron(statement, mistake), node);
      if (!mistake.empty()) return Mistake{statement.where, "polyhedron: " + mistake};
      break;
    }
    case Meaning::kHalfspace:
      set_primitive(make_halfspace(statement, warnings_), node);
      break;
    case Meaning::kSquare:
      set_leaf(make_square(statement, warnings_), node);
      break;
    case Meaning::kCircle:
      set_leaf(make_circle(statement, warnings_), node);
      break;
    case Meaning::kPolygon:
      set_leaf(make_polygon(statement, warnings_), node);
      break;
    case Meaning::kText:
      set_leaf(make_text(statement, is_dumped_text, warnings_), node);
      break;
    case Meaning::kImport:
      set_leaf(make_import(statement, warnings_), node);
      break;
    case Meaning::kSurface:
      set_leaf(make_height_map(statement, warnings_), node);
      break;
    case Meaning::kLinearExtrude:
    case Meaning::kRotateExtrude:
    case Meaning::kOffset:
    case Meaning::kResize:
    case Meaning::kProjection:
    case Meaning::kHull:
    case Meaning::kMinkowski:
    case Meaning::kFill:
    case Meaning::kRoof:
      set_operation(statement, node);
      break;
    case Meaning::kUnknown: {
      // What OpenSCAD does not have either is rather a slip of the pen.
      const std::string what = fmt::format("{} is not known", quote(name));
      const std::string message = what + ", shown as the union of its children";
      if (open.is_background) {
        warnings_.add(message, statement.where, message);
      } else {
        warnings_.add_unsupported(message, statement.where, message, what);
      }
      break;
    }
    case Meaning::kLanguage:
      break;  // The reader has refused it.
  }
  return std::nullopt;
}

Affine DocumentBuilder::polish(const Affine& map) {
  if (!map.is_finite()) return map;
  // To the bit, for 0 and -0 are two.
  if (std::memcmp(&map.row, &last_written_.row, sizeof map.row) != 0) {
    last_written_ = map;
    last_polished_ = polished(map);
  }
  Affine result = last_polished_;
  result.translation = map.translation;
  return result;
}

void DocumentBuilder::set_primitive(Shape shape, Node& node) {
  Model& model = document_.model;
  node.kind = NodeKind::kPrimitive;
  node.payload = static_cast<uint32_t>(model.primitives.size());
  model.primitives.push_back({std::move(shape), model.statement_count});
}

void DocumentBuilder::set_leaf(Leaf leaf, Node& node) {
  node.kind = NodeKind::kLeaf;
  node.payload = static_cast<uint32_t>(document_.leaves.size());
  document_.leaf_ids.push_back(document_.model.statement_count);
  document_.leaves.push_back(std::move(leaf));
}

void DocumentBuilder::set_operation(const Statement& statement, Node& node) {
  node.kind = NodeKind::kOperation;
  node.payload = static_cast<uint32_t>(document_.operations.size());
  document_.operations.push_back(make_operation(statement, warnings_));
  document_.operation_ids.push_back(document_.model.statement_count);
}

/// Old files extrude a file that the statement itself names; its children do not count then.
void DocumentBuilder::add_extruded_file(const Statement& statement, OpenStatement& open) {
  std::optional<Import> import = extruded_file(statement, warnings_);
  if (!import) return;
  std::vector<Node>& nodes = document_.model.nodes;
  const auto leaf = static_cast<uint32_t>(document_.leaves.size());
  document_.leaves.push_back(std::move(*import));
  document_.leaf_ids.push_back(document_.model.statement_count);
  nodes.push_back({.kind = NodeKind::kLeaf,
                   .end = static_cast<uint32_t>(nodes.size()) + 1,
                   .payload = leaf,
                   .where = statement.where});
  GivenFragments given = statement.fragments;
  if (open.scope != 0) given = given.within(scopes_[open.scope]);
  inherits_fragments_ |= open.scope == 0 && !given.is_complete();
  pending_.push_back({NodeKind::kLeaf, false, leaf, given});
  open.drops_children = true;
  open.operands = 1;
}

void DocumentBuilder::take_fragments(const Statement& statement, const OpenStatement& parent,
                                     const OpenStatement& open, const Node& node) {
  const bool has_fragments =
      node.kind == NodeKind::kPrimitive
          ? may_be_curved(document_.model.primitives[node.payload].shape)
      : node.kind == NodeKind::kLeaf
          ? std::visit(FragmentsOf{}, document_.leaves[node.payload]) != nullptr
          : node.kind == NodeKind::kOperation &&
                std::visit(FragmentsOf{}, document_.operations[node.payload]) != nullptr;
  if (!has_fragments) return;
  Pending curve{node.kind, open.needs_corners, node.payload, statement.fragments};
  if (parent.scope != 0) curve.given = curve.given.within(scopes_[parent.scope]);
  if (curve.given.is_complete()) {
    set_fragments(curve, curve.given.settings());
  } else {
    inherits_fragments_ |= parent.scope == 0;
    pending_.push_back(curve);
  }
}

void DocumentBuilder::set_fragments(const Pending& curve, const FragmentSettings& settings) {
  if (curve.kind == NodeKind::kLeaf) {
    *std::visit(FragmentsOf{}, document_.leaves[curve.payload]) = settings;
    return;
  }
  if (curve.kind == NodeKind::kOperation) {
    *std::visit(FragmentsOf{}, document_.operations[curve.payload]) = settings;
    return;
  }
  Shape& shape = document_.model.primitives[curve.payload].shape;
  if (is_empty(shape)) return;
  const bool is_exact = options_.curves == Curves::kAuto || options_.curves == Curves::kSmooth;
  const Curves curves = curve.needs_corners && is_exact ? Curves::kFacets : options_.curves;
  const auto choose = [&](double r) {
    const int facets = choose_facets(r, settings, curves);
    return curve.needs_corners && facets == 0 ? kMaxFacets : facets;
  };
  std::visit(
      [&]<class S>(S& s) {
        if constexpr (Curved<S>) s.facets = choose(s.widest_radius());
      },
      shape);
}

void DocumentBuilder::close(const OpenStatement& closed, OpenStatement& parent) {
  if (closed.node == kNone) return;
  Model& model = document_.model;
  std::vector<Node>& nodes = model.nodes;
  Node& node = nodes[closed.node];
  node.end = static_cast<uint32_t>(nodes.size());
  parent.operands += !node.background;
  if (holds_nothing(node.kind)) return;

  const bool childless = node.end == closed.node + 1;
  if (childless) {
    if (node.kind == NodeKind::kTransform) model.transforms.pop_back();
    if (node.kind == NodeKind::kColor) model.colors.pop_back();
    node.kind = NodeKind::kUnion;
    node.payload = 0;
  }
  if (node.background || node.highlight || closed.is_root) return;
  if (childless && !keeps_empty_operands(nodes[parent.node])) {
    // An empty operand of a union; elsewhere it counts.
    --parent.operands;
    parent.drops_empty = true;
    nodes.pop_back();
  } else if (closed.operands == 1 && node.kind != NodeKind::kTransform &&
             node.kind != NodeKind::kColor && node.kind != NodeKind::kOperation) {
    node.end = kRemoved;
    has_removed_ = true;
  }
}

void DocumentBuilder::clear() {
  Model& model = document_.model;
  model.nodes.resize(1);
  model.transforms.clear(), model.colors.clear(), model.primitives.clear();
  document_.leaves.clear(), document_.operations.clear();
  document_.leaf_ids.clear(), document_.operation_ids.clear();
  model.statement_count = 0;
  root_ = kNone;
  has_removed_ = inherits_fragments_ = false;
  scopes_.resize(1);
  pending_.clear();
}

Document DocumentBuilder::finish() {
  Model& model = document_.model;
  model.nodes[0].end = static_cast<uint32_t>(model.nodes.size());
  for (const Pending& curve : pending_) {
    set_fragments(curve, curve.given.within(scopes_[0]).settings());
  }
  if (root_ != kNone) keep_subtree(document_, root_);
  if (has_removed_) remove_marked(model);
  return std::move(document_);
}

}  // namespace whittle
