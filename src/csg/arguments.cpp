#include "csg/arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whittle {
namespace {

/// The number that `count` hexadecimal digits at the front are; none if they are not all there.
std::optional<uint32_t> hexadecimal(std::string_view text, size_t count) {
  if (text.size() < count) return std::nullopt;
  uint32_t number = 0;
  for (const char c : text.substr(0, count)) {
    const int digit = c >= '0' && c <= '9'   ? c - '0'
                      : c >= 'a' && c <= 'f' ? c - 'a' + 10
                      : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                             : -1;
    if (digit < 0) return std::nullopt;
    number = number * 16 + static_cast<uint32_t>(digit);
  }
  return number;
}

void append_utf8(uint32_t code, std::string& text) {
  const auto tail = [&](int shift) { text += static_cast<char>(0x80 | ((code >> shift) & 0x3f)); };
  if (code < 0x80) {
    text += static_cast<char>(code);
  } else if (code < 0x800) {
    text += static_cast<char>(0xc0 | (code >> 6));
    tail(0);
  } else if (code < 0x10000) {
    text += static_cast<char>(0xe0 | (code >> 12));
    tail(6), tail(0);
  } else {
    text += static_cast<char>(0xf0 | (code >> 18));
    tail(12), tail(6), tail(0);
  }
}

}  // namespace

void warn(const Statement& statement, std::string_view problem, Warnings& warnings) {
  const std::string message = fmt::format("{}: {}", statement.type->name, problem);
  warnings.add(message, statement.where, message);
}

int numbers(const Value* value, double* out, int capacity) {
  if (!is_vector(value)) return -1;
  int count = 0;
  for (const Value* e = value->begin(); e != value->end(); e = e->end(), ++count) {
    if (!is_number(e) || count == capacity) return -1;
    out[count] = e->number;
  }
  return count;
}

std::optional<Vec3> vec3_or_vec2(const Value* value, double z) {
  double e[3] = {0, 0, z};
  return numbers(value, e, 3) >= 2 ? std::optional(Vec3{e[0], e[1], e[2]}) : std::nullopt;
}

std::optional<double> read_number(const Statement& statement, size_t index, Warnings& warnings) {
  const Value* const value = defined_argument(statement, index);
  if (!value) return std::nullopt;
  if (is_number(value)) return value->number;
  warn(statement,
       fmt::format("{} is not a number; it is ignored", statement.type->parameters[index]),
       warnings);
  return std::nullopt;
}

void read_bool(const Statement& statement, size_t index, bool& answer, Warnings& warnings) {
  const Value* const value = defined_argument(statement, index);
  if (!value) return;
  if (value->kind == Value::Kind::kBool) {
    answer = value->number != 0;
  } else {
    warn(statement,
         fmt::format("{} is neither true nor false; it is ignored",
                     statement.type->parameters[index]),
         warnings);
  }
}

std::optional<std::string> read_string(const Statement& statement, size_t index,
                                       Warnings& warnings) {
  const Value* const value = defined_argument(statement, index);
  if (!value) return std::nullopt;
  if (value->kind == Value::Kind::kString) return unescaped(value->text());
  warn(statement, fmt::format("{} is not a text; it is ignored", statement.type->parameters[index]),
       warnings);
  return std::nullopt;
}

std::optional<double> radius(const Statement& statement, size_t radius_index, size_t diameter_index,
                             Warnings& warnings) {
  const std::optional<double> r = read_number(statement, radius_index, warnings);
  const std::optional<double> d = read_number(statement, diameter_index, warnings);
  if (r && d) warn(statement, "a radius is ignored because the diameter is given too", warnings);
  return d ? *d / 2 : r;
}

void warn_if_not_finite(const Statement& statement, std::initializer_list<double> sizes,
                        Warnings& warnings) {
  if (std::all_of(sizes.begin(), sizes.end(), [](double x) { return std::isfinite(x); })) return;
  warn(statement, "a size is not finite; the shape is empty", warnings);
}

std::string unescaped(std::string_view raw) {
  std::string text;
  text.reserve(raw.size());
  while (!raw.empty()) {
    const size_t plain = std::min(raw.find('\\'), raw.size());
    text += raw.substr(0, plain);
    raw.remove_prefix(plain);
    if (raw.empty()) break;
    const char c = raw.size() > 1 ? raw[1] : '\0';
    const size_t digits = c == 'x' ? 2 : c == 'u' ? 4 : c == 'U' ? 6 : 0;
    const std::optional<uint32_t> code =
        digits > 0 ? hexadecimal(raw.substr(2), digits) : std::nullopt;
    if (code && *code > 0 && *code <= 0x10ffff && (*code < 0xd800 || *code > 0xdfff)) {
      append_utf8(*code, text);
      raw.remove_prefix(2 + digits);
    } else if (constexpr std::string_view kEscapes = "nrt\"\\"; kEscapes.find(c) < 5) {
      text += "\n\r\t\"\\"[kEscapes.find(c)];
      raw.remove_prefix(2);
    } else {
      text += raw.front();
      raw.remove_prefix(1);
    }
  }
  return text;
}

std::optional<Vec2> as_vec2(const Value& value) {
  double e[2];
  return numbers(&value, e, 2) == 2 ? std::optional(Vec2{e[0], e[1]}) : std::nullopt;
}

std::optional<Vec3> as_vec3(const Value& value) {
  double e[3];
  return numbers(&value, e, 3) == 3 ? std::optional(Vec3{e[0], e[1], e[2]}) : std::nullopt;
}

}  // namespace whittle
