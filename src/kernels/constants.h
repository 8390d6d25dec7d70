// What constants.inl means in C++.
#pragma once

#include <cstdint>

namespace whittle {

// clang-format off
#define NUMBER(name, value) inline constexpr double name = value;
#define ENUM(name) enum class name : uint32_t {
#define IS(name, value) name = value,
#define END };
// clang-format on
#include "kernels/constants.inl"
#undef NUMBER
#undef ENUM
#undef IS
#undef END

inline constexpr bool is_cone(AlongKind kind) {
  return kind >= AlongKind::kCone;
}

}  // namespace whittle
