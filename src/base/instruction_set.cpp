#include "base/instruction_set.h"

#include <atomic>

#if HWY_ARCH_X86
#include <cpuid.h>
#endif

namespace whittle {
namespace {

#if HWY_ARCH_X86

/// What compilers have no name for in common: a bit of what the machine says of itself.
bool has_bit(unsigned leaf, unsigned registers, unsigned bit) {
  unsigned words[4] = {};
  return __get_cpuid_count(leaf, 0, &words[0], &words[1], &words[2], &words[3]) != 0 &&
         (words[registers] >> bit & 1) != 0;
}

/// Each set has all that Highway's functions for it use, and what the one before it has. What the
/// system does not save when threads change is not there.
int64_t find_instruction_sets() {
  constexpr unsigned kEcx = 2;
  __builtin_cpu_init();
  int64_t found = HWY_STATIC_TARGET;
  if (!__builtin_cpu_supports("ssse3")) return found;
  found |= HWY_SSSE3;
  if (!__builtin_cpu_supports("sse4.1") || !__builtin_cpu_supports("sse4.2") ||
      !__builtin_cpu_supports("pclmul") || !__builtin_cpu_supports("aes"))
    return found;
  found |= HWY_SSE4;
  const bool lzcnt = has_bit(0x80000001, kEcx, 5), f16c = has_bit(1, kEcx, 29);
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma") ||
      !__builtin_cpu_supports("bmi") || !__builtin_cpu_supports("bmi2") || !lzcnt || !f16c)
    return found;
  found |= HWY_AVX2;
  if (!__builtin_cpu_supports("avx512f") || !__builtin_cpu_supports("avx512vl") ||
      !__builtin_cpu_supports("avx512dq") || !__builtin_cpu_supports("avx512bw") ||
      !__builtin_cpu_supports("avx512cd"))
    return found;
  found |= HWY_AVX3;
  const bool vaes = has_bit(7, kEcx, 9);
  if (!__builtin_cpu_supports("avx512vnni") || !__builtin_cpu_supports("vpclmulqdq") ||
      !__builtin_cpu_supports("avx512vbmi") || !__builtin_cpu_supports("avx512vbmi2") || !vaes ||
      !__builtin_cpu_supports("avx512vpopcntdq") || !__builtin_cpu_supports("avx512bitalg"))
    return found;
  return found | HWY_AVX3_DL;
}

#else

int64_t find_instruction_sets() {
  return HWY_STATIC_TARGET;
}

#endif

/// 0 until somebody asks. Threads that ask at once find the same.
std::atomic<int64_t> known_instruction_sets = 0;

}  // namespace

int64_t instruction_sets() {
  int64_t sets = known_instruction_sets.load(std::memory_order_relaxed);
  if (sets == 0) {
    sets = find_instruction_sets();
    known_instruction_sets.store(sets, std::memory_order_relaxed);
  }
  return sets;
}

void use_instruction_sets_for_test(int64_t targets) {
  known_instruction_sets.store(targets, std::memory_order_relaxed);
}

}  // namespace whittle
