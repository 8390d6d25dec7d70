#include "image/pov.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <span>
#include <vector>

#include "model/instances.h"
#include "shape/shape.h"

namespace whittle {
namespace {

constexpr uint32_t kNoInstance = ~uint32_t{0};

using Out = std::back_insert_iterator<std::string>;

std::string vec(Vec3 v) {
  return fmt::format("<{:.17g}, {:.17g}, {:.17g}>", v.x, v.y, v.z);
}

std::string rgb(Vec3f c) {
  return fmt::format("rgb <{:.7g}, {:.7g}, {:.7g}>", c.x, c.y, c.z);
}

void write_facets(Out out, const Shape& shape) {
  fmt::format_to(out, "intersection {{\n");
  for (const Plane& p : facet_planes(shape)) {
    fmt::format_to(out, "  plane {{ {}, {:.17g} }}\n", vec(p.n), p.d);
  }
  Box box;
  for (const Vec3& v : outline(shape)) box.include(v);
  // POV-Ray finds no bounds for planes by itself. The margin keeps the box off the faces.
  const Vec3 margin = Vec3{1, 1, 1} * (1e-3 * box.diagonal());
  fmt::format_to(out, "  bounded_by {{ box {{ {}, {} }} }}\n", vec(box.lo - margin),
                 vec(box.hi + margin));
}

/// Opens the object of a shape; its modifiers and the closing brace are the caller's.
struct ShapeWriter {
  Out out;
  const Shape& shape;

  void operator()(const Cube& c) const {
    const Vec3 lo = c.center ? c.size * -0.5 : Vec3{};
    fmt::format_to(out, "box {{ {}, {}\n", vec(lo), vec(lo + c.size));
  }
  void operator()(const Sphere& s) const {
    if (s.facets != 0) return write_facets(out, shape);
    fmt::format_to(out, "sphere {{ <0, 0, 0>, {:.17g}\n", s.r);
  }
  void operator()(const Cylinder& c) const {
    if (c.facets != 0) return write_facets(out, shape);
    const double z = c.center ? -c.h / 2 : 0;
    const std::string lower = vec({0, 0, z}), upper = vec({0, 0, z + c.h});
    if (c.r1 == c.r2) {
      fmt::format_to(out, "cylinder {{ {}, {}, {:.17g}\n", lower, upper, c.r1);
    } else {
      fmt::format_to(out, "cone {{ {}, {:.17g}, {}, {:.17g}\n", lower, c.r1, upper, c.r2);
    }
  }
  void operator()(const Polyhedron&) const { write_facets(out, shape); }
  void operator()(const Mesh& m) const {
    fmt::format_to(out, "mesh {{\n");
    for (const TriangleMesh::Triangle& t : m.surface->triangles) {
      const auto corner = [&](int k) { return vec(m.surface->points[t.corners[size_t(k)]]); };
      fmt::format_to(out, "  triangle {{ {}, {}, {} }}\n", corner(0), corner(1), corner(2));
    }
    // What makes a mesh of POV-Ray a solid; a direction that no model favours.
    fmt::format_to(out, "  inside_vector <0.3, 0.5, 0.8>\n");
  }
  void operator()(const Halfspace& h) const {
    const double scale = 1 / length(h.n);
    fmt::format_to(out, "plane {{ {}, {:.17g}\n", vec(h.n * scale), h.d * scale);
  }
};

/// POV-Ray's matrix maps rows: the images of the axes, then the translation.
void write_matrix(Out out, const Affine& a) {
  if (a == Affine{}) return;
  fmt::format_to(out, "  matrix <");
  for (int k = 0; k < 3; ++k) {
    fmt::format_to(out, "{:.17g}, {:.17g}, {:.17g}, ", a.row[0][k], a.row[1][k], a.row[2][k]);
  }
  fmt::format_to(out, "{:.17g}, {:.17g}, {:.17g}>\n", a.translation.x, a.translation.y,
                 a.translation.z);
}

/// What a node is to POV-Ray, which knows no empty set and wants two operands of an operator.
struct Operands {
  bool empty = true;
  uint32_t count = 0;  ///< operands that are not empty; with one alone the node is that operand
};

/// Bottom-up over the preorder array: children stand after their parents. `instance_of` holds the
/// index of each primitive node's instance.
std::vector<Operands> count_operands(const Model& model, std::span<const Instance> solids,
                                     std::span<const uint32_t> instance_of) {
  std::vector<Operands> all(model.nodes.size());
  for (uint32_t i = uint32_t(model.nodes.size()); i-- > 0;) {
    const Node& node = model.nodes[i];
    Operands& own = all[i];
    if (node.kind == NodeKind::kPrimitive) {
      own.empty = instance_of[i] == kNoInstance || solids[instance_of[i]].empty;
      continue;
    }
    bool none = true, any_empty = false, first_empty = true;
    for (uint32_t c = i + 1; c < node.end; c = model.nodes[c].end) {
      if (model.nodes[c].background) continue;
      if (none) first_empty = all[c].empty;
      none = false;
      any_empty |= all[c].empty;
      own.count += !all[c].empty;
    }
    switch (node.kind) {
      case NodeKind::kDifference:
        own.empty = first_empty;
        break;
      case NodeKind::kIntersection:
        own.empty = none || any_empty;
        break;
      default:
        own.empty = own.count == 0;
    }
  }
  return all;
}

const char* operator_name(NodeKind kind) {
  switch (kind) {
    case NodeKind::kDifference:
      return "difference";
    case NodeKind::kIntersection:
      return "intersection";
    default:
      return "union";
  }
}

void write_solid(Out out, const Model& model, const ColorScheme& scheme) {
  const std::vector<Instance> solids = instances(model);
  const std::vector<Appearance> looks = appearances(model);
  std::vector<uint32_t> instance_of(model.nodes.size(), kNoInstance);
  for (size_t k = 0; k < solids.size(); ++k) instance_of[solids[k].node] = uint32_t(k);
  const std::vector<Operands> operands = count_operands(model, solids, instance_of);

  std::vector<uint32_t> open;  ///< ends of the operators whose brace is open
  const auto close_until = [&](uint32_t i) {
    for (; !open.empty() && open.back() <= i; open.pop_back()) {
      fmt::format_to(out, "{}}}\n", open.size() == 1 ? "  no_shadow\n" : "");
    }
  };
  for (uint32_t i = 0; i < model.nodes.size();) {
    close_until(i);
    const Node& node = model.nodes[i];
    if (node.background || operands[i].empty) {
      i = node.end;
      continue;
    }
    if (node.kind == NodeKind::kPrimitive) {
      const Instance& instance = solids[instance_of[i]];
      const Primitive& primitive = model.primitives[instance.primitive];
      std::visit(ShapeWriter{out, primitive.shape}, primitive.shape);
      write_matrix(out, instance.world_from_object);
      fmt::format_to(out, "  pigment {{ {} }}{}\n}}\n",
                     rgb(base_color(looks[primitive.id], scheme)),
                     open.empty() ? "\n  no_shadow" : "");
    } else if (operands[i].count > 1) {
      fmt::format_to(out, "{} {{\n", operator_name(node.kind));
      open.push_back(node.end);
    }
    ++i;
  }
  close_until(uint32_t(model.nodes.size()));
}

void write_camera(Out out, const Camera& camera) {
  const double height = 2 * camera.half_height, width = height * camera.width / camera.height;
  // POV-Ray's orthographic rays start in the camera's plane, ours further behind.
  const Vec3 location = camera.eye - camera.forward * camera.ortho_reach;
  fmt::format_to(out, "camera {{ {} location {} direction {}\n  right {} up {} }}\n",
                 camera.orthographic ? "orthographic" : "perspective", vec(location),
                 vec(camera.forward), vec(camera.right * width), vec(camera.up * height));
}

}  // namespace

Result<std::string> write_pov(const Model& model, const Camera& camera,
                              const ShadeSettings& settings) {
  const Vec3 light = settings.light.value_or(camera.eye);
  if (!is_finite(camera.eye) || !is_finite(camera.forward) || !std::isfinite(camera.half_height)) {
    return Error{ErrorKind::kUsage, "the camera is not finite"};
  }
  if (!is_finite(light)) return Error{ErrorKind::kUsage, "the light is not finite"};
  ShadeSettings blinn = settings;
  blinn.style = Style::kBlinn;
  const ColorScheme scheme = effective_scheme(blinn);

  std::string text;
  const Out out = std::back_inserter(text);
  fmt::format_to(
      out,
      "// Made by whittle. To get the values that whittle --style blinn computes:\n"
      "// povray +I<this file> +O<picture>.png +W{} +H{} +FN8 -A -D\n"
      "#version 3.7;\n"
      "global_settings {{ assumed_gamma srgb ambient_light rgb 1 }}\n"
      "#default {{ finish {{ ambient {:.7g} diffuse {:.7g} specular {:.7g} roughness 1/{} }} }}\n"
      "background {{ {} }}\n",
      camera.width, camera.height, kBlinnAmbient, kBlinnDiffuse, kBlinnSpecular, kBlinnExponent,
      rgb(to_unit(scheme.background_top)));
  write_camera(out, camera);
  fmt::format_to(out, "light_source {{ {} rgb 1 }}\n", vec(light));
  write_solid(out, model, scheme);
  return text;
}

}  // namespace whittle
