#include "model/instances.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "base/result.h"
#include "model/tree_boxes.h"
#include "shape/shape.h"

namespace whittle {

namespace {

/// Of the bounds' box. Where an unbounded solid's is a single point, its largest coordinate stands
/// for it, or 1 at the origin.
double longest_edge(const Bounds& bounds) {
  const double edge = max_component(bounds.box.size());
  if (edge > 0 || bounds.bounded) return edge;
  const double coordinate = max_component(abs(bounds.box.lo));
  return coordinate > 0 ? coordinate : 1;
}

/// Nothing can be computed of what reaches farther from the origin: squares of kUnboundedReach
/// times this are about as large as numbers get.
constexpr double kFarthest = 1e150;

/// True if the shape reaches farther than that, or where it is cannot be told.
bool overflows(const Shape& shape, const Affine& map) {
  const Box box = finite_box(shape, map);
  const Vec3 reach = max(abs(box.lo), abs(box.hi));
  return !(reach.x <= kFarthest && reach.y <= kFarthest && reach.z <= kFarthest);
}

/// Ranges begin below no more transforms than this.
constexpr size_t kFewAbove = 64;

/// What an operator has gathered from its operands so far.
struct BoxFold {
  uint32_t node = 0;
  uint32_t operands = 0;
  Box box;
};

}  // namespace

std::vector<InstanceRange> instance_ranges(const Model& model, size_t nodes_each) {
  std::vector<InstanceRange> ranges;
  std::vector<uint32_t> open;  // transforms
  const auto begin_at = [&](uint32_t node, uint32_t first) {
    ranges.push_back({.begin = node, .end = node, .first = first, .count = 0, .above = open});
  };
  const uint32_t end = uint32_t(model.nodes.size());
  uint32_t found = 0;
  begin_at(0, 0);
  for (uint32_t i = 0; i < end;) {
    while (!open.empty() && model.nodes[open.back()].end <= i) open.pop_back();
    InstanceRange& range = ranges.back();
    if (i - range.begin >= nodes_each && open.size() <= kFewAbove) {
      range.end = i;
      range.count = found - range.first;
      begin_at(i, found);
    }
    const Node& node = model.nodes[i];
    if (node.kind == NodeKind::kTransform && !node.background) open.push_back(i);
    found += node.kind == NodeKind::kPrimitive && !node.background;
    i = node.background ? node.end : i + 1;
  }
  ranges.back().end = end;
  ranges.back().count = found - ranges.back().first;
  return ranges;
}

InstanceWalk::InstanceWalk(const Model& model, const InstanceRange& range)
    : model_(model), at_(range.begin), end_(range.end) {
  Affine world_from_parent;
  for (const uint32_t transform : range.above) {
    const Node& node = model.nodes[transform];
    world_from_parent = world_from_parent * model.transforms[node.payload];
    scopes_.push_back({node.end, world_from_parent});
  }
}

const Instance* InstanceWalk::next() {
  if (next_place() == nullptr) return nullptr;
  const Shape& shape = model_.primitives[instance_.primitive].shape;
  const Affine& map = instance_.world_from_object;
  instance_.empty =
      is_empty(shape) || !map.is_finite() || is_singular(map) || overflows(shape, map);
  return &instance_;
}

const Instance* InstanceWalk::next_place() {
  while (at_ < end_) {
    const uint32_t i = at_++;
    const Node& node = model_.nodes[i];
    if (node.background) {
      at_ = node.end;
      continue;
    }
    while (!scopes_.empty() && scopes_.back().end <= i) scopes_.pop_back();
    const Affine world_from_parent = scopes_.empty() ? Affine{} : scopes_.back().world_from_parent;
    if (node.kind == NodeKind::kTransform) {
      scopes_.push_back({node.end, world_from_parent * model_.transforms[node.payload]});
    } else if (node.kind == NodeKind::kPrimitive) {
      instance_ = {i, node.payload, false, world_from_parent};
      return &instance_;
    }
  }
  return nullptr;
}

std::vector<Instance> instances(const Model& model) {
  std::vector<Instance> found;
  found.reserve(model.primitives.size());
  InstanceWalk walk(model);
  while (const Instance* instance = walk.next()) found.push_back(*instance);
  return found;
}

std::vector<Appearance> appearances(const Model& model) {
  struct Scope {
    uint32_t end = 0;
    bool is_difference = false;
    bool has_minuend = false;
    Appearance below;  ///< of what stands in this scope
  };
  std::vector<Appearance> result(model.statement_count + 1);
  std::vector<Scope> scopes;
  for (uint32_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    while (!scopes.empty() && scopes.back().end <= i) scopes.pop_back();
    Appearance here;
    if (!scopes.empty()) {
      Scope& parent = scopes.back();
      here = parent.below;
      if (parent.is_difference && !node.background) {
        if (parent.has_minuend) here.cut = !here.cut;
        parent.has_minuend = true;
      }
    }
    if (node.kind == NodeKind::kColor && !here.color.is_valid() &&
        model.colors[node.payload].is_valid())
      here.color = model.colors[node.payload];
    if (node.kind == NodeKind::kPrimitive || node.kind == NodeKind::kBody) {
      const bool is_body = node.kind == NodeKind::kBody;
      const uint32_t id = is_body ? node.payload : model.primitives[node.payload].id;
      if (id >= result.size()) result.resize(id + 1);
      result[id] = here;
      // What a body is made of changes nothing about its look.
      if (is_body) i = node.end - 1;
    } else {
      scopes.push_back({node.end, node.kind == NodeKind::kDifference, false, here});
    }
  }
  return result;
}

std::optional<uint32_t> lone_primitive(const Model& model) {
  struct Open {
    uint32_t node = 0;
    uint32_t operands = 0;
    uint32_t primitive = 0;  ///< the last operand's
    bool combined = false;   ///< it is the last operand's work, or ours
  };
  std::vector<Open> open{{}};
  InstanceWalk walk(model);
  const auto give = [&](uint32_t primitive, bool combined) {
    Open& parent = open.back();
    const NodeKind kind = model.nodes[parent.node].kind;
    const bool counts_empty = kind == NodeKind::kDifference || kind == NodeKind::kIntersection;
    if (primitive == 0 && !combined && !counts_empty) return;
    ++parent.operands;
    parent.primitive = primitive;
    parent.combined = combined || parent.operands > 1;
  };
  const auto close_before = [&](uint32_t i) {
    while (open.size() > 1 && model.nodes[open.back().node].end <= i) {
      const Open done = open.back();
      open.pop_back();
      give(done.primitive, done.combined);
    }
  };
  for (uint32_t i = 1; i < model.nodes.size();) {
    const Node& node = model.nodes[i];
    close_before(i);
    if (node.background) {
      i = node.end;
      continue;
    }
    if (node.kind == NodeKind::kBody) {
      bool empty = true;
      for (uint32_t k = i + 1; k < node.end; ++k) {
        if (model.nodes[k].kind == NodeKind::kPrimitive) empty &= walk.next()->empty;
      }
      give(empty ? 0 : node.payload, false);
      i = node.end;
      continue;
    }
    if (node.kind == NodeKind::kPrimitive) {
      const Instance& instance = *walk.next();
      give(instance.empty ? 0 : model.primitives[instance.primitive].id, false);
    } else {
      open.push_back({.node = i});
    }
    ++i;
  }
  close_before(uint32_t(model.nodes.size()));
  const Open& whole = open.front();
  if (whole.combined || whole.primitive == 0) return std::nullopt;
  return whole.primitive;
}

Box instance_box(const Model& model, const Instance& instance) {
  if (instance.empty) return {};
  return shape_box(model.primitives[instance.primitive].shape, instance.world_from_object);
}

Bounds bounds(const Model& model) {
  InstanceWalk walk(model);
  return bounds(model, [&](uint32_t) { return instance_box(model, *walk.next()); });
}

void for_tree_boxes(const Model& model, const std::function<Box(uint32_t)>& box_of,
                    const std::function<void(uint32_t, const Box&)>& visit) {
  std::vector<BoxFold> open;
  const auto give_to_parent = [&](uint32_t node, const Box& operand) {
    visit(node, operand);
    if (open.empty()) return;
    BoxFold& parent = open.back();
    const NodeKind kind = model.nodes[parent.node].kind;
    if (parent.operands++ == 0)
      parent.box = operand;
    else if (kind == NodeKind::kIntersection)
      parent.box = intersect(parent.box, operand);
    else if (kind != NodeKind::kDifference)
      parent.box = unite(parent.box, operand);
  };
  const auto close_before = [&](uint32_t i) {
    while (!open.empty() && model.nodes[open.back().node].end <= i) {
      const BoxFold done = open.back();
      open.pop_back();
      give_to_parent(done.node, done.box);
    }
  };
  uint32_t passed = 0;  // instances
  for (uint32_t i = 0; i < model.nodes.size();) {
    const Node& node = model.nodes[i];
    close_before(i);
    if (node.background) {
      i = node.end;
    } else {
      if (node.kind == NodeKind::kPrimitive)
        give_to_parent(i, box_of(passed++));
      else
        open.push_back({.node = i, .operands = 0, .box = {}});
      ++i;
    }
  }
  close_before(uint32_t(model.nodes.size()));
}

Bounds bounds(const Model& model, const std::function<Box(uint32_t)>& box_of) {
  Box box;  // in the end the root's
  for_tree_boxes(model, box_of, [&](uint32_t, const Box& of_node) { box = of_node; });
  if (box.is_empty()) return {.box = {}, .bounded = true};
  if (box.is_finite()) return {.box = box, .bounded = true};

  Box reach;
  InstanceWalk again(model);
  while (const Instance* instance = again.next()) {
    if (instance->empty) continue;
    const Shape& shape = model.primitives[instance->primitive].shape;
    const Box own = instance_box(model, *instance);
    reach = unite(reach, own.is_finite() ? own : finite_box(shape, instance->world_from_object));
  }
  return {.box = reach, .bounded = false};
}

Box seen_box(const Model& model, Box box) {
  if (model.drawing && !box.is_empty()) box.lo.z = box.hi.z = 0;
  return box;
}

double tolerance(const Bounds& bounds) {
  return bounds.box.is_empty() ? 0 : kRelativeTolerance * longest_edge(bounds);
}

Box view_region(const Bounds& bounds) {
  const Box& box = bounds.box;
  if (box.is_empty()) return {};
  // Bounded: enough for a surface that lies in a side of the box to be well inside.
  const double margin = 10 * tolerance(bounds);
  const double half = 0.5 * kUnboundedReach * longest_edge(bounds);
  const auto all = [](double x) { return Vec3{x, x, x}; };
  return bounds.bounded ? Box{box.lo - all(margin), box.hi + all(margin)}
                        : Box{box.center() - all(half), box.center() + all(half)};
}

double ray_tolerance(const Box& region) {
  constexpr double kFiveRoundings = 1e-15;
  if (region.is_empty()) return 0;
  return kFiveRoundings *
         (max_component(region.size()) + max_component(max(abs(region.lo), abs(region.hi))));
}

std::vector<std::string> transform_warnings(const Model& model) {
  std::vector<std::string> warnings;
  for (const Node& node : model.nodes) {
    if (node.kind != NodeKind::kTransform) continue;
    const Affine& map = model.transforms[node.payload];
    if (!map.is_finite())
      warnings.push_back(
          message_at(model.file, node.where,
                     "warning: this transform is not finite; what it moves is left empty"));
    else if (is_singular(map))
      warnings.push_back(
          message_at(model.file, node.where,
                     "warning: this transform flattens space; what it moves is left empty"));
  }
  return warnings;
}

}  // namespace whittle
