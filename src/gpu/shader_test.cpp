#include "gpu/shader.h"

#include <gtest/gtest.h>

namespace whittle::gpu {
namespace {

constexpr uint32_t op(uint32_t code, uint32_t words) {
  return words << 16 | code;
}

/// A module of a header, one decoration, a type, and an addition, a product and a sum of integers.
const std::vector<uint32_t> kModule = {
    0x07230203, 0x00010600, 0,  9, 0,  // header
    op(71, 4),  5,          30, 0,     // %5 has a location
    op(19, 2),  1,                     // %1 = OpTypeVoid
    op(129, 5), 2,          6,  4, 4,  // %6 = OpFAdd %2
    op(128, 5), 3,          7,  4, 4,  // %7 = OpIAdd %3
    op(142, 5), 2,          8,  4, 4,  // %8 = OpVectorTimesScalar %2
};

TEST(Shader, NoSumOrProductOfFloatsMayBeContracted) {
  const std::vector<uint32_t> decorated = without_contraction(kModule);
  std::vector<uint32_t> expected(kModule.begin(), kModule.begin() + 9);
  expected.insert(expected.end(), {op(71, 3), 6, 42, op(71, 3), 8, 42});
  expected.insert(expected.end(), kModule.begin() + 9, kModule.end());
  EXPECT_EQ(decorated, expected);
}

TEST(Shader, OnceIsEnough) {
  const std::vector<uint32_t> once = without_contraction(kModule);
  EXPECT_EQ(without_contraction(once), once);
}

}  // namespace
}  // namespace whittle::gpu
