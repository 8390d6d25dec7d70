// The model as a scene for POV-Ray 3.7, so that its picture can be laid beside ours.
#pragma once

#include <string>

#include "base/result.h"
#include "image/shade.h"
#include "model/model.h"
#include "trace/camera.h"

namespace whittle {

/// The scene text: the same solid with the colours of its primitives, the same camera and picture
/// shape, one shadowless positional light and Blinn highlights as Style::kBlinn has them, whatever
/// `settings.style` is; light, scheme and background count. Rendered as its first lines say
/// (no gamma), the 8-bit values are comparable with shade()'s. Half-spaces are true planes, without
/// whittle's region around unbounded solids. `%` is left out. A text of n nodes costs O(n); nesting
/// in the text is as deep as in the tree, less nodes of a single operand.
/// Errors (kUsage): a camera or light that is not finite.
Result<std::string> write_pov(const Model& model, const Camera& camera,
                              const ShadeSettings& settings);

}  // namespace whittle
