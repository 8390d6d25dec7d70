// What pictures show of a model if parts of it are see-through: solids that are seen one through
// another.
//
// The solid is one Boolean result, and so has no surface where an opaque part stands in a
// see-through one. So the union is taken apart: what is opaque is one solid, and of what is
// see-through each colour is one. A difference is divided with what it cuts, an intersection with
// the one operand that is see-through. Together the layers are the solid.
// Why: docs/decisions/0051-see-through.md.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "model/instances.h"
#include "model/model.h"

namespace whittle {

/// OpenSCAD's colours for what `%` and `#` mark.
inline constexpr Rgba kGhostColor{180.0f / 255, 180.0f / 255, 180.0f / 255, 128.0f / 255};
inline constexpr Rgba kHighlightColor{1, 81.0f / 255, 81.0f / 255, 128.0f / 255};

/// Colours that have a solid of their own. What has others is one solid.
inline constexpr size_t kMostSeeThroughColors = 16;

enum class LayerKind : uint8_t {
  kPart,       ///< of the solid
  kGhost,      ///< what `%` marks
  kHighlight,  ///< what `#` marks
};

/// A solid whose surfaces are seen in front of, and behind, what they do not hide.
struct Layer {
  LayerKind kind = LayerKind::kPart;
  Model model;  ///< ids are the whole model's
};

struct Layers {
  bool is_whole = true;  ///< the opaque part is all of the solid; `opaque` is not set then
  Model opaque;
  std::vector<Layer> see_through;
  bool has_many_colors = false;  ///< more than kMostSeeThroughColors
  bool is_plain() const { return is_whole && see_through.empty(); }
};

struct LayerSettings {
  bool ghosts = false;           ///< what `%` and `#` mark is shown
  bool thrown_together = false;  ///< bodies are shown as they are, cutters too
};

/// Takes a model apart. `looks` are its appearances().
Layers layers_of(const Model& model, std::span<const Appearance> looks,
                 const LayerSettings& settings);

/// How the surfaces of ghosts, and of highlights, are painted, by id.
std::vector<Appearance> ghost_looks(const Model& ghosts);
std::vector<Appearance> highlight_looks(const Model& highlights);

}  // namespace whittle
