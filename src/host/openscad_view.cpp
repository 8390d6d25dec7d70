#include "host/openscad_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>

namespace whittle {
namespace {

constexpr std::string_view kName = "whittle_view";
constexpr std::string_view kAnswer = "ECHO: whittle_view = ";
/// What openscad says of a program that sets any of them; the picture shows it.
constexpr std::string_view kRemark = "WARNING: Viewall and autocenter disabled in favor of $vp*";

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

bool is_name_part(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// The end of the comment or string that begins at `at`; `at` if none does.
size_t skip_opaque(std::string_view text, size_t at) {
  if (text.substr(at, 2) == "//") return std::min(text.find('\n', at), text.size());
  if (text.substr(at, 2) == "/*") {
    const size_t close = text.find("*/", at + 2);
    return close == std::string_view::npos ? text.size() : close + 2;
  }
  if (text[at] != '"') return at;
  for (++at; at < text.size() && text[at] != '"'; ++at) at += text[at] == '\\';
  return std::min(at + 1, text.size());
}

/// The next place from `at` on that is neither blank nor comment.
size_t skip_blanks(std::string_view text, size_t at) {
  while (at < text.size()) {
    if (is_blank(text[at])) {
      ++at;
      continue;
    }
    if (text[at] != '/') break;
    const size_t end = skip_opaque(text, at);
    if (end == at) break;
    at = end;
  }
  return at;
}

/// A number at the front, taken away; none if there is none, or it is not finite.
std::optional<double> take_number(std::string_view& rest) {
  double number = 0;
  const auto [end, code] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  if (code != std::errc() || !std::isfinite(number)) return std::nullopt;
  rest.remove_prefix(static_cast<size_t>(end - rest.data()));
  return number;
}

std::optional<double> as_number(std::string_view text) {
  const std::optional<double> number = take_number(text);
  return text.empty() ? number : std::nullopt;
}

/// Three numbers; of two the third is 0.
std::optional<Vec3> as_vector(std::string_view text) {
  if (!text.starts_with('[') || !text.ends_with(']')) return std::nullopt;
  text.remove_prefix(1);
  std::array<double, 3> numbers{};
  for (size_t count = 0; count < numbers.size(); ++count) {
    const std::optional<double> number = take_number(text);
    if (!number) return std::nullopt;
    numbers[count] = *number;
    if (text == "]" && count > 0) return Vec3{numbers[0], numbers[1], numbers[2]};
    if (!text.starts_with(", ")) return std::nullopt;
    text.remove_prefix(2);
  }
  return std::nullopt;
}

/// The value that stands between `name = ` and `, next = `.
std::string_view value_of(std::string_view answer, std::string_view before,
                          std::string_view after) {
  const size_t found = answer.find(before);
  if (found == std::string_view::npos) return {};
  answer.remove_prefix(found + before.size());
  return after.empty() ? answer : answer.substr(0, answer.find(after));
}

}  // namespace

std::string view_question() {
  return fmt::format("{0}=echo({0}=0,t=$vpt,r=$vpr,d=$vpd,f=$vpf)0", kName);
}

void find_assigned_views(std::string_view text, AssignedViews& assigned) {
  constexpr std::string_view kMark = "$vp";
  if (text.find(kMark) == std::string_view::npos) return;
  size_t depth = 0;
  for (size_t at = 0; at < text.size();) {
    if (const size_t end = skip_opaque(text, at); end != at) {
      at = end;
      continue;
    }
    const char c = text[at];
    if (c == '(' || c == '[' || c == '{') ++depth;
    if ((c == ')' || c == ']' || c == '}') && depth > 0) --depth;
    const bool is_name = c == '$' && depth == 0 && text.substr(at, kMark.size()) == kMark;
    const char last = is_name && at + kMark.size() < text.size() ? text[at + kMark.size()] : '\0';
    at += is_name ? kMark.size() : 1;
    if (last == '\0') continue;
    const size_t sign = skip_blanks(text, ++at);
    if (at < text.size() && is_name_part(text[at])) continue;
    if (text.substr(sign, 1) != "=" || text.substr(sign, 2) == "==") continue;
    assigned.target |= last == 't';
    assigned.rotation |= last == 'r';
    assigned.distance |= last == 'd';
    assigned.fov |= last == 'f';
  }
}

FileView take_view(std::string& messages, const AssignedViews& assigned) {
  FileView view;
  std::string rest;
  for (size_t start = 0; start < messages.size();) {
    const size_t end = std::min(messages.find('\n', start), messages.size() - 1) + 1;
    const std::string_view whole(messages.data() + start, end - start);
    std::string_view line = whole;
    start = end;
    if (line.ends_with('\n')) line.remove_suffix(1);
    if (line == kRemark) continue;
    if (!line.starts_with(kAnswer)) {
      rest += whole;
      continue;
    }
    if (assigned.target) view.target = as_vector(value_of(line, ", t = ", ", r = "));
    if (assigned.rotation) view.rotation_degrees = as_vector(value_of(line, ", r = ", ", d = "));
    if (assigned.distance) view.distance = as_number(value_of(line, ", d = ", ", f = "));
    if (assigned.fov) view.fov_degrees = as_number(value_of(line, ", f = ", ""));
    if (!(view.fov_degrees.value_or(0) > 0 && *view.fov_degrees < 180)) view.fov_degrees.reset();
  }
  messages = std::move(rest);
  return view;
}

}  // namespace whittle
