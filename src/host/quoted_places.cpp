#include "host/quoted_places.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <system_error>
#include <utility>

namespace whittle {
namespace {

constexpr size_t kMostCharacters = 60;

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// A message that begins with a place in that file, taken apart.
struct Placed {
  size_t line = 0, column = 0;
  std::string_view kind;  ///< "warning" or "error"
  std::string_view what;
};

std::optional<Placed> take_apart(std::string_view message, std::string_view file) {
  if (!message.starts_with(file)) return std::nullopt;
  message.remove_prefix(file.size());
  Placed placed;
  for (size_t* const number : {&placed.line, &placed.column}) {
    if (!message.starts_with(':')) return std::nullopt;
    const auto [end, code] =
        std::from_chars(message.data() + 1, message.data() + message.size(), *number);
    if (code != std::errc()) return std::nullopt;
    message.remove_prefix(static_cast<size_t>(end - message.data()));
  }
  if (!message.starts_with(": ")) return std::nullopt;
  message.remove_prefix(2);
  const size_t colon = message.find(": ");
  if (colon == std::string_view::npos) return std::nullopt;
  placed.kind = message.substr(0, colon);
  placed.what = message.substr(colon + 2);
  return placed;
}

/// Up to where its arguments end, blanks as one; of long ones only the beginning.
std::string beginning_of(std::string_view text) {
  std::string words;
  size_t depth = 0;
  bool is_string = false;
  for (size_t i = 0; i < text.size() && words.size() <= kMostCharacters; ++i) {
    const char c = text[i];
    if (is_blank(c) && !is_string) {
      if (!words.empty() && words.back() != ' ') words += ' ';
      continue;
    }
    if (!is_string && depth == 0 && (c == ';' || c == '{' || c == '}')) break;
    words += c;
    if (is_string && c == '\\' && i + 1 < text.size()) {
      words += text[++i];
    } else if (c == '"') {
      is_string = !is_string;
    } else if (!is_string && (c == '(' || c == '[')) {
      ++depth;
    } else if (!is_string && (c == ')' || c == ']') && depth > 0 && --depth == 0) {
      break;
    }
  }
  while (words.ends_with(' ')) words.pop_back();
  return words;
}

}  // namespace

std::string quote_statement(std::string_view text, size_t offset) {
  std::string words = beginning_of(text.substr(std::min(offset, text.size())));
  if (words.size() <= kMostCharacters) return words;
  constexpr std::string_view kMore = ", ...)";
  const size_t comma = words.rfind(", ", kMostCharacters - kMore.size());
  if (comma != std::string::npos && comma > kMostCharacters / 3) {
    return words.substr(0, comma).append(kMore);
  }
  size_t end = kMostCharacters - 3;
  // Not within a character of several bytes.
  while (end > 0 && (static_cast<unsigned char>(words[end]) & 0xc0) == 0x80) --end;
  return words.substr(0, end).append("...");
}

QuotedPlaces::QuotedPlaces(std::string_view text, std::string file)
    : text_(text), file_(std::move(file)) {}

size_t QuotedPlaces::offset_of(size_t line, size_t column) {
  if (lines_.empty()) {
    lines_.push_back(0);
    for (size_t at = 0; (at = text_.find('\n', at)) != std::string_view::npos;) {
      lines_.push_back(++at);
    }
  }
  if (line == 0 || line > lines_.size() || column == 0) return text_.size();
  size_t start = lines_[line - 1];
  const size_t place = std::min(start + (column - 1), text_.size());
  // A place may lie within a statement; openscad writes each to a line of its own.
  const std::string_view before = text_.substr(start, place - start);
  if (before.find_first_of("{};") != std::string_view::npos) return place;
  while (start < place && is_blank(text_[start])) ++start;
  return start;
}

std::string QuotedPlaces::operator()(const std::string& message) {
  const std::optional<Placed> placed = take_apart(message, file_);
  if (!placed) return message;
  const std::string statement = quote_statement(text_, offset_of(placed->line, placed->column));
  if (statement.empty()) return fmt::format("{}: {}: {}", file_, placed->kind, placed->what);
  return fmt::format("{}: {}: in \"{}\": {}", file_, placed->kind, statement, placed->what);
}

std::string without_place(const std::string& message, const std::string& file) {
  const std::optional<Placed> placed = take_apart(message, file);
  return placed ? fmt::format("{}: {}: {}", file, placed->kind, placed->what) : message;
}

}  // namespace whittle
