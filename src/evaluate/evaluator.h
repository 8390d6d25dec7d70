// The walk over a document that makes a model of it.
//
// One pass over the tree, with the open nodes on a stack. A node becomes one of four things, as the
// nodes around it demand: nodes of the model; nodes of the model whose flat shapes are extruded as
// they are; polygons; parts of solids; or polygons where solids are cut by z = 0. Polygons and
// parts wait on stacks of their own for the operation that takes them; unions leave them lying
// there, so that they cost nothing. What is cut, where parts are wanted, and what is projected
// becomes a model of its own, of which the boundary is asked for when it is closed.
#pragma once

#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "evaluate/budget.h"
#include "evaluate/dimensions.h"
#include "evaluate/evaluate.h"
#include "evaluate/files.h"
#include "evaluate/flat_values.h"
#include "evaluate/solid_parts.h"
#include "flat/polygons.h"
#include "model/document.h"

namespace whittle {

/// What projections have come to, by node: a second walk finds them here, and their solids gone.
using Projections = std::unordered_map<uint32_t, Polygons>;

class Evaluator {
 public:
  /// All of them must outlive it.
  Evaluator(Document& document, const EvaluateOptions& options, Budget& budget, Warnings& warnings,
            Projections& projections);

  /// The model; if the budget is spent, of no use, and `where` is where that was.
  Model run(SourceLocation& where);

  /// In its place, of what is flat at the top: all of it as one. Of the budget and the place the
  /// same holds.
  std::vector<Contour> outlines(SourceLocation& where);

 private:
  static constexpr uint32_t kNone = UINT32_MAX;

  /// kFlat and kSection leave polygons, the latter where solids are cut by z = 0.
  enum class Mode : uint8_t { kSolid, kEmbedded, kFlat, kParts, kSection };

  /// A node whose children are being evaluated.
  struct Frame {
    uint32_t node = 0;
    Mode mode = Mode::kSolid;    ///< what the children become
    bool separate = false;       ///< polygons, parts: each child is an operand of its own
    bool wants_surface = false;  ///< parts: with the surface of those that are not convex
    bool is_facetted = false;    ///< curves in it have OpenSCAD's facets, whatever was chosen
    bool has_model = false;      ///< what it holds is a model of its own
    bool warned = false;         ///< that a child's dimension is another
    uint32_t operands = 0;       ///< children so far
    uint32_t out = kNone;        ///< its node in the model
    uint32_t body = 0;           ///< embedded: the id of all parts; 0: each its own
    size_t first_polygons = 0;   ///< where its own begin on the stack
    size_t first_parts = 0;      ///< likewise
    double height = 1;           ///< embedded: of the extrusion, from z = 0
    Affine map;  ///< polygons, parts: into the space of the operation that takes them
  };

  static bool has_polygons(const Frame& frame) {
    return frame.mode == Mode::kFlat || frame.mode == Mode::kSection;
  }
  const Node& node_of(const Frame& frame) const { return document_.model.nodes[frame.node]; }
  template <class T>
  const T* operation(const Frame& frame) const {
    const Node& node = node_of(frame);
    if (node.kind != NodeKind::kOperation) return nullptr;
    return std::get_if<T>(&document_.operations[node.payload]);
  }

  // evaluator.cpp: the walk.
  void walk(SourceLocation& where);
  Frame root_frame();
  void close_root(const Frame& root);
  uint32_t enter(uint32_t i);
  bool admit_dimension(uint32_t i);
  void leave_out(uint32_t i);
  uint32_t enter_leaf(uint32_t i);
  uint32_t enter_group(uint32_t i);
  bool map_of(uint32_t i, Frame& frame);
  int facets_of(double r, FragmentSettings settings) const;
  void close();
  void finish_child(const Frame& child);
  uint32_t begin_node(NodeKind kind, uint32_t payload, const Node& from);
  void add_shape(Shape shape, uint32_t id, const Node& from);
  void add_embedded(const Polygons& polygons, uint32_t id, const Node& from);
  void warn_once(uint32_t node, std::string_view message);
  void refuse(uint32_t node, std::string_view message, std::string_view what);

  // operations.cpp: what operations do when they open and close.
  uint32_t enter_operation(uint32_t i);
  bool open_operation(uint32_t i, Frame& frame);
  bool open_linear_extrude(uint32_t i, const LinearExtrude& how, Frame& frame);
  void close_operation(const Frame& frame);
  void close_linear_extrude(const Frame& frame, const LinearExtrude& how);
  void close_rotate_extrude(const Frame& frame, const RotateExtrude& how);
  void close_hull(const Frame& frame);
  void close_minkowski(const Frame& frame);
  void close_projection(const Frame& frame, const Projection& how);
  void close_resize(const Frame& frame, const Resize& how);
  void add_revolution(const Frame& frame, const RotateExtrude& how, const Polygons& profile);
  Polygons take_united(const Frame& frame);
  std::vector<Polygons> take_polygons(const Frame& frame);
  std::vector<SolidPart> take_parts(const Frame& frame);
  void give(const Frame& frame, Polygons polygons);
  void give(const Frame& frame, Shape shape);
  void give(const Frame& frame, SolidPart part);

  // own_models.cpp: what must be evaluated before others can use it.
  void open_model(uint32_t i, Frame& frame);
  Model close_model();
  TriangleMesh boundary_of(const Model& model, const Frame& frame);
  Polygons shadow_of(const Model& model, const Frame& frame);

  Document& document_;
  const EvaluateOptions& options_;
  Budget& budget_;
  Warnings& warnings_;
  Files files_;
  FlatLeaves leaves_;
  std::vector<Dimension> dimensions_;
  std::vector<bool> warned_;  ///< nodes that have had their warning
  std::vector<Frame> open_;
  std::vector<Polygons> polygons_;
  std::vector<SolidPart> parts_;
  Model out_;                 ///< the one at hand
  std::vector<Model> outer_;  ///< those around it
  Projections& projections_;
  uint32_t next_ = 1;  ///< the node that comes next
};

}  // namespace whittle
