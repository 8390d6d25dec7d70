// The model: what a person wrote, as a tree in one flat array. Nothing numeric happens here.
//
// Nodes stand in preorder: the children of node i are i + 1, then nodes[i + 1].end, and so on, as
// long as they are below nodes[i].end. Walks are loops over the array, so depth costs no stack.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/affine.h"
#include "shape/shape.h"

namespace whittle {

/// A place in the source text; line and column count from 1 (columns in bytes), 0 is nowhere.
struct SourceLocation {
  uint32_t line = 0;
  uint32_t column = 0;
  auto operator<=>(const SourceLocation&) const = default;
};

/// A place in a piece of a text, which begins at `start`, as a place in the whole.
inline SourceLocation place_in_whole(SourceLocation in_piece, SourceLocation start) {
  return {start.line + in_piece.line - 1,
          in_piece.line == 1 ? start.column + in_piece.column - 1 : in_piece.column};
}

struct Primitive {
  Shape shape;
  uint32_t id = 0;  ///< of the body it is, or is a part of: the number of its statement in the
                    ///< file, from 1
};

/// Red, green, blue, alpha in 0..1; a component of -1 is unset, as color() may leave it.
struct Rgba {
  float r = -1, g = -1, b = -1, a = -1;
  bool operator==(const Rgba&) const = default;
  /// OpenSCAD's rule: a colour with any component unset does not count as one.
  bool is_valid() const { return r >= 0 && g >= 0 && b >= 0 && a >= 0; }
};

enum class NodeKind : uint8_t {
  kUnion,         ///< also group, render, and nodes that are not supported
  kDifference,    ///< the first child minus all others
  kIntersection,  ///< of all children; of none it is empty
  kTransform,     ///< union of the children, mapped by transforms[payload]
  kColor,         ///< union of the children, painted colors[payload]
  kPrimitive,     ///< primitives[payload]
  kBody,          ///< union of the children, which are the parts of one body: all have its id
  kOperation,     ///< in a Document only: operations[payload] over the children
  kLeaf,          ///< in a Document only: leaves[payload]
};

inline constexpr size_t kNodeKinds = size_t(NodeKind::kLeaf) + 1;

struct Node {
  NodeKind kind = NodeKind::kUnion;
  bool background = false;  ///< `%`: no part of the solid, and not an operand of its parent
  bool highlight = false;   ///< `#`: part of the solid; a viewer may mark it
  uint32_t end = 0;         ///< index one past the last node of this subtree
  uint32_t payload = 0;     ///< index into the table that `kind` names
  SourceLocation where;
};

/// `$vpt`, `$vpr`, `$vpd`, `$vpf` as assigned at the top level of the file.
struct FileView {
  std::optional<Vec3> target;            ///< $vpt, the point looked at
  std::optional<Vec3> rotation_degrees;  ///< $vpr, OpenSCAD's Euler angles
  std::optional<double> distance;        ///< $vpd, eye to target
  std::optional<double> fov_degrees;     ///< $vpf, vertical
};

/// A model that is flat: its primitives are a slab about the plane z = 0, and what is seen is where
/// the slab meets that plane.
struct Drawing {
  /// Closed loops around all of it together, with OpenSCAD's fragments; none unless they were asked
  /// for.
  std::vector<std::vector<Vec2>> outlines;
};

/// A model that is cut open (model/section.h). The planes' primitives and ids come after all that
/// were written. What a ray meets on a cap, where a plane cuts, is named by whose material it is:
/// those ids come after the planes'.
struct Cut {
  uint32_t first_primitive = 0;              ///< of the planes'
  uint32_t first_plane = 0, last_plane = 0;  ///< their ids; the last is Model::statement_count

  /// Caps of a statement's material.
  uint32_t cap_of(uint32_t statement) const { return last_plane + statement; }
  bool is_plane(uint32_t id) const { return id >= first_plane && id <= last_plane; }
  /// A cap that is known to be somebody's, or the plane itself.
  bool is_cap(uint32_t id) const { return id >= first_plane; }
  /// The statement whose surface it is, or of a cap whose material. The plane itself if that is
  /// not known.
  uint32_t statement_of(uint32_t id) const { return id <= last_plane ? id : id - last_plane; }
};

struct Model {
  std::string file;         ///< for messages; "<stdin>" for standard input
  std::vector<Node> nodes;  ///< preorder; nodes[0] is the implicit union of all statements
  std::vector<Affine> transforms;
  std::vector<Rgba> colors;
  std::vector<Primitive> primitives;  ///< in file order; ids rise, `*` leaves gaps
  uint32_t statement_count = 0;       ///< primitive statements; ids are 1..this
  FileView view;
  std::optional<Drawing> drawing;  ///< if it is one
  std::optional<Cut> cut;          ///< if it is
  /// What `%` marks, where it stands, as a model of its own with this one's ids; null if there is
  /// nothing, or nobody asked for it.
  std::shared_ptr<const Model> background;
};

/// `file:line:column: ` + message, the form of every message about a file.
std::string message_at(const std::string& file, SourceLocation where, const std::string& message);

}  // namespace whittle
