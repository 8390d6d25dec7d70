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
constexpr uint32_t kPyramidFloatTexel[] = {
#include "pyramid.comp.float.texel.inc"
};
constexpr uint32_t kPyramidFloatStorage[] = {
#include "pyramid.comp.float.storage.inc"
};
constexpr uint32_t kPyramidDoubleTexel[] = {
#include "pyramid.comp.double.texel.inc"
};
constexpr uint32_t kPyramidDoubleStorage[] = {
#include "pyramid.comp.double.storage.inc"
};
constexpr uint32_t kHiddenFloatTexel[] = {
#include "hidden.comp.float.texel.inc"
};
constexpr uint32_t kHiddenFloatStorage[] = {
#include "hidden.comp.float.storage.inc"
};
constexpr uint32_t kHiddenDoubleTexel[] = {
#include "hidden.comp.double.texel.inc"
};
constexpr uint32_t kHiddenDoubleStorage[] = {
#include "hidden.comp.double.storage.inc"
};

}  // namespace

ShaderSet shaders(bool doubles, bool storage) {
  if (doubles) {
    if (storage)
      return {kCellsDoubleStorage, kVisibleDoubleStorage, kResolveDoubleStorage,
              kPyramidDoubleStorage, kHiddenDoubleStorage};
    return {kCellsDoubleTexel, kVisibleDoubleTexel, kResolveDoubleTexel, kPyramidDoubleTexel,
            kHiddenDoubleTexel};
  }
  if (storage)
    return {kCellsFloatStorage, kVisibleFloatStorage, kResolveFloatStorage, kPyramidFloatStorage,
            kHiddenFloatStorage};
  return {kCellsFloatTexel, kVisibleFloatTexel, kResolveFloatTexel, kPyramidFloatTexel,
          kHiddenFloatTexel};
}

}  // namespace whittle
