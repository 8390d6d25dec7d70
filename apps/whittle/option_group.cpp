#include "option_group.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>

namespace whittle {

void refuse(const char* option, const std::string& why) {
  throw CLI::ValidationError(option, why);
}

std::vector<double> parse_numbers(const char* option, std::string_view text, size_t count) {
  std::vector<double> numbers;
  for (std::string_view rest = text;;) {
    const size_t comma = rest.find(',');
    std::string_view word = rest.substr(0, comma);
    while (word.starts_with(' ')) word.remove_prefix(1);
    while (word.ends_with(' ')) word.remove_suffix(1);
    double value = 0;
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (code != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
      refuse(option, fmt::format("'{}' is not a number", word));
    }
    numbers.push_back(value);
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  if (numbers.size() != count) {
    refuse(option, fmt::format("wants {} number{}, not {} ('{}')", count, count == 1 ? "" : "s",
                               numbers.size(), text));
  }
  return numbers;
}

double parse_number(const char* option, std::string_view text) {
  return parse_numbers(option, text, 1)[0];
}

int64_t parse_count(const char* option, std::string_view text, int64_t least, int64_t most) {
  const double number = parse_number(option, text);
  if (number != std::floor(number) || number < double(least) || number > double(most)) {
    refuse(option, fmt::format("wants a whole number, {} to {}, not {}", least, most, text));
  }
  return int64_t(number);
}

void OptionGroup::add_flag(const char* names, bool& given, const char* description) {
  app_.add_flag(names, given, description)->group(heading_);
}

void OptionGroup::add_text(const char* name, const char* value, const std::string& description,
                           const std::function<void(const std::string&)>& set) {
  app_.add_option_function<std::string>(name, set, description)
      ->type_name(value)
      ->group(heading_)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

void OptionGroup::add_number(const char* name, const char* value, double& number, double least,
                             double most, const std::string& description) {
  add_text(name, value, description, [=, &number](const std::string& text) {
    number = parse_number(name, text);
    if (number < least || number > most) {
      refuse(name, std::isinf(most)
                       ? fmt::format("wants a number from {} on, not {}", least, text)
                       : fmt::format("wants a number, {} to {}, not {}", least, most, text));
    }
  });
}

}  // namespace whittle
