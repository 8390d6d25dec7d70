// Solids that are made in code: a tree of shared nodes becomes the document that a text would be.
#include <cmath>
#include <cstddef>
#include <utility>
#include <variant>

#include "base/rotation.h"
#include "evaluate/evaluate.h"
#include "model/document.h"
#include "whittle/api.h"
#include "whittle/reading.h"

namespace whittle {
namespace {

struct Combination {
  NodeKind kind;
};

/// An outline and what is done with it.
struct Extrusion {
  Polygon outline;
  LinearExtrude how;
};

using What = std::variant<Shape, Extrusion, Combination, Hull, Affine, Rgba>;

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

Vec3 finite(const Point& p) {
  if (!is_finite(to_vec3(p))) refuse("a point must be three finite numbers");
  return to_vec3(p);
}

double finite(double number) {
  if (!std::isfinite(number)) refuse("a size must be a finite number");
  return number;
}

int checked_facets(int facets) {
  if (facets != 0 && (facets < 3 || facets > kMaxFacets))
    refuse("facets must be 0, or 3 to " + std::to_string(kMaxFacets));
  return facets;
}

}  // namespace

struct Csg::Node {
  What what;
  std::vector<std::shared_ptr<const Node>> operands;

  explicit Node(What what_, std::vector<Csg> from = {}) : what(std::move(what_)) {
    for (Csg& csg : from) operands.push_back(std::move(csg.node_));
  }
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  /// Trees may be deeper than the stack, so those that go with this one go one by one.
  ~Node() {
    std::vector<std::shared_ptr<const Node>> going = std::move(operands);
    while (!going.empty()) {
      const std::shared_ptr<const Node> last = std::move(going.back());
      going.pop_back();
      if (last.use_count() != 1) continue;
      auto& below = const_cast<Node&>(*last).operands;
      std::move(below.begin(), below.end(), std::back_inserter(going));
      below.clear();
    }
  }

  static Csg make(What what, std::vector<Csg> operands = {}) {
    return Csg(std::make_shared<const Node>(std::move(what), std::move(operands)));
  }
};

Csg Csg::cube(const Point& size, bool centered) {
  return Node::make(Shape(Cube{finite(size), centered}));
}

Csg Csg::sphere(double r, int facets) {
  return Node::make(Shape(Sphere{finite(r), checked_facets(facets)}));
}

Csg Csg::cylinder(double h, double r, bool centered, int facets) {
  return cone(h, r, r, centered, facets);
}

Csg Csg::cone(double h, double r1, double r2, bool centered, int facets) {
  return Node::make(
      Shape(Cylinder{finite(h), finite(r1), finite(r2), centered, checked_facets(facets)}));
}

Csg Csg::polyhedron(std::vector<Point> points, std::vector<std::vector<std::uint32_t>> faces) {
  Polyhedron shape;
  for (const Point& p : points) shape.points.push_back(finite(p));
  for (const std::vector<std::uint32_t>& face : faces)
    for (const std::uint32_t i : face)
      if (i >= points.size()) refuse("a face has a corner that is not among the points");
  shape.faces = std::move(faces);
  return Node::make(Shape(std::move(shape)));
}

Csg Csg::half_space(const Point& normal, double offset) {
  return Node::make(Shape(Halfspace{finite(normal), finite(offset)}));
}

Csg Csg::extrusion(std::vector<std::array<double, 2>> outline, double h) {
  Extrusion made;
  for (const auto& [x, y] : outline) made.outline.points.push_back({finite(x), finite(y)});
  made.how.height = finite(h);
  return Node::make(std::move(made));
}

Csg Csg::union_of(std::vector<Csg> operands) {
  return Node::make(Combination{NodeKind::kUnion}, std::move(operands));
}

Csg Csg::intersection_of(std::vector<Csg> operands) {
  return Node::make(Combination{NodeKind::kIntersection}, std::move(operands));
}

Csg Csg::difference_of(std::vector<Csg> operands) {
  return Node::make(Combination{NodeKind::kDifference}, std::move(operands));
}

Csg Csg::hull_of(std::vector<Csg> operands) {
  return Node::make(Hull{}, std::move(operands));
}

Csg Csg::moved(const Point& by) const {
  return Node::make(translation(finite(by)), {*this});
}

Csg Csg::turned(const Point& degrees) const {
  const Vec3 by = finite(degrees);
  return Node::make(
      rotation(by.z, {0, 0, 1}) * rotation(by.y, {0, 1, 0}) * rotation(by.x, {1, 0, 0}), {*this});
}

Csg Csg::scaled(const Point& by) const {
  return Node::make(scaling(finite(by)), {*this});
}

Csg Csg::transformed(const std::array<std::array<double, 4>, 3>& rows) const {
  Affine map;
  for (int i = 0; i < 3; ++i) {
    const auto& row = rows[size_t(i)];
    map.row[i] = finite(Point{row[0], row[1], row[2]});
    map.translation[i] = finite(row[3]);
  }
  return Node::make(map, {*this});
}

Csg Csg::colored(float r, float g, float b, float a) const {
  for (const float share : {r, g, b, a})
    if (!(share >= 0 && share <= 1)) refuse("a colour's parts must be 0 to 1");
  return Node::make(Rgba{r, g, b, a}, {*this});
}

Solid Solid::make(const Csg& csg, const LoadOptions& options) {
  const Curves curves = curves_in_style(options.style, options.curves);
  Document document;
  Model& model = document.model;
  model.file = "<code>";
  std::vector<Node>& nodes = model.nodes;

  struct Open {
    const Csg::Node* from;
    size_t next = 0;  ///< of its operands
    uint32_t node = 0;
    bool in_hull = false;
  };
  std::vector<Open> stack;
  const auto add = [&](NodeKind kind, size_t payload) {
    if (nodes.size() > options.limits.nodes)
      fail({ErrorKind::kInput, "more than " + std::to_string(options.limits.nodes) + " nodes"});
    nodes.push_back({.kind = kind, .payload = uint32_t(payload), .where = {}});
    return uint32_t(nodes.size() - 1);
  };
  const auto add_shape = [&](Shape shape, bool in_hull) {
    const Curves chosen = in_hull && (curves == Curves::kAuto || curves == Curves::kSmooth)
                              ? Curves::kFacets
                              : curves;
    const auto facets = [&](int asked, double r) {
      return choose_facets(r, {.fn = double(asked)}, chosen);
    };
    if (auto* sphere = std::get_if<Sphere>(&shape))
      sphere->facets = facets(sphere->facets, sphere->r);
    if (auto* cylinder = std::get_if<Cylinder>(&shape))
      cylinder->facets = facets(cylinder->facets, cylinder->widest_radius());
    model.primitives.push_back({std::move(shape), ++model.statement_count});
    add(NodeKind::kPrimitive, model.primitives.size() - 1);
  };
  const auto add_operation = [&](Operation operation) {
    document.operations.push_back(std::move(operation));
    document.operation_ids.push_back(++model.statement_count);
    return add(NodeKind::kOperation, document.operations.size() - 1);
  };
  const auto open = [&](const Csg::Node& from, bool in_hull) {
    Open opened{&from, 0, uint32_t(nodes.size()), in_hull};
    std::visit(Overloaded{[&](const Shape& shape) { add_shape(shape, in_hull); },
                          [&](const Extrusion& extrusion) {
                            const uint32_t node = add_operation(extrusion.how);
                            document.leaves.push_back(extrusion.outline);
                            document.leaf_ids.push_back(++model.statement_count);
                            add(NodeKind::kLeaf, document.leaves.size() - 1);
                            nodes.back().end = uint32_t(nodes.size());
                            nodes[node].end = uint32_t(nodes.size());
                          },
                          [&](const Combination& combination) { add(combination.kind, 0); },
                          [&](const Hull& hull) {
                            add_operation(hull);
                            opened.in_hull = true;
                          },
                          [&](const Affine& map) {
                            model.transforms.push_back(map);
                            add(NodeKind::kTransform, model.transforms.size() - 1);
                          },
                          [&](const Rgba& color) {
                            model.colors.push_back(color);
                            add(NodeKind::kColor, model.colors.size() - 1);
                          }},
               from.what);
    stack.push_back(opened);
  };

  add(NodeKind::kUnion, 0);
  open(*csg.node_, false);
  while (!stack.empty()) {
    Open& top = stack.back();
    if (top.next < top.from->operands.size()) {
      open(*top.from->operands[top.next++], top.in_hull);
      continue;
    }
    nodes[top.node].end = uint32_t(nodes.size());
    stack.pop_back();
  }
  nodes[0].end = uint32_t(nodes.size());

  Warnings warnings(model.file);
  Model made = value_of(evaluate(std::move(document),
                                 {.curves = curves,
                                  .most_facets = options.limits.facets,
                                  .threads = threads_of(options.threads),
                                  .read_file = nullptr,
                                  .outlines = has_outlines(curves),
                                  .solid_box = box_maker(threads_of(options.threads)),
                                  .closed_mesh = mesh_maker(threads_of(options.threads))},
                                 warnings));
  const bool is_complete = !warnings.unsupported();
  return Solid(
      std::make_shared<const State>(std::move(made), warnings.take(), is_complete, options.style));
}

}  // namespace whittle
