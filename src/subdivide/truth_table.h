// Truth tables of up to kTableLiterals literals, a bit a row: bit s is the answer where bit i of s
// says what literal i is.
#pragma once

#include <cstdint>

#include "subdivide/cells.h"

namespace whittle {

/// The truth table of literal i alone: bit s is bit i of s.
inline constexpr uint64_t kTableOf[kTableLiterals] = {0xaaaaaaaaaaaaaaaa, 0xcccccccccccccccc,
                                                      0xf0f0f0f0f0f0f0f0, 0xff00ff00ff00ff00,
                                                      0xffff0000ffff0000, 0xffffffff00000000};

/// The rows of a table over n literals.
constexpr uint64_t table_rows(uint32_t n) {
  return n == kTableLiterals ? ~uint64_t(0) : (uint64_t(1) << (1u << n)) - 1;
}

/// Whether the answer depends on literal i.
constexpr bool depends_on(uint64_t table, uint32_t i) {
  const uint64_t with = table & kTableOf[i], without = table & ~kTableOf[i];
  return (with >> (1u << i)) != without;
}

}  // namespace whittle
