// From what a text says to solids: flat shapes, extrusions, hulls and files become primitives.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "base/box.h"
#include "base/result.h"
#include "model/document.h"
#include "model/model.h"
#include "model/warnings.h"
#include "shape/triangle_mesh.h"
#include "whittle/options.h"

namespace whittle {

struct EvaluateOptions {
  Curves curves = Curves::kAuto;
  /// Of all flat faces together, and of corners that are computed with: more are an error. It names
  /// the limit as the command line does.
  size_t most_facets = ReadLimits{}.facets;
  int threads = 0;  ///< 0: all
  /// The content of a file that the document names, as it names it; none if there is no such file,
  /// which is a warning as in OpenSCAD. Errors say why it cannot be read, without a place. Without
  /// this function no files are read.
  std::function<Result<std::optional<std::string>>(const std::string& file)> read_file;
  /// Whether a drawing gets its outlines.
  bool outlines = false;
  /// The exact box of a solid, for resize(); without it the bounds of its tree stand for it.
  std::function<Box(const Model&)> solid_box;
  /// The boundary of a solid, for hulls and sums of what is cut, and for projections; what is
  /// curved in it has facets. Errors say in words, without a place, why there is none. Without this
  /// function there is never one. `pieces`: set to how many convex pieces it was made of.
  std::function<Result<TriangleMesh>(const Model&, size_t& pieces)> closed_mesh;
};

/// The solid that a document describes, as a model without leaves and operations. Every extrusion,
/// hull and so on becomes one body: a primitive, or a kBody that holds its parts, with the id of
/// its statement. Flat shapes that stand alone at the top are a drawing. What cannot be done is
/// left out or replaced, with a warning of what happened.
///
/// Errors: kInput, `file:line:column: error: ...`, for what passes the limit. Depth costs memory,
/// never stack. A document that holds neither leaves nor operations passes through.
Result<Model> evaluate(Document document, const EvaluateOptions& options, Warnings& warnings);

}  // namespace whittle
