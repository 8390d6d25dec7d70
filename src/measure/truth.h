// Truth tables that always have 64 rows: those of literals that are not there are repeated.
#pragma once

#include "subdivide/truth_table.h"

namespace whittle {

/// A table over n literals with all of its rows.
constexpr uint64_t full_table(uint64_t table, uint32_t n) {
  table &= table_rows(n);
  for (uint32_t i = n; i < kTableLiterals; ++i) table |= table << (1u << i);
  return table;
}

/// The table where literal i is known.
constexpr uint64_t cofactor(uint64_t table, uint32_t i, bool value) {
  const uint64_t half = value ? table & kTableOf[i] : table & ~kTableOf[i];
  return value ? half | half >> (1u << i) : half | half << (1u << i);
}

constexpr bool is_constant(uint64_t table) {
  return table == 0 || table == ~uint64_t(0);
}

/// Whether more of literal i never means both more and less of the solid.
constexpr bool is_monotone(uint64_t table, uint32_t i) {
  const uint64_t with = cofactor(table, i, true), without = cofactor(table, i, false);
  return (with & ~without) == 0 || (without & ~with) == 0;
}

}  // namespace whittle
