// The files that a document names, each read once.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "evaluate/budget.h"
#include "evaluate/evaluate.h"
#include "flat/polygons.h"
#include "model/document.h"
#include "model/warnings.h"
#include "shape/triangle_mesh.h"

namespace whittle {

class Files {
 public:
  Files(const EvaluateOptions& options, Budget& budget, Warnings& warnings)
      : options_(options), budget_(budget), warnings_(warnings) {}

  /// What an import() of a flat file stands for; nothing, with a warning, if it cannot be read.
  Polygons flat(const Import& import, SourceLocation where);

  /// The solid of an import() of a mesh, or of a surface(). Null if there is none.
  std::shared_ptr<const TriangleMesh> solid(const Leaf& leaf, SourceLocation where);

 private:
  /// Null, with a warning, if the file cannot be read.
  const std::string* content(const std::string& file, SourceLocation where);
  std::shared_ptr<const TriangleMesh> read_solid(const Leaf& leaf, SourceLocation where);

  const EvaluateOptions& options_;
  Budget& budget_;
  Warnings& warnings_;
  std::map<std::string, std::string> flat_;
  std::map<std::string, std::shared_ptr<const TriangleMesh>> solids_;
};

}  // namespace whittle
