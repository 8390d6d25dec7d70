#include "base/printable.h"

namespace whittle {

std::string printable(std::string_view text) {
  std::string shown;
  shown.reserve(text.size());
  for (size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
    const bool is_two_byte_control = c == 0xc2 && next >= 0x80 && next <= 0x9f;
    const bool is_control = c < ' ' || c == 0x7f || is_two_byte_control;
    shown += is_control ? '?' : text[i];
    i += is_two_byte_control;
  }
  return shown;
}

}  // namespace whittle
