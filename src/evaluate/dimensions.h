// What is flat and what is solid, by OpenSCAD's rule.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "model/document.h"

namespace whittle {

enum class Dimension : uint8_t { kNone, kFlat, kSolid };

/// True if a file of this name is flat: .svg and .dxf, in any case.
bool is_flat_file(std::string_view file);

/// Of every node: that of its first child that has one, but for the leaves and operations that fix
/// it. An empty shape has the dimension of its kind; a group of nothing has none.
std::vector<Dimension> dimensions(const Document& document);

/// What the children of a node must be, to be no mistake.
Dimension dimension_inside(const Document& document, uint32_t node,
                           const std::vector<Dimension>& dimensions);

}  // namespace whittle
