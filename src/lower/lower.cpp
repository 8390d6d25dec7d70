#include "lower/lower.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lower/merge.h"
#include "lower/primitive_faces.h"
#include "model/instances.h"
#include "shape/shape.h"

namespace whittle {
namespace {

/// Below this many faces a primitive is classified face by face anyway, and a ball inside it or
/// boxes around its facets would save nothing.
constexpr uint32_t kManyFaces = 12;

/// Corners move by more than the faces that meet there.
constexpr double kCornersMore = 10;

Box grown(const Box& box, double margin) {
  const Vec3 all{margin, margin, margin};
  return {box.lo - all, box.hi + all};
}

/// Grows the boxes of a primitive's facets by a share of their diagonal and by a length, both
/// local.
void grow_face_boxes(const Unit& unit, double share, double more, Scene& scene) {
  const Affine& object_from_local = scene.box_frames[unit.box_frame];
  const Affine local_from_object = inverse(object_from_local);
  const auto times = [](const Affine& map, Vec3 v) {
    return Vec3{dot(abs(map.row[0]), v), dot(abs(map.row[1]), v), dot(abs(map.row[2]), v)};
  };
  const Vec3 each{length(object_from_local.row[0]), length(object_from_local.row[1]),
                  length(object_from_local.row[2])};
  for (uint32_t i = 0; i < unit.face_count; ++i) {
    Box& box = scene.face_boxes[unit.first_box + i];
    const Vec3 by = each * (share * length(times(local_from_object, box.size())) + more);
    box = {box.lo - by, box.hi + by};
  }
}

/// Merging may move a plane by the tolerance, and so a facet's corner by much more where it meets
/// its neighbours at small angles. So may the digits of a file, but for bodies that are made of
/// numbers. Boxes that are too large only cost time.
void grow_for_moved_planes(const Unit& unit, double moved, Scene& scene) {
  grow_face_boxes(unit, 0.05, kCornersMore * moved, scene);
}

/// `moved`: by how much merging may move a face of it.
void add_face_boxes(const Shape& shape, const Affine& local_from_object, double moved, Unit& unit,
                    Scene& scene) {
  const std::vector<Box> boxes = facet_boxes(shape);
  if (boxes.size() != unit.face_count) return;
  unit.first_box = uint32_t(scene.face_boxes.size());
  unit.box_frame = uint32_t(scene.box_frames.size());
  scene.box_frames.push_back(inverse(local_from_object));
  scene.face_boxes.insert(scene.face_boxes.end(), boxes.begin(), boxes.end());
  if (is_exact(shape))
    grow_face_boxes(unit, 1e-4, 0, scene);
  else
    grow_for_moved_planes(unit, moved, scene);
}

/// Gives faces their half-spaces. Those are numbered in the order of the faces: one that does not
/// bring the next new one lies on an earlier one, and its primitive's boxes grow by as much as that
/// may have moved it.
void take_half_spaces(FaceMerger::Merged merged, Scene& scene) {
  scene.half_spaces = std::move(merged.half_spaces);
  uint32_t next = 0;
  for (Unit& unit : scene.units) {
    bool moved = false;
    float by = 0;
    for (uint32_t k = 0; k < unit.face_count; ++k) {
      Literal& literal = scene.faces[unit.first_face + k].literal;
      by = std::max(by, merged.moved[literal >> 1]);
      literal = merged.literals[literal >> 1] ^ (literal & 1);
      const bool is_new = literal == 2 * next;
      next += is_new;
      moved |= !is_new;
    }
    if (by > 0) unit.outer = grown(unit.outer, kCornersMore * by);
    if (moved && unit.first_box != Unit::kNoBoxes) grow_for_moved_planes(unit, by, scene);
  }
}

/// Once faces have their half-spaces: how far the triangles of boundaries are from them.
void measure_slacks(Scene& scene, double least_tolerance) {
  for (Boundary& boundary : scene.boundaries)
    boundary.measure_slack(least_tolerance, scene.region, [&](uint32_t face, Vec3 p) {
      const HalfSpace& h = scene.half_spaces[scene.faces[face].literal >> 1];
      return std::fabs(Kernels<double>::quadric_value(h.f, p - h.center));
    });
}

/// The outlines of curved surfaces, made again when they are asked for: that is seldom, and those
/// of a million spheres would take more memory than all else.
class Outlines {
 public:
  Outlines(const Model& model, const Scene& scene) : model_(model), scene_(scene) {}

  Outline of(uint32_t surface) {
    return [this, surface](const auto& test) {
      if (instances_.empty()) prepare();
      const auto lies_before = [this](uint32_t face, uint32_t number) {
        return scene_.faces[face].literal >> 1 < number;
      };
      const auto first = std::lower_bound(faces_.begin(), faces_.end(), surface, lies_before);
      const auto last = std::lower_bound(first, faces_.end(), surface + 1, lies_before);
      return std::all_of(first, last, [&](uint32_t face) {
        // Units are in the order of the instances.
        const Instance& instance = instances_[scene_.faces[face].unit];
        points_ = outline(model_.primitives[instance.primitive].shape);
        const Affine local_from_object = translation(-scene_.origin) * instance.world_from_object;
        for (Vec3& p : points_) p = local_from_object.point(p);
        return test(points_);
      });
    };
  }

 private:
  void prepare() {
    instances_ = instances(model_);
    faces_.resize(scene_.faces.size());
    std::iota(faces_.begin(), faces_.end(), 0);
    std::stable_sort(faces_.begin(), faces_.end(), [this](uint32_t a, uint32_t b) {
      return scene_.faces[a].literal >> 1 < scene_.faces[b].literal >> 1;
    });
  }

  const Model& model_;
  const Scene& scene_;
  std::vector<Instance> instances_;
  std::vector<uint32_t> faces_;  ///< by surface
  std::vector<Vec3> points_;
};

/// Walks the model in preorder and writes the formula with negation pushed to the literals.
class FormulaBuilder {
 public:
  FormulaBuilder(const Model& model, const std::vector<uint32_t>& unit_of_node, Scene& scene)
      : model_(model), scene_(scene), unit_of_node_(unit_of_node) {}

  /// Writes the scene's formula, and which units are inward. Fails if the formula outgrows a
  /// token's payload.
  bool build() {
    Formula& out = scene_.formula;
    uint32_t i = 0;
    const uint32_t end = uint32_t(model_.nodes.size());
    while (i < end) {
      while (!open_.empty() && open_.back().node_end == i) close(out);
      const Node& node = model_.nodes[i];
      if (node.background) {
        i = node.end;
        continue;
      }
      const bool negated = next_operand_negated();
      if (node.kind == NodeKind::kPrimitive) {
        primitive(i, negated, out);
        i = node.end;
      } else {
        open(i, negated, out);
        ++i;
      }
      if (out.size() >= Token::kMaxPayload) return false;
    }
    while (!open_.empty()) close(out);
    return true;
  }

 private:
  struct Open {
    uint32_t node_end;
    TokenKind kind;
    bool negated;
    bool difference;   ///< the operands after the first are negated
    bool saw_operand;  ///< the first operand is behind us
    bool has_header;   ///< false: its operands belong to the group around it
    uint32_t header;
    bool is_in_body;    ///< it is a body of several parts, or in one
    bool body_negated;  ///< that body's sign
  };

  bool next_operand_negated() {
    if (open_.empty()) return false;
    Open& group = open_.back();
    const bool flip = group.difference && group.saw_operand;
    group.saw_operand = true;
    return group.negated != flip;
  }

  void open(uint32_t i, bool negated, Formula& out) {
    const Node& node = model_.nodes[i];
    const bool conjunction =
        node.kind == NodeKind::kIntersection || node.kind == NodeKind::kDifference;
    // An intersection or difference of nothing is empty, like a union of nothing; as a conjunction
    // it would be everything.
    const bool and_group = conjunction && has_operand(i) ? !negated : negated;
    const TokenKind kind = and_group ? TokenKind::kAnd : TokenKind::kOr;
    const bool has_header = open_.empty() || open_.back().kind != kind;
    const bool is_inside_body = !open_.empty() && open_.back().is_in_body;
    const bool is_in_body = is_inside_body || node.kind == NodeKind::kBody;
    const bool body_negated = is_inside_body ? open_.back().body_negated : negated;
    open_.push_back({node.end, kind, negated, node.kind == NodeKind::kDifference, false, has_header,
                     uint32_t(out.size()), is_in_body, body_negated});
    if (has_header) out.push_back(Token::make(kind, 0));
  }

  bool has_operand(uint32_t i) const {
    for (uint32_t child = i + 1; child < model_.nodes[i].end; child = model_.nodes[child].end)
      if (!model_.nodes[child].background) return true;
    return false;
  }

  void close(Formula& out) {
    const Open& group = open_.back();
    if (group.has_header)
      out[group.header] = Token::make(group.kind, uint32_t(out.size()) - group.header);
    open_.pop_back();
  }

  void primitive(uint32_t i, bool negated, Formula& out) {
    const uint32_t u = unit_of_node_[i];
    const Open& around = open_.back();
    scene_.units[u].inward = around.is_in_body && around.body_negated != negated;
    const uint32_t faces = scene_.units[u].face_count;
    if (faces == 0)  // empty: false, or true under a negation
      out.push_back(Token::make(negated ? TokenKind::kAnd : TokenKind::kOr, 1));
    else if (faces == 1 && scene_.units[u].is_conjunction())
      out.push_back(Token::make(TokenKind::kFace, scene_.units[u].first_face, negated));
    else
      out.push_back(Token::make(TokenKind::kUnit, u, negated));
  }

  const Model& model_;
  Scene& scene_;
  const std::vector<uint32_t>& unit_of_node_;
  std::vector<Open> open_;
};

}  // namespace

Result<Scene> lower(const Model& model) {
  const Bounds model_bounds = bounds(model);
  const Box region = view_region(model_bounds);
  Scene scene;
  scene.bounded = model_bounds.bounded;
  scene.tolerance = tolerance(model_bounds);
  const auto too_large = [&] {
    return Error{ErrorKind::kMachine, model.file + ": error: more than " +
                                          std::to_string(Token::kMaxPayload) +
                                          " faces or operands, which is all whittle can number"};
  };
  if (region.is_empty()) {
    scene.formula = {Token::make(TokenKind::kOr, 1)};
    return scene;
  }
  scene.origin = region.center();
  scene.region = {region.lo - scene.origin, region.hi - scene.origin};

  const Affine local_from_world = translation(-scene.origin);
  const double least_tolerance = ray_tolerance(region);
  FaceMerger merger(scene.region, scene.tolerance, least_tolerance);
  std::vector<uint32_t> unit_of_node(model.nodes.size(), 0);
  LoweredPrimitive lowered;
  scene.units.reserve(model.primitives.size());
  scene.faces.reserve(model.primitives.size());
  InstanceWalk walk(model);
  while (const Instance* next = walk.next()) {
    const Instance& instance = *next;
    const Primitive& primitive = model.primitives[instance.primitive];
    Unit unit;
    unit.id = primitive.id;
    unit.first_face = uint32_t(scene.faces.size());
    lowered.half_spaces.clear();
    if (!instance.empty)
      lower_primitive(primitive.shape, local_from_world * instance.world_from_object, lowered);
    const uint32_t number = uint32_t(scene.units.size());
    const Extent extent = within(lowered.extent, scene.region);
    const double tolerance = own_tolerance(scene.tolerance, extent, least_tolerance);
    const double moved = joint_tolerance(scene.tolerance, extent.width, least_tolerance);
    const Reach reach = {extent.center, extent.radius, extent.width, tolerance,
                         lowered.is_ball ? lowered.extent.radius : 0};
    const Outline its_outline = [&](const auto& test) { return test(lowered.outline); };
    if (lowered.tip && !lowered.half_spaces.empty()) {
      lowered.half_spaces[0].tip = uint32_t(scene.tips.size());
      scene.tips.push_back(*lowered.tip);
    }
    for (const HalfSpace& half_space : lowered.half_spaces)
      scene.faces.push_back({merger.add(half_space, reach, its_outline), number});
    if (const TriangleMesh* mesh = boundary(primitive.shape); mesh && !instance.empty) {
      const Affine local_from_mesh = local_from_world * instance.world_from_object;
      const Affine mesh_from_local = inverse(local_from_mesh);
      const Vec3 middle = mesh_from_local.point(lowered.extent.center);
      for (const Plane& facet : mesh->facets)
        scene.faces.push_back(
            {merger.add(facet_half_space(facet, middle, local_from_mesh, mesh_from_local), reach,
                        its_outline),
             number});
      unit.boundary = uint32_t(scene.boundaries.size());
      scene.boundaries.emplace_back(*mesh, local_from_mesh, unit.first_face);
    }
    unit.face_count = uint32_t(scene.faces.size()) - unit.first_face;
    if (unit.face_count > 0) {
      // What moves a body's faces further is known once all are there.
      const double off =
          is_exact(primitive.shape) ? equal_tolerance(tolerance, least_tolerance) : moved;
      unit.outer =
          grown(transform(local_from_world, instance_box(model, instance)), kCornersMore * off);
    }
    if (unit.is_conjunction() && unit.face_count >= kManyFaces) {
      unit.inner_center = lowered.extent.center;
      unit.inner_radius = std::max(0.0, lowered.extent.width / 2 - moved);
      add_face_boxes(primitive.shape, local_from_world * instance.world_from_object, moved, unit,
                     scene);
    }
    if (scene.faces.size() >= Token::kMaxPayload) return too_large();
    unit_of_node[instance.node] = number;
    scene.units.push_back(unit);
  }
  lowered = {};
  Outlines outlines(model, scene);
  take_half_spaces(merger.merge([&](uint32_t surface) { return outlines.of(surface); }), scene);
  measure_slacks(scene, least_tolerance);
  if (!FormulaBuilder(model, unit_of_node, scene).build()) return too_large();
  return scene;
}

}  // namespace whittle
