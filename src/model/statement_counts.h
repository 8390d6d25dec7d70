// What stands in a text, word by word.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace whittle {

struct WordCount {
  std::string word;
  size_t count = 0;
  bool operator==(const WordCount&) const = default;
};

/// The statements of a text as they are written, also those that are dropped or come to nothing.
struct StatementCounts {
  std::vector<WordCount> words;  ///< the most frequent first, equally frequent ones by name
  size_t background = 0;         ///< marked with `%`,
  size_t highlight = 0;          ///< `#`,
  size_t root = 0;               ///< `!`,
  size_t disabled = 0;           ///< `*`
};

}  // namespace whittle
