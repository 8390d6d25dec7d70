// Numbers as text.
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <string>

namespace whittle {

/// The fewest decimals that are read as the same number again; -0 is 0.
template <class Number>
void append_number(std::string& out, Number value) {
  std::array<char, 40> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value + Number{}).ptr;
  out.append(text.data(), size_t(end - text.data()));
}

}  // namespace whittle
