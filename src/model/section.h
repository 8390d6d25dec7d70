// Cuts a model open. What is taken away is subtracted, so that all that can be done with a model
// can be done with one that is cut. Why it is so: docs/decisions/0052-sections.md.
#pragma once

#include <span>
#include <vector>

#include "base/plane.h"
#include "base/result.h"
#include "model/model.h"

namespace whittle {

/// Takes away what lies beyond all of its planes: the points with n.p >= d for each of them. One
/// plane takes a half of space, two a quarter, three an eighth. None takes nothing.
struct Section {
  std::vector<Plane> planes;  ///< normals are unit, and d is at most kFarthestSection either way
};

/// What lies farther out than this cannot be computed with (shapes end at 1e150).
inline constexpr double kFarthestSection = 1e100;

/// The plane where n.p = d, with n as long as it is. A kUsage error if n has no length, or anything
/// is not finite or too far out.
Result<Plane> cutting_plane(Vec3 n, double d);

/// The model without what any of the sections takes away, but for the parts that have one of the
/// colours in `kept` (as near as 8 bits can say; alpha does not count): those stay whole. The
/// colour of a part is that of its surface, the outermost color() above it. A model that is cut may
/// be cut again. A kUsage error if the model is a drawing. Iterative; linear in the model.
Result<Model> cut_open(const Model& model, std::span<const Section> sections,
                       std::span<const Rgba> kept = {});

/// The model as it was before it was cut; a copy.
Model uncut(const Model& model);

/// The number of primitive statements in the file; of a model that is cut, those of the planes are
/// no part of it.
uint32_t written_statements(const Model& model);

}  // namespace whittle
