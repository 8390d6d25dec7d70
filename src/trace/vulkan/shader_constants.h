// What shader_constants.inl means in C++.
#pragma once

#include <cstdint>

namespace whittle::shader {

// clang-format off
#define UINT(name, value) inline constexpr uint32_t name = value;
#define ENUM(name) enum class name : uint32_t {
#define IS(name, value) name = value,
#define END };
// clang-format on
#include "trace/vulkan/shader_constants.inl"
#undef UINT
#undef ENUM
#undef IS
#undef END

}  // namespace whittle::shader
