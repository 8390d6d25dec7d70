// Where a text is cut into pieces: behind a character that statements begin or end with, unless it
// stands in a string or a comment.
#pragma once

#include <cstddef>
#include <string_view>

#include "base/uninitialized.h"
#include "csg/text_source.h"

namespace whittle {

struct TextPiece {
  size_t first = 0;       ///< of its bytes in the text
  std::string_view text;  ///< empty: there is no such piece
  bool is_last = false;
  bool is_whole = true;  ///< false: not all of it can be read

  size_t last() const { return first + text.size(); }
};

/// The first ';', '{' or '}' at `from` or behind it; npos if there is none.
size_t find_mark(std::string_view text, size_t from);

/// The piece of that number of a text that is cut every `bytes` or a little later. It begins where
/// the one before it ends. Its text is in `buffer`, or where the source has it.
TextPiece read_piece(const TextSource& source, size_t number, size_t bytes,
                     UninitializedVector<char>& buffer);

}  // namespace whittle
