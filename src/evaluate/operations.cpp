// What operations do when they open and when they close.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "evaluate/convex_hull.h"
#include "evaluate/evaluator.h"
#include "evaluate/extrusions.h"
#include "evaluate/minkowski.h"
#include "evaluate/projection.h"
#include "evaluate/resize.h"
#include "evaluate/revolution.h"
#include "flat/extrude.h"
#include "shape/fragments.h"

namespace whittle {

uint32_t Evaluator::enter_operation(uint32_t i) {
  Frame frame;
  frame.node = i;
  frame.mode = open_.back().mode;
  frame.is_facetted = open_.back().is_facetted;
  frame.first_polygons = polygons_.size();
  frame.first_parts = parts_.size();
  if (const auto known = projections_.find(i); known != projections_.end()) {
    give(frame, known->second);
    finish_child(frame);
    return document_.model.nodes[i].end;
  }
  if (!open_operation(i, frame)) {
    leave_out(i);
    return document_.model.nodes[i].end;
  }
  open_.push_back(frame);
  return i + 1;
}

/// False if the operation leaves nothing, whatever it holds.
bool Evaluator::open_operation(uint32_t i, Frame& frame) {
  const Node& node = document_.model.nodes[i];
  const Operation& operation = document_.operations[node.payload];
  if (dimensions_[i] == Dimension::kNone) return false;
  if (const auto* const how = std::get_if<Projection>(&operation)) {
    if (!how->cut) {
      open_model(i, frame);
    } else {
      // Sections of a Boolean are the Boolean of the sections.
      frame.mode = Mode::kSection;
      frame.is_facetted = frame.wants_surface = true;
    }
    return true;
  }
  if (std::holds_alternative<Roof>(operation)) {
    refuse(i, "roofs are not supported; nothing is shown for it", "roofs are not supported");
    return false;
  }
  if (const auto* const how = std::get_if<LinearExtrude>(&operation)) {
    return open_linear_extrude(i, *how, frame);
  }
  if (std::holds_alternative<RotateExtrude>(operation) || dimensions_[i] == Dimension::kFlat) {
    frame.mode = Mode::kFlat;
    frame.separate = std::holds_alternative<Minkowski>(operation);
    return true;
  }
  if (std::holds_alternative<Minkowski>(operation)) {
    // The hull of a sum is the sum of hulls.
    frame.wants_surface = frame.mode != Mode::kParts || open_.back().wants_surface;
    frame.mode = Mode::kParts;
    frame.separate = true;
  } else if (std::holds_alternative<Hull>(operation)) {
    frame.mode = Mode::kParts;
  } else if (frame.mode == Mode::kSolid) {
    // A resize; its map follows when the box of what it holds is known.
    frame.out = begin_node(NodeKind::kTransform, uint32_t(out_.transforms.size()), node);
    out_.transforms.emplace_back();
  } else {
    frame.wants_surface = open_.back().wants_surface;
    if (frame.mode == Mode::kSection) open_model(i, frame);
  }
  return true;
}

bool Evaluator::open_linear_extrude(uint32_t i, const LinearExtrude& how, Frame& frame) {
  const Node& node = document_.model.nodes[i];
  if (is_flat_extrusion(how)) return false;
  if (frame.mode != Mode::kSolid || !is_straight(how)) {
    frame.mode = Mode::kFlat;
    return true;
  }
  frame.mode = Mode::kEmbedded;
  frame.height = how.height;
  frame.body = document_.operation_ids[node.payload];
  frame.out = begin_node(NodeKind::kBody, frame.body, node);
  if (const Affine map = placement(how); map != Affine{}) {
    begin_node(NodeKind::kTransform, uint32_t(out_.transforms.size()), node);
    out_.transforms.push_back(map);
  }
  return true;
}

void Evaluator::close_operation(const Frame& frame) {
  if (const auto* const how = operation<LinearExtrude>(frame)) {
    close_linear_extrude(frame, *how);
  } else if (const auto* const turn = operation<RotateExtrude>(frame)) {
    close_rotate_extrude(frame, *turn);
  } else if (const auto* const offset = operation<Offset>(frame)) {
    give(frame, offset_of(take_united(frame), *offset, options_.curves, budget_));
  } else if (operation<Fill>(frame)) {
    give(frame, filled(take_united(frame)));
  } else if (operation<Hull>(frame)) {
    close_hull(frame);
  } else if (operation<Minkowski>(frame)) {
    close_minkowski(frame);
  } else if (const auto* const projected = operation<Projection>(frame)) {
    close_projection(frame, *projected);
  } else if (const auto* const size = operation<Resize>(frame)) {
    close_resize(frame, *size);
  }
  finish_child(frame);
}

void Evaluator::close_linear_extrude(const Frame& frame, const LinearExtrude& how) {
  if (frame.mode == Mode::kEmbedded) {
    const auto end = uint32_t(out_.nodes.size());
    out_.nodes[frame.out].end = end;
    if (placement(how) != Affine{}) out_.nodes[frame.out + 1].end = end;
    return;
  }
  const Polygons polygons = take_united(frame);
  if (open_.back().mode != Mode::kParts || !is_straight(how)) {
    LinearExtrude sliced = how;
    // That version divides no edges.
    if (options_.curves == Curves::kOpenscad2021) sliced.segments = 0;
    give(frame, sliced_extrusion(polygons, sliced, budget_));
    return;
  }
  for (SolidPart& part : extruded_parts(polygons, how, open_.back().wants_surface, budget_)) {
    give(frame, std::move(part));
  }
}

void Evaluator::close_rotate_extrude(const Frame& frame, const RotateExtrude& how) {
  Polygons profile = take_united(frame);
  double least = 0, most = 0;
  for (const Contour& contour : profile.contours) {
    for (const Vec2 p : contour) {
      least = std::fmin(least, p.x);
      most = std::fmax(most, p.x);
    }
  }
  if (crosses_axis(profile)) {
    warnings_.add_unsupported(
        "what is revolved reaches across the axis; nothing is shown for it", node_of(frame).where,
        fmt::format("what is revolved reaches across the axis, from x = {:.6g} to {:.6g}; nothing "
                    "is shown for it",
                    least, most),
        "what is revolved reaches across the axis");
    profile = {};
  }
  const double r = most - least;
  const bool is_solid = open_.back().mode == Mode::kSolid;
  const int facets = is_solid ? facets_of(r, how.fragments) : 0;
  if (is_solid && facets == 0 && !profile.is_empty() && how.angle_degrees != 0) {
    add_revolution(frame, how, profile);
    return;
  }
  int n = facets > 0 ? facets : fragment_count(r, how.fragments, options_.curves);
  const double turn = std::fabs(how.angle_degrees);
  if (options_.curves == Curves::kOpenscad2021 && turn > 0 && turn < 360) {
    // That version cuts off the fraction of a partial turn's steps. So many fragments of a full
    // turn, rounded up, make as many.
    n = int(std::fmin(std::floor(std::fmax(std::floor(n * turn / 360), 1) * 360 / turn), n));
  }
  give(frame, faceted_revolution(profile, how, n, budget_));
}

/// True curves: a union of frusta without frusta, all of them one body.
void Evaluator::add_revolution(const Frame& frame, const RotateExtrude& how,
                               const Polygons& profile) {
  Polygons right = profile;
  double radius = 0, low = kInfinity, high = -kInfinity;
  bool is_mirrored = false;
  for (Contour& contour : right.contours) {
    for (Vec2& p : contour) {
      is_mirrored |= p.x < 0;
      p.x = std::fabs(p.x);
      radius = std::fmax(radius, p.x);
      low = std::fmin(low, p.y);
      high = std::fmax(high, p.y);
    }
  }
  const Node& from = node_of(frame);
  const uint32_t id = document_.operation_ids[from.payload];
  const bool is_part = std::fabs(how.angle_degrees) < 360;
  const uint32_t body = begin_node(NodeKind::kBody, id, from);
  const auto end_now = [&](uint32_t node) { out_.nodes[node].end = uint32_t(out_.nodes.size()); };
  const uint32_t whole = is_part ? begin_node(NodeKind::kIntersection, 0, from) : body;
  const uint32_t turned = is_part ? begin_node(NodeKind::kUnion, 0, from) : body;
  for (const Ring& ring : rings(right, budget_)) {
    if (!budget_.spend(4)) return;
    uint32_t moved = kNone;
    if (ring.z != 0) {
      moved = begin_node(NodeKind::kTransform, uint32_t(out_.transforms.size()), from);
      out_.transforms.push_back(translation({0, 0, ring.z}));
    }
    const bool is_hollow = ring.inner.r1 > 0 || ring.inner.r2 > 0;
    const uint32_t hollow = is_hollow ? begin_node(NodeKind::kDifference, 0, from) : kNone;
    add_shape(ring.outer, id, from);
    if (is_hollow) {
      add_shape(ring.inner, id, from);
      end_now(hollow);
    }
    if (moved != kNone) end_now(moved);
  }
  if (is_part) {
    end_now(turned);
    const uint32_t sector = begin_node(NodeKind::kUnion, 0, from);
    RotateExtrude swept = how;
    if (is_mirrored) swept.start_degrees += 180;
    for (Polyhedron& wedge : wedges(swept, radius, low, high)) {
      add_shape(std::move(wedge), id, from);
    }
    end_now(sector);
    end_now(whole);
  }
  end_now(body);
}

void Evaluator::close_hull(const Frame& frame) {
  if (frame.mode == Mode::kFlat) {
    const std::vector<Polygons> operands = take_polygons(frame);
    budget_.work(corner_count(operands));
    give(frame, convex_hull(operands));
    return;
  }
  std::vector<Vec3> points;
  for (const SolidPart& part : take_parts(frame)) {
    points.insert(points.end(), part.points.begin(), part.points.end());
  }
  std::optional<Polyhedron> hull;
  if (budget_.work(points.size())) hull = solid_hull(points);
  if (hull) budget_.spend(hull->faces.size());
  give(frame, hull ? Shape(std::move(*hull)) : Shape(Mesh{}));
}

void Evaluator::close_minkowski(const Frame& frame) {
  if (frame.mode == Mode::kFlat) {
    std::vector<Polygons> operands = take_polygons(frame);
    std::erase_if(operands, [](const Polygons& operand) { return operand.is_empty(); });
    uint64_t corners = 1;
    for (const Polygons& operand : operands) {
      const uint64_t own = corner_count(operand);
      corners = own > 0 && corners > (uint64_t{1} << 40) / own ? uint64_t{1} << 40 : corners * own;
    }
    if (operands.empty() || !budget_.work(corners)) return;
    give(frame, minkowski_sum(operands));
    return;
  }
  std::vector<Shape> shapes = minkowski_sum(take_parts(frame), options_.threads, budget_);
  if (budget_.is_spent()) return;
  if (open_.back().mode == Mode::kSolid && shapes.size() != 1) {
    const Node& from = node_of(frame);
    const uint32_t id = document_.operation_ids[from.payload];
    const uint32_t body = begin_node(NodeKind::kBody, id, from);
    for (Shape& shape : shapes) add_shape(std::move(shape), id, from);
    out_.nodes[body].end = uint32_t(out_.nodes.size());
    return;
  }
  for (Shape& shape : shapes) give(frame, std::move(shape));
}

void Evaluator::close_projection(const Frame& frame, const Projection& how) {
  Polygons seen = how.cut ? take_united(frame) : shadow_of(close_model(), frame);
  if (options_.outlines && dimensions_[0] == Dimension::kFlat) projections_[frame.node] = seen;
  give(frame, std::move(seen));
}

void Evaluator::close_resize(const Frame& frame, const Resize& how) {
  if (frame.mode == Mode::kSolid && !frame.has_model) {
    resize_solid(out_, frame.out, how, options_, budget_);
  } else if (frame.mode == Mode::kFlat) {
    Polygons polygons = take_united(frame);
    if (polygons.is_empty()) return;
    const Rect box = bounds(polygons);
    const Vec2 size = box.hi - box.lo;
    Resize in_plane = how;
    in_plane.size.z = 0;
    give(frame, transformed(resize_map(in_plane, {size.x, size.y, 0}), std::move(polygons)));
  } else {
    std::vector<SolidPart> parts =
        frame.has_model ? parts_of(boundary_of(close_model(), frame), true) : take_parts(frame);
    Box box;
    for (const SolidPart& part : parts)
      for (const Vec3 p : part.points) box.include(p);
    const Affine map = box.is_empty() ? Affine{} : resize_map(how, box.size());
    for (SolidPart& part : parts) {
      transform(map, part);
      give(frame, std::move(part));
    }
  }
}

std::vector<Polygons> Evaluator::take_polygons(const Frame& frame) {
  const auto first = polygons_.begin() + std::ptrdiff_t(frame.first_polygons);
  std::vector<Polygons> own(std::make_move_iterator(first),
                            std::make_move_iterator(polygons_.end()));
  polygons_.erase(first, polygons_.end());
  return own;
}

Polygons Evaluator::take_united(const Frame& frame) {
  std::vector<Polygons> own = take_polygons(frame);
  if (own.empty()) return {};
  if (own.size() == 1) return std::move(own.front());
  if (!budget_.work(corner_count(own))) return {};
  return unite(own);
}

std::vector<SolidPart> Evaluator::take_parts(const Frame& frame) {
  const auto first = parts_.begin() + std::ptrdiff_t(frame.first_parts);
  std::vector<SolidPart> own(std::make_move_iterator(first), std::make_move_iterator(parts_.end()));
  parts_.erase(first, parts_.end());
  return own;
}

/// What an operation or a leaf has come to goes where the node around it wants it.
void Evaluator::give(const Frame& frame, Polygons polygons) {
  const Frame& parent = open_.back();
  if (parent.mode == Mode::kFlat) {
    polygons = transformed(parent.map, std::move(polygons));
    if (is_measurable(polygons)) polygons_.push_back(std::move(polygons));
  } else {
    const Node& node = node_of(frame);
    add_embedded(polygons, document_.operation_ids[node.payload], node);
  }
}

void Evaluator::give(const Frame& frame, Shape shape) {
  const Frame& parent = open_.back();
  if (parent.mode == Mode::kParts || parent.mode == Mode::kSection) {
    give(frame, part_of(shape, parent.wants_surface, budget_));
  } else {
    const Node& node = node_of(frame);
    add_shape(std::move(shape), document_.operation_ids[node.payload], node);
  }
}

void Evaluator::give(const Frame&, SolidPart part) {
  if (part.points.empty()) return;
  const Frame& parent = open_.back();
  transform(parent.map, part);
  if (parent.mode == Mode::kParts) {
    parts_.push_back(std::move(part));
  } else if (Polygons polygons = section_of(part, budget_); is_measurable(polygons)) {
    polygons_.push_back(std::move(polygons));
  }
}

}  // namespace whittle
