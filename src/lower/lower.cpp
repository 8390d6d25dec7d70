#include "lower/lower.h"

#include <cmath>

#include "lower/merge_faces.h"
#include "lower/unit_maker.h"
#include "model/instances.h"
#include "shape/shape.h"

namespace whittle {
namespace {

/// Models with fewer nodes and facets than this are lowered on one thread.
constexpr size_t kManyParts = 8192;

bool is_large(const Model& model) {
  size_t parts = model.nodes.size();
  for (size_t i = 0; i < model.primitives.size() && parts < kManyParts; ++i)
    parts += facet_count(model.primitives[i].shape);
  return parts >= kManyParts;
}

/// Once faces have their half-spaces: how far the triangles of boundaries are from them.
void measure_slacks(Scene& scene, double least_tolerance, const Workers* workers) {
  for (Boundary& boundary : scene.boundaries)
    boundary.measure_slack(least_tolerance, scene.region, workers, [&](uint32_t face, Vec3 p) {
      const HalfSpace& h = scene.half_spaces[scene.faces[face].literal >> 1];
      return std::fabs(Kernels<double>::quadric_value(h.f, p - h.center));
    });
}

/// Walks the model in preorder and writes the formula with negation pushed to the literals.
class FormulaBuilder {
 public:
  FormulaBuilder(const Model& model, Scene& scene) : model_(model), scene_(scene) {}

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
        primitive(negated, out);
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

  void primitive(bool negated, Formula& out) {
    const uint32_t u = next_unit_++;
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
  std::vector<Open> open_;
  uint32_t next_unit_ = 0;  ///< units are in the order of the nodes
};

}  // namespace

Result<Scene> lower(const Model& model, const Workers* workers) {
  if (!is_large(model)) workers = nullptr;
  Scene scene;
  UnitMaker made(model, workers);
  const Bounds model_bounds = made.measure(scene);
  const Box region = view_region(model_bounds);
  scene.bounded = model_bounds.bounded;
  scene.tolerance = tolerance(model_bounds);
  const auto too_large = [&] {
    return Error{ErrorKind::kMachine, model.file + ": error: more than " +
                                          std::to_string(Token::kMaxPayload) +
                                          " faces or operands, which is all whittle can number"};
  };
  if (region.is_empty()) {
    scene.units.clear();
    scene.formula = {Token::make(TokenKind::kOr, 1)};
    return scene;
  }
  if (made.face_count() >= Token::kMaxPayload) return too_large();
  scene.origin = region.center();
  scene.region = {region.lo - scene.origin, region.hi - scene.origin};
  const double least_tolerance = ray_tolerance(region);
  made.make(scene, least_tolerance);
  merge_faces(model, made, least_tolerance, workers, scene);
  measure_slacks(scene, least_tolerance, workers);
  if (!FormulaBuilder(model, scene).build()) return too_large();
  return scene;
}

}  // namespace whittle
