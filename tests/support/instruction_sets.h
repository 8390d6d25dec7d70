// The same work with every instruction set that this machine has.
#pragma once

#include <gtest/gtest.h>

#include "base/instruction_set.h"

namespace whittle {

/// Calls visit() once with every instruction set that this machine has, and the scalar one.
template <class Visit>
void for_every_instruction_set(const Visit& visit) {
  for (int64_t left = instruction_sets() & HWY_TARGETS; left != 0; left &= left - 1) {
    const int64_t target = left & -left;
    SCOPED_TRACE(hwy::TargetName(target));
    use_instruction_sets_for_test(target);
    visit();
  }
  use_instruction_sets_for_test(0);
}

}  // namespace whittle
