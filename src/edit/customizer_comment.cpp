#include "edit/customizer_comment.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace whittle {
namespace {

std::optional<double> number_in(std::string_view text) {
  text = trimmed(text);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_all = error == std::errc() && end == text.data() + text.size();
  return is_all && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// Where `mark` stands outside of quotes, from `from` on; the end if it does not.
size_t find_outside_quotes(std::string_view text, char mark, size_t from) {
  bool is_quoted = false;
  for (size_t i = from; i < text.size(); ++i) {
    if (text[i] == '"') is_quoted = !is_quoted;
    if (text[i] == mark && !is_quoted) return i;
  }
  return text.size();
}

std::vector<std::string_view> split(std::string_view text, char mark) {
  std::vector<std::string_view> parts;
  for (size_t from = 0; from <= text.size();) {
    const size_t to = find_outside_quotes(text, mark, from);
    parts.push_back(text.substr(from, to - from));
    from = to + 1;
  }
  return parts;
}

std::string without_quotes(std::string_view text) {
  text = trimmed(text);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') {
    text = text.substr(1, text.size() - 2);
  }
  return std::string(text);
}

/// `[most]`, `[least:most]` or `[least:step:most]`, without the brackets. False if these are not
/// numbers.
bool read_range(std::string_view text, CustomizerVariable& variable) {
  std::vector<double> numbers;
  for (const std::string_view part : split(text, ':')) {
    const std::optional<double> number = number_in(part);
    if (!number) return false;
    numbers.push_back(*number);
  }
  const double least = numbers.size() == 1 ? 0 : numbers.front();
  if (numbers.size() > 3 || least > numbers.back()) return true;
  if (numbers.size() == 3 && numbers[1] > 0) variable.step = numbers[1];
  variable.least = least;
  variable.most = numbers.back();
  return true;
}

void read_choices(std::string_view text, CustomizerVariable& variable) {
  const bool are_numbers = std::holds_alternative<double>(variable.value);
  std::vector<CustomizerChoice> choices;
  for (const std::string_view part : split(text, ',')) {
    const size_t colon = find_outside_quotes(part, ':', 0);
    const std::string_view value = part.substr(0, colon);
    CustomizerChoice choice;
    choice.label = without_quotes(colon < part.size() ? part.substr(colon + 1) : value);
    if (are_numbers) {
      const std::optional<double> number = number_in(value);
      if (!number) return;
      choice.value = *number;
    } else {
      choice.value = without_quotes(value);
    }
    choices.push_back(std::move(choice));
  }
  variable.choices = std::move(choices);
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

void read_customizer_comment(std::string_view text, CustomizerVariable& variable) {
  text = trimmed(text);
  const bool is_text = std::holds_alternative<std::string>(variable.value);
  if (text.empty() || std::holds_alternative<bool>(variable.value)) return;
  if (text.front() != '[') {
    const std::optional<double> number = number_in(text);
    if (!number || *number <= 0) return;
    if (!is_text) {
      variable.step = number;
    } else if (*number < 1e9) {
      variable.most_characters = size_t(*number);
    }
    return;
  }
  if (find_outside_quotes(text, ']', 0) + 1 != text.size()) return;
  text = trimmed(text.substr(1, text.size() - 2));
  if (text.empty()) return;
  const bool is_list = find_outside_quotes(text, ',', 0) < text.size();
  if (!is_list && !is_text && read_range(text, variable)) return;
  if (!std::holds_alternative<std::vector<double>>(variable.value)) read_choices(text, variable);
}

}  // namespace whittle
