// The constants that define the styles, for those who reproduce them elsewhere.
#pragma once

#include "whittle/options.h"

namespace whittle {

/// kBlinn: display value = kBlinnAmbient * base + kBlinnDiffuse * base * max(n.l, 0) +
/// kBlinnSpecular * max(n.h, 0)^16, the last only where n.l > 0. Chosen so that a white base that
/// faces the light reaches 0.9, and clips only in the middle of its highlight.
inline constexpr float kBlinnAmbient = 0.2f, kBlinnDiffuse = 0.7f, kBlinnSpecular = 0.3f;
inline constexpr int kBlinnExponent = 16;

/// Whether a style's colours are linear light until they are stored; else they are display values.
constexpr bool is_linear(Style style) {
  return style == Style::kStudio || style == Style::kPlain;
}

}  // namespace whittle
