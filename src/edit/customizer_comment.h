// What the comment beside a variable says of its values.
#pragma once

#include <string_view>

#include "edit/customizer.h"

namespace whittle {

/// Takes `text`, what stands behind `//`, into the variable, whose value is known: `[most]`,
/// `[least:most]`, `[least:step:most]`, a step, the most characters, or choices with or without
/// labels, `[1, 2]`, `[a:first, b:second]`. What does not suit the value, or is followed by
/// anything, says nothing.
void read_customizer_comment(std::string_view text, CustomizerVariable& variable);

/// Without the blanks around it.
std::string_view trimmed(std::string_view text);

}  // namespace whittle
