// Text from outside (names of files, words of files, of other programs) in a message.
#pragma once

#include <string>
#include <string_view>

namespace whittle {

/// The text on one line, and without anything that a terminal obeys: each control character (below
/// 0x20, 0x7f, and U+0080 to U+009F in UTF-8) is a '?'.
std::string printable(std::string_view text);

}  // namespace whittle
