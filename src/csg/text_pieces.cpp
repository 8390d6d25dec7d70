#include "csg/text_pieces.h"

#include <algorithm>

namespace whittle {

size_t find_mark(std::string_view text, size_t from) {
  const auto is_mark = [](char c) { return (c == ';') | (c == '{') | (c == '}'); };
  // Blocks whose characters are all looked at are done by vector instructions.
  constexpr size_t kBlock = 64;
  for (size_t at = from; at + kBlock <= text.size(); at += kBlock) {
    int found = 0;
    for (size_t i = 0; i < kBlock; ++i) found |= is_mark(text[at + i]);
    if (found == 0) continue;
    while (!is_mark(text[at])) ++at;
    return at;
  }
  const size_t rest = from + (std::max(text.size(), from) - from) / kBlock * kBlock;
  for (size_t at = rest; at < text.size(); ++at) {
    if (is_mark(text[at])) return at;
  }
  return std::string_view::npos;
}

TextPiece read_piece(const TextSource& source, size_t number, size_t bytes,
                     UninitializedVector<char>& buffer) {
  const size_t start = number * bytes, left = source.place().size() - start;
  // A mark is seldom far.
  constexpr size_t kMargin = 1 << 12;
  TextPiece piece;
  for (size_t count = bytes + kMargin;; count *= 2) {
    count = std::min(count, left);
    const std::string_view text = source.read(start, count, buffer);
    piece.is_whole = text.size() == count;
    const size_t mark = number == 0 ? 0 : find_mark(text, 0);
    const size_t first = number == 0 ? 0 : mark + 1;
    // All of it is the end of what began before it.
    if (number != 0 && (mark == std::string_view::npos || first > bytes)) return piece;
    const size_t next = find_mark(text, bytes);
    if (next == std::string_view::npos && piece.is_whole && count < left) continue;
    const size_t last = next == std::string_view::npos ? text.size() : next + 1;
    piece.first = start + first;
    piece.text = text.substr(first, last - first);
    piece.is_last = piece.last() == source.place().size();
    return piece;
  }
}

}  // namespace whittle
