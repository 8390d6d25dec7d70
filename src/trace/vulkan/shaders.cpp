#include "trace/vulkan/shaders.h"

namespace whittle {
namespace {

// Written by CMake: one file for each shader and each way to compute and to read.
constexpr uint32_t kCellsFloatTexel[] = {
#include "cells.vert.float.texel.inc"
};
constexpr uint32_t kCellsFloatStorage[] = {
#include "cells.vert.float.storage.inc"
};
constexpr uint32_t kCellsDoubleTexel[] = {
#include "cells.vert.double.texel.inc"
};
constexpr uint32_t kCellsDoubleStorage[] = {
#include "cells.vert.double.storage.inc"
};
constexpr uint32_t kVisibleFloatTexel[] = {
#include "visible.frag.float.texel.inc"
};
constexpr uint32_t kVisibleFloatStorage[] = {
#include "visible.frag.float.storage.inc"
};
constexpr uint32_t kVisibleDoubleTexel[] = {
#include "visible.frag.double.texel.inc"
};
constexpr uint32_t kVisibleDoubleStorage[] = {
#include "visible.frag.double.storage.inc"
};
constexpr uint32_t kResolveFloatTexel[] = {
#include "resolve.comp.float.texel.inc"
};
constexpr uint32_t kResolveFloatStorage[] = {
#include "resolve.comp.float.storage.inc"
};
constexpr uint32_t kResolveDoubleTexel[] = {
#include "resolve.comp.double.texel.inc"
};
constexpr uint32_t kResolveDoubleStorage[] = {
#include "resolve.comp.double.storage.inc"
};

}  // namespace

ShaderSet shaders(bool doubles, bool storage) {
  if (doubles) {
    if (storage) return {kCellsDoubleStorage, kVisibleDoubleStorage, kResolveDoubleStorage};
    return {kCellsDoubleTexel, kVisibleDoubleTexel, kResolveDoubleTexel};
  }
  if (storage) return {kCellsFloatStorage, kVisibleFloatStorage, kResolveFloatStorage};
  return {kCellsFloatTexel, kVisibleFloatTexel, kResolveFloatTexel};
}

}  // namespace whittle
