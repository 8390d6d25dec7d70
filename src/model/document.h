// What a .csg text says, before flat shapes, extrusions, hulls and files have become bodies.
//
// A document is a model whose tree may also hold two kinds of nodes that no later stage knows:
// leaves, which are flat or come from files, and operations, which make one body of what they hold.
// src/evaluate turns it into a model.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "model/facets.h"
#include "model/model.h"
#include "model/statement_counts.h"

namespace whittle {

// Leaves. Flat shapes lie in the plane z = 0; a size that is not positive and finite makes them
// empty. $fn, $fa and $fs are as they hold for the statement.

struct Square {
  Vec2 size{1, 1};
  bool center = false;  ///< true: centred on the origin; false: lowest corner at the origin
};

struct Circle {
  double r = 1;
  FragmentSettings fragments;
};

/// Several paths combine even-odd. Without paths all points in their order are one.
struct Polygon {
  std::vector<Vec2> points;
  std::optional<std::vector<std::vector<uint32_t>>> paths;  ///< indices below points.size()
};

struct Text {
  std::string text;  ///< UTF-8
  double size = 10, spacing = 1;
  std::string font, direction, language, script;  ///< empty: OpenSCAD's default
  std::string halign, valign;
  FragmentSettings fragments;
};

/// A file: flat (.svg, .dxf) or a mesh (.stl, .off, .obj, .3mf, .amf), as its name ends.
struct Import {
  std::string file;  ///< as written; relative to the folder of the document
  std::optional<std::string> layer, id;
  Vec2 origin;
  double dpi = 72, scale = 1;
  bool center = false;
  FragmentSettings fragments;
};

/// surface(): a height map from a text or a PNG file.
struct HeightMap {
  std::string file;
  bool center = false, invert = false;
};

using Leaf = std::variant<Square, Circle, Polygon, Text, Import, HeightMap>;

// Operations over the union of the children, or over the children one by one.

struct LinearExtrude {
  double height = 100;
  std::optional<Vec3> direction;  ///< `v`, unit; none: +z. The extrusion vector is height times it
  bool center = false;            ///< centres on half the extrusion vector
  double twist_degrees = 0;       ///< clockwise from the bottom to the top
  std::optional<double> slices, segments;
  Vec2 scale{1, 1};  ///< of the top against the bottom
  FragmentSettings fragments;
};

struct RotateExtrude {
  double angle_degrees = 360, start_degrees = 180;
  FragmentSettings fragments;
};

struct Offset {
  double delta = 1;      ///< outwards; negative: inwards
  bool round = true;     ///< r: arcs at corners. false: delta, which keeps corners
  bool chamfer = false;  ///< with delta: corners are cut off
  FragmentSettings fragments;
};

struct Resize {
  Vec3 size;                        ///< of the box; 0: as it is
  std::array<bool, 3> automatic{};  ///< where size is 0: in proportion
};

struct Projection {
  bool cut = false;  ///< true: what lies in z = 0; false: the shadow on it
};

struct Hull {};
struct Minkowski {};
struct Fill {};
struct Roof {};

using Operation = std::variant<LinearExtrude, RotateExtrude, Offset, Resize, Projection, Hull,
                               Minkowski, Fill, Roof>;

struct Document {
  /// Its nodes may be of all kinds. statement_count counts the leaves and the operations too.
  Model model;
  std::vector<Leaf> leaves;
  std::vector<Operation> operations;
  std::vector<uint32_t> leaf_ids, operation_ids;  ///< one a leaf and one an operation
  StatementCounts counts;
};

}  // namespace whittle
