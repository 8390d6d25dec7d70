#include "evaluate/evaluator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "evaluate/extrusions.h"
#include "model/instances.h"
#include "shape/fragments.h"

namespace whittle {

Evaluator::Evaluator(Document& document, const EvaluateOptions& options, Budget& budget,
                     Warnings& warnings, Projections& projections)
    : document_(document),
      options_(options),
      budget_(budget),
      warnings_(warnings),
      files_(options, budget, warnings),
      leaves_(options.curves, budget, files_, warnings),
      dimensions_(dimensions(document)),
      warned_(document.model.nodes.size()),
      projections_(projections) {
  out_.file = document.model.file;
  out_.statement_count = document.model.statement_count;
  out_.view = document.model.view;
}

Model Evaluator::run(SourceLocation& where) {
  open_.push_back(root_frame());
  walk(where);
  return std::move(out_);
}

std::vector<Contour> Evaluator::outlines(SourceLocation& where) {
  Frame root;
  root.mode = Mode::kFlat;
  open_.push_back(root);
  walk(where);
  return take_united(root).contours;
}

/// To the end of the document, or of the budget.
void Evaluator::walk(SourceLocation& where) {
  const std::vector<Node>& nodes = document_.model.nodes;
  while (!budget_.is_spent()) {
    if (next_ == nodes[open_.back().node].end) {
      where = node_of(open_.back()).where;
      close();
      if (open_.empty()) break;
    } else {
      where = nodes[next_].where;
      next_ = enter(next_);
    }
  }
}

/// What stands alone at the top and is flat is a slab, whose height follows when its size is known.
Evaluator::Frame Evaluator::root_frame() {
  Frame root;
  root.out = begin_node(NodeKind::kUnion, 0, document_.model.nodes[0]);
  if (dimensions_[0] != Dimension::kFlat) return root;
  begin_node(NodeKind::kTransform, 0, document_.model.nodes[0]);
  out_.transforms.emplace_back();
  out_.drawing.emplace();
  root.mode = Mode::kEmbedded;
  return root;
}

void Evaluator::close_root(const Frame& root) {
  if (root.mode == Mode::kFlat) return;
  const auto end = uint32_t(out_.nodes.size());
  out_.nodes[0].end = end;
  if (!out_.drawing) return;
  out_.nodes[1].end = end;
  // The height is nothing that anyone wrote, so no tolerance may follow from it: it is less than
  // the longest edge of the box, and more than what makes a primitive thin.
  constexpr double kFlatness = 64;
  constexpr double kLeast = 1e-100;  // Squares of less may be 0.
  const Box box = bounds(out_).box;
  const Vec3 size = box.is_empty() ? Vec3{} : box.size();
  const double height = std::fmax(size.x, size.y) / kFlatness;
  if (!(height >= kLeast && std::isfinite(height))) return;
  Affine& map = out_.transforms.front();
  map.row[2].z = height;
  map.translation.z = -height / 2;
}

/// Evaluates a leaf, or opens a node. The number of the node that comes next.
uint32_t Evaluator::enter(uint32_t i) {
  const Node& node = document_.model.nodes[i];
  if (node.background) return node.end;
  ++open_.back().operands;
  if (!admit_dimension(i)) {
    leave_out(i);
    return node.end;
  }
  if (node.kind == NodeKind::kPrimitive || node.kind == NodeKind::kLeaf) return enter_leaf(i);
  if (node.kind == NodeKind::kOperation) return enter_operation(i);
  return enter_group(i);
}

bool Evaluator::admit_dimension(uint32_t i) {
  Frame& parent = open_.back();
  const Dimension inside = dimension_inside(document_, parent.node, dimensions_);
  if (dimensions_[i] == Dimension::kNone || dimensions_[i] == inside) return true;
  if (!parent.warned) {
    parent.warned = true;
    const bool is_flat = inside == Dimension::kFlat;
    const bool is_operation = node_of(parent).kind == NodeKind::kOperation;
    warn_once(parent.node,
              is_operation && is_flat ? "only flat shapes can be in here; what is solid is left out"
              : is_flat ? "flat shapes and solids do not mix: the first one is flat, so solids are "
                          "left out"
                        : "flat shapes and solids do not mix: the first one is solid, so flat "
                          "shapes are left out");
  }
  return false;
}

/// An operand of which nothing is left.
void Evaluator::leave_out(uint32_t i) {
  const Frame& parent = open_.back();
  if (parent.mode == Mode::kSolid || parent.mode == Mode::kEmbedded) {
    begin_node(NodeKind::kUnion, 0, document_.model.nodes[i]);
  } else {
    Frame nothing;
    nothing.first_polygons = polygons_.size();
    nothing.first_parts = parts_.size();
    finish_child(nothing);
  }
}

uint32_t Evaluator::enter_leaf(uint32_t i) {
  const Node& node = document_.model.nodes[i];
  const Frame& parent = open_.back();
  Frame own;
  own.node = i;
  own.first_polygons = polygons_.size();
  own.first_parts = parts_.size();
  if (node.kind == NodeKind::kPrimitive) {
    Primitive& primitive = document_.model.primitives[node.payload];
    if (parent.mode == Mode::kSolid) {
      add_shape(std::move(primitive.shape), primitive.id, node);
      return node.end;
    }
    if (std::holds_alternative<Halfspace>(primitive.shape)) {
      warn_once(i, "a half-space has no corners, so no hull and no section; it is left out");
    }
    give(own, part_of(primitive.shape, parent.wants_surface, budget_));
  } else {
    const Leaf& leaf = document_.leaves[node.payload];
    const uint32_t id = document_.leaf_ids[node.payload];
    if (dimensions_[i] == Dimension::kSolid) {
      Mesh mesh{files_.solid(leaf, node.where)};
      if (mesh.surface) budget_.spend(mesh.surface->triangles.size());
      if (parent.mode == Mode::kSolid) {
        add_shape(std::move(mesh), id, node);
        return node.end;
      }
      give(own, part_of(mesh, parent.wants_surface, budget_));
    } else if (parent.mode == Mode::kFlat) {
      give(own, leaves_.polygons(leaf, node.where));
    } else if (const auto* const square = std::get_if<Square>(&leaf)) {
      const uint32_t owner = parent.body > 0 ? parent.body : id;
      const Vec3 size{square->size.x, square->size.y, parent.height};
      if (square->center) {
        const uint32_t moved =
            begin_node(NodeKind::kTransform, uint32_t(out_.transforms.size()), node);
        out_.transforms.push_back(translation({0, 0, parent.height / 2}));
        add_shape(Cube{.size = size, .center = true}, owner, node);
        out_.nodes[moved].end = uint32_t(out_.nodes.size());
      } else {
        add_shape(Cube{.size = size}, owner, node);
      }
      return node.end;
    } else if (const auto* const circle = std::get_if<Circle>(&leaf)) {
      Cylinder cylinder{.h = parent.height, .r1 = circle->r, .r2 = circle->r};
      if (circle->r > 0) {
        cylinder.facets = facets_of(circle->r, circle->fragments);
        if (cylinder.facets > 0) budget_.spend(uint64_t(cylinder.facets) + 2);
      }
      add_shape(cylinder, parent.body > 0 ? parent.body : id, node);
      return node.end;
    } else {
      add_embedded(leaves_.polygons(leaf, node.where), id, node);
      return node.end;
    }
  }
  finish_child(own);
  return node.end;
}

/// Unions and what is like them, differences and intersections.
uint32_t Evaluator::enter_group(uint32_t i) {
  const Node& node = document_.model.nodes[i];
  Frame frame = open_.back();
  frame.node = i;
  frame.operands = 0;
  frame.warned = frame.has_model = false;
  frame.first_polygons = polygons_.size();
  frame.first_parts = parts_.size();
  frame.separate = node.kind == NodeKind::kDifference || node.kind == NodeKind::kIntersection;
  if (frame.mode == Mode::kParts && frame.separate) open_model(i, frame);
  const bool has_nodes = frame.mode == Mode::kSolid || frame.mode == Mode::kEmbedded;
  if (node.kind == NodeKind::kTransform && !has_nodes && !map_of(i, frame)) {
    leave_out(i);
    return node.end;
  }
  if (has_nodes) {
    uint32_t payload = 0;
    NodeKind kind = node.kind;
    if (kind == NodeKind::kTransform) {
      payload = uint32_t(out_.transforms.size());
      const Affine& map = document_.model.transforms[node.payload];
      out_.transforms.push_back(frame.mode == Mode::kEmbedded ? flat_map(map) : map);
    } else if (kind == NodeKind::kColor && frame.body > 0) {
      kind = NodeKind::kUnion;  // A body has one look.
    } else if (kind == NodeKind::kColor) {
      payload = uint32_t(out_.colors.size());
      out_.colors.push_back(document_.model.colors[node.payload]);
    }
    frame.out = begin_node(kind, payload, node);
  }
  open_.push_back(frame);
  return i + 1;
}

/// Lets the frame's map lead through a transform. False, with a warning, if that leaves nothing.
bool Evaluator::map_of(uint32_t i, Frame& frame) {
  Affine map = document_.model.transforms[document_.model.nodes[i].payload];
  const bool is_finite = map.is_finite();
  if (frame.mode == Mode::kFlat) map = flat_map(map);
  if (!is_finite || is_singular(map)) {
    warn_once(i, is_finite ? "this transform flattens space; what it moves is left empty"
                           : "this transform is not finite; what it moves is left empty");
    return false;
  }
  frame.map = frame.map * map;
  return true;
}

/// The facets of a curve in the innermost open node; 0 for a true curve.
int Evaluator::facets_of(double r, FragmentSettings settings) const {
  const int facets = choose_facets(r, settings, options_.curves);
  if (facets > 0 || !open_.back().is_facetted) return facets;
  return std::min(fragment_count(r, settings, options_.curves), kMaxFacets);
}

/// Ends the innermost node.
void Evaluator::close() {
  const Frame frame = open_.back();
  open_.pop_back();
  const NodeKind kind = node_of(frame).kind;
  if (open_.empty()) {
    close_root(frame);
    return;
  }
  if (kind == NodeKind::kOperation) {
    close_operation(frame);
    return;
  }
  if (frame.out != kNone) out_.nodes[frame.out].end = uint32_t(out_.nodes.size());
  if (has_polygons(frame) && frame.separate) {
    std::vector<Polygons> operands = take_polygons(frame);
    if (operands.size() > 1) {
      budget_.work(corner_count(operands));
      Polygons result;
      if (!budget_.is_spent()) {
        result = kind == NodeKind::kDifference ? subtract(operands) : intersect(operands);
      }
      polygons_.push_back(std::move(result));
    } else if (!operands.empty()) {
      polygons_.push_back(std::move(operands.front()));
    }
  } else if (frame.has_model) {
    const TriangleMesh boundary = boundary_of(close_model(), frame);
    for (SolidPart& part : parts_of(boundary, open_.back().wants_surface))
      give(frame, std::move(part));
  }
  finish_child(frame);
}

/// Makes what a child has left on the stacks one operand, where its parent tells them apart.
void Evaluator::finish_child(const Frame& child) {
  const Frame& parent = open_.back();
  if (!parent.separate) return;
  if (has_polygons(parent)) {
    Polygons operand = take_united(child);
    polygons_.push_back(std::move(operand));
  } else if (parent.mode == Mode::kParts) {
    for (size_t k = child.first_parts; k < parts_.size(); ++k) {
      parts_[k].operand = parent.operands - 1;
    }
  }
}

/// Adds a node; where it is to hold others, its end is set later.
uint32_t Evaluator::begin_node(NodeKind kind, uint32_t payload, const Node& from) {
  const auto index = uint32_t(out_.nodes.size());
  Node node = from;
  node.kind = kind;
  node.payload = payload;
  node.end = index + 1;
  out_.nodes.push_back(node);
  return index;
}

void Evaluator::add_shape(Shape shape, uint32_t id, const Node& from) {
  begin_node(NodeKind::kPrimitive, uint32_t(out_.primitives.size()), from);
  out_.primitives.push_back({std::move(shape), id});
}

/// Polygons of an embedded flat shape.
void Evaluator::add_embedded(const Polygons& polygons, uint32_t id, const Node& from) {
  const Frame& parent = open_.back();
  add_shape(straight_extrusion(polygons, parent.height, budget_),
            parent.body > 0 ? parent.body : id, from);
}

void Evaluator::warn_once(uint32_t node, std::string_view message) {
  if (warned_[node]) return;
  warned_[node] = true;
  warnings_.add(message, document_.model.nodes[node].where, message);
}

/// Warns of what cannot be done.
void Evaluator::refuse(uint32_t node, std::string_view message, std::string_view what) {
  if (warned_[node]) return;
  warned_[node] = true;
  warnings_.add_unsupported(message, document_.model.nodes[node].where, message, std::string(what));
}

}  // namespace whittle
