#include "base/instruction_set.h"

#include <gtest/gtest.h>

namespace whittle {
namespace {

TEST(InstructionSet, IsWhatHighwaysLibraryFinds) {
  EXPECT_EQ(instruction_sets() & HWY_TARGETS, hwy::SupportedTargets() & HWY_TARGETS);
}

TEST(InstructionSet, HasWhatTheProgramIsCompiledFor) {
  EXPECT_NE(instruction_sets() & HWY_STATIC_TARGET, 0);
}

TEST(InstructionSet, OneCanBeChosenAndGivenUp) {
  const int64_t all = instruction_sets();
  use_instruction_sets_for_test(HWY_STATIC_TARGET);
  EXPECT_EQ(instruction_sets(), HWY_STATIC_TARGET);
  use_instruction_sets_for_test(0);
  EXPECT_EQ(instruction_sets(), all);
}

}  // namespace
}  // namespace whittle
