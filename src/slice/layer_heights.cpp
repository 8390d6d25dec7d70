#include "slice/layer_heights.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <system_error>

namespace whittle {
namespace {

Error refused(const std::string& why) {
  return {ErrorKind::kUsage, why};
}

std::string_view trimmed(std::string_view word) {
  while (word.starts_with(' ')) word.remove_prefix(1);
  while (word.ends_with(' ')) word.remove_suffix(1);
  return word;
}

std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> words;
  for (;;) {
    const size_t end = text.find(at);
    words.push_back(trimmed(text.substr(0, end)));
    if (end == std::string_view::npos) return words;
    text.remove_prefix(end + 1);
  }
}

std::optional<double> number_in(std::string_view word) {
  double value = 0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (code != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

/// How often `scale` a number is, if it is the double nearest to a whole number over it.
std::optional<double> whole(double value, double scale) {
  constexpr double kAllWholeNumbers = 0x1p52;
  const double scaled = std::round(value * scale);
  if (std::fabs(scaled) < kAllWholeNumbers && scaled / scale == value) return scaled;
  return std::nullopt;
}

/// The values of a range, of which it is known how many there are.
void add_range(double start, double step, size_t count, std::vector<double>& heights) {
  // Whole numbers are added without rounding, and divided once.
  for (double scale = 1; scale <= 1e9; scale *= 10) {
    const std::optional<double> from = whole(start, scale), by = whole(step, scale);
    if (!from || !by) continue;
    for (size_t i = 0; i < count; ++i) heights.push_back((*from + double(i) * *by) / scale);
    return;
  }
  for (size_t i = 0; i < count; ++i) heights.push_back(start + double(i) * step);
}

}  // namespace

Result<std::vector<double>> parse_heights(std::string_view text) {
  std::vector<double> heights;
  for (const std::string_view item : split(text, ',')) {
    std::vector<double> numbers;
    for (const std::string_view word : split(item, ':')) {
      const std::optional<double> number = number_in(word);
      if (!number) return refused(fmt::format("'{}' is not a number", word));
      numbers.push_back(*number);
    }
    if (numbers.size() > 3)
      return refused(fmt::format("wants numbers and start:step:end, not {}", item));
    const double start = numbers.front(), end = numbers.back();
    const double step = numbers.size() == 3 ? numbers[1] : 1;
    if (step == 0) return refused(fmt::format("the range {} has a step of 0", item));
    const double exact = (end - start) / step;
    if (exact < 0) return refused(fmt::format("the range {} has no values", item));
    const double steps = std::floor(std::nextafter(exact, std::numeric_limits<double>::infinity()));
    if (double(heights.size()) + steps + 1 > double(kMostLayers))
      return refused(fmt::format("wants at most {} layers, not {}", kMostLayers, text));
    add_range(start, step, size_t(steps) + 1, heights);
  }
  return heights;
}

}  // namespace whittle
