#include "generate/csg_text.h"

#include <algorithm>
#include <cmath>

namespace whittle {

void CsgText::indent() {
  // Deep trees would otherwise be mostly white space.
  constexpr int kDeepest = 40;
  text_.append(size_t{2} * size_t(std::min(depth_, kDeepest)), ' ');
}

void CsgText::comment(std::string_view text) {
  if (!text.empty()) {
    indent();
    text_.append("// ").append(text);
  }
  text_ += '\n';
}

void CsgText::open(std::string_view head) {
  indent();
  text_.append(head).append(" {\n");
  ++depth_;
}

void CsgText::close() {
  --depth_;
  indent();
  text_ += "}\n";
}

void CsgText::line(std::string_view statement) {
  indent();
  text_.append(statement) += '\n';
}

std::string number(double value) {
  // By way of integers: no locale and no library's idea of rounding gets in.
  const auto thousandths = int64_t(std::floor(value * 1000 + 0.5));
  const uint64_t size = thousandths < 0 ? uint64_t(-thousandths) : uint64_t(thousandths);
  std::string text = std::to_string(size / 1000);
  if (size % 1000 != 0) {
    const std::string decimals = std::to_string(1000 + size % 1000);
    text.append(".").append(decimals, 1);
    text.erase(text.find_last_not_of('0') + 1);
  }
  return thousandths < 0 ? "-" + text : text;
}

std::string vector(Vec3 v) {
  return "[" + number(v.x) + ", " + number(v.y) + ", " + number(v.z) + "]";
}

}  // namespace whittle
