// Which of the instruction sets that vector lanes are compiled for runs them on this machine.
//
// Highway's own choice, HWY_DYNAMIC_DISPATCH, lives in its library, and that measures a clock for
// milliseconds before main() begins. Its headers alone do for all else, so the choice is made here.
#pragma once

#include <hwy/targets.h>

#include <bit>
#include <cstdint>

namespace whittle {

/// Bits of Highway's targets (HWY_AVX2, ...) that this machine can run; found once. At least the
/// one that the program is compiled for.
int64_t instruction_sets();

/// From now on instruction_sets() are those; with 0, what they were. While nothing else runs.
void use_instruction_sets_for_test(int64_t targets);

}  // namespace whittle

/// HWY_EXPORT and HWY_DYNAMIC_DISPATCH without the library. They stand where HWY_ONCE does, in one
/// namespace: WHITTLE_EXPORT(f); makes f, which every instruction set has, known;
/// WHITTLE_DISPATCH(f) is the f of the best one.
#if (HWY_TARGETS & (HWY_TARGETS - 1)) == 0

#define WHITTLE_EXPORT(function) static_assert(true)
#define WHITTLE_DISPATCH(function) HWY_STATIC_DISPATCH(function)

#else

#define WHITTLE_EXPORT(function)                                                                \
  static constexpr decltype(&HWY_STATIC_DISPATCH(function)) function##_of_instruction_set[] = { \
      HWY_CHOOSE_TARGET_LIST(function), HWY_CHOOSE_FALLBACK(function)}
// Highway's list has the best one first; its bits are shifted to one above their places in it. What
// is not compiled for has no place, and the last one is for machines without vectors.
#define WHITTLE_DISPATCH(function)                                                  \
  (*function##_of_instruction_set[std::countr_zero(                                 \
      uint64_t(HWY_CHOSEN_TARGET_SHIFT(whittle::instruction_sets() & HWY_TARGETS) | \
               HWY_CHOSEN_TARGET_MASK_SCALAR) >>                                    \
      1)])

#endif
