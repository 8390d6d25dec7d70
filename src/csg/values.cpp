#include "csg/values.h"
#include "base/limit_hint.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace whittle {
namespace {

// A constant with more values than this is not kept: names inside of constants could otherwise
// double the size of the model with every line. A matrix has 21.
constexpr uint32_t kLargestConstant = 32;

// Far more than any file has, and few enough for the memory.
constexpr size_t kMostNames = 1'000'000, kMostArguments = 100'000;

// Characters after which a value goes on, in OpenSCAD's language, as an expression.
constexpr std::string_view kOperators = "+-*/%<>=!&|?:([.^";

constexpr Value kUndefined{};
constexpr Value kTrue{.number = 1, .kind = Value::Kind::kBool};
constexpr Value kFalse{.number = 0, .kind = Value::Kind::kBool};

Value number_value(double x) {
  return {.number = x, .kind = Value::Kind::kNumber};
}

std::optional<Value> built_in(std::string_view name) {
  if (name == "inf") return number_value(std::numeric_limits<double>::infinity());
  if (name == "nan") return number_value(std::numeric_limits<double>::quiet_NaN());
  if (name == "PI") return number_value(std::numbers::pi);
  return std::nullopt;
}

bool too_many_values(CsgLexer& lexer, SourceLocation where, size_t limit) {
  return lexer.fail(where, fmt::format("the statement has more values than the limit of {}{}",
                                       limit, limit_hint("values")));
}

/// Adds a value of that kind, to be filled in; null if there are too many, which is a mistake then.
Value* add_value(CsgLexer& lexer, CsgArguments& arguments, Value::Kind kind) {
  if (arguments.values.size() >= arguments.most_values) {
    too_many_values(lexer, lexer.location(), arguments.most_values);
    return nullptr;
  }
  Value& value = arguments.values.emplace_back();
  value.kind = kind;
  return &value;
}

bool append_named(CsgLexer& lexer, std::string_view name, SourceLocation where,
                  Constants& constants, Warnings& warnings, CsgArguments& arguments) {
  if (!constants.admit(lexer, name, where)) return false;
  const Value* const value = constants.look_up(name, where, warnings);
  std::vector<Value>& values = arguments.values;
  if (values.size() + value->extent() > arguments.most_values) {
    return too_many_values(lexer, where, arguments.most_values);
  }
  values.insert(values.end(), value, value->end());
  return true;
}

/// Reads a string; one that OpenSCAD dumped as the argument of text() has its own rule.
bool read_string(CsgLexer& lexer, CsgArguments& arguments, bool is_dumped_text) {
  Value* const value = add_value(lexer, arguments, Value::Kind::kString);
  if (!value) return false;
  std::string_view text;
  const bool is_read = is_dumped_text ? lexer.dumped_text(text) : lexer.string(text);
  value->first_char = text.data();
  value->size = static_cast<uint32_t>(text.size());
  return is_read;
}

/// Reads what is not a vector.
bool read_scalar(CsgLexer& lexer, Constants& constants, Warnings& warnings,
                 CsgArguments& arguments) {
  char c = lexer.peek();
  if (c == '"') {
    return read_string(lexer, arguments, false);
  }
  bool negative = false;
  while (c == '-' || c == '+') {
    negative ^= c == '-';
    lexer.advance();
    c = lexer.peek();
  }
  if (is_digit(c) || c == '.') {
    Value* const value = add_value(lexer, arguments, Value::Kind::kNumber);
    if (!value || !lexer.number(value->number)) return false;
    if (negative) value->number = -value->number;
    return true;
  }
  if (is_name_start(c)) {
    const SourceLocation where = lexer.location();
    std::vector<Value>& values = arguments.values;
    const size_t first = values.size();
    if (!append_named(lexer, lexer.identifier(), where, constants, warnings, arguments)) {
      return false;
    }
    for (size_t i = first; negative && i < values.size(); ++i) {
      if (values[i].kind == Value::Kind::kNumber) values[i].number = -values[i].number;
    }
    return true;
  }
  return expected_after_value(lexer, "a value");
}

/// Reads plain numbers of a vector, each with the mark behind it, as far as there are any. The last
/// mark; 0 if there is none.
char read_numbers(CsgLexer& lexer, CsgArguments& arguments) {
  std::vector<Value>& values = arguments.values;
  char last = '\0';
  double number = 0;
  while (values.size() < arguments.most_values) {
    const char mark = lexer.plain_element(number);
    if (mark == '\0') break;
    values.push_back(number_value(number));
    last = mark;
    if (mark == ']') break;
  }
  return last;
}

}  // namespace

bool expected_after_value(CsgLexer& lexer, std::string_view what) {
  const char c = lexer.peek();
  const SourceLocation where = lexer.location();
  const bool expression = c != '\0' && kOperators.find(c) != std::string_view::npos;
  return lexer.fail(where, fmt::format("expected {} before {}{}", what, lexer.describe_next(),
                                       expression ? " (values must be constants here; only a .scad "
                                                    "file may have expressions)"
                                                  : ""));
}

bool Constants::admit(CsgLexer& lexer, std::string_view name, SourceLocation where) const {
  if (table_.size() < kMostNames || table_.contains(name)) return true;
  return lexer.fail(where, fmt::format("the file has more than {} names for values", kMostNames));
}

const Value* Constants::look_up(std::string_view name, SourceLocation where, Warnings& warnings) {
  if (name == "false") return &kFalse;
  if (name == "true") return &kTrue;
  if (name == "undef") return &kUndefined;
  auto found = table_.find(name);
  if (found == table_.end()) {
    const std::optional<Value> known = built_in(name);
    found = table_.try_emplace(std::string(name)).first;
    found->second.value.push_back(known.value_or(kUndefined));
    has_own_ |= !known;
    if (!known) {
      warnings.add("a name is not known; it is read as undef", where,
                   fmt::format("the name {} is not known; it is read as undef", quote(name)));
    }
  }
  found->second.used = true;
  return found->second.value.data();
}

bool Constants::assign(std::string_view name, const Value& value) {
  Constant& constant = table_.try_emplace(std::string(name)).first->second;
  has_own_ = true;
  if (value.extent() <= kLargestConstant) {
    constant.value.assign(&value, value.end());
  } else {
    constant.value.assign(1, kUndefined);
  }
  return !constant.used;
}

bool read_value(CsgLexer& lexer, Constants& constants, Warnings& warnings,
                CsgArguments& arguments) {
  std::vector<Value>& values = arguments.values;
  std::vector<uint32_t>& open = arguments.open;
  open.clear();
  for (;;) {
    // An element comes, or the end of a vector: OpenSCAD allows a comma after the last element.
    bool closes = false;
    const char c = lexer.peek();
    if (c == '[') {
      open.push_back(static_cast<uint32_t>(values.size()));
      if (!add_value(lexer, arguments, Value::Kind::kVector)) return false;
      lexer.advance();
      continue;
    }
    if (!open.empty()) {
      const char mark = is_digit(c) || c == '-' ? read_numbers(lexer, arguments) : '\0';
      if (mark == ',') continue;
      closes = mark == ']';
      if (!closes && c == ']') {
        lexer.advance();
        closes = true;
      }
    }
    if (!closes) {
      if (!read_scalar(lexer, constants, warnings, arguments)) return false;
      if (open.empty()) return true;
    }
    for (;; closes = true) {
      if (closes) {
        values[open.back()].size = static_cast<uint32_t>(values.size()) - open.back() - 1;
        open.pop_back();
        if (open.empty()) return true;
      }
      const char mark = lexer.peek();
      if (mark != ',' && mark != ']') return expected_after_value(lexer, "',' or ']'");
      lexer.advance();
      if (mark == ',') break;
    }
  }
}

bool read_arguments(CsgLexer& lexer, Constants& constants, Warnings& warnings, bool is_text,
                    CsgArguments& arguments) {
  std::vector<Value>& values = arguments.values;
  arguments.list.clear();
  values.clear();
  char c = lexer.peek();
  while (c != ')') {
    const SourceLocation where = lexer.location();
    if (arguments.list.size() >= kMostArguments) {
      return lexer.fail(where,
                        fmt::format("the statement has more than {} arguments", kMostArguments));
    }
    const auto index = static_cast<uint32_t>(values.size());
    auto begin = static_cast<uint32_t>(lexer.offset());
    std::string_view name;
    bool has_value = false;
    uint32_t end = 0;
    if (is_name_start(c)) {
      name = lexer.identifier();
      end = static_cast<uint32_t>(lexer.offset());
      if (lexer.peek() == '=' && !lexer.is_followed_by('=')) {
        lexer.advance();
      } else {
        if (!append_named(lexer, name, where, constants, warnings, arguments)) return false;
        name = {};
        has_value = true;
      }
    }
    if (!has_value) {
      lexer.peek();
      begin = static_cast<uint32_t>(lexer.offset());
      if (is_text && name == "text" && lexer.peek() == '"') {
        if (!read_string(lexer, arguments, true)) return false;
      } else if (!read_value(lexer, constants, warnings, arguments)) {
        return false;
      }
      end = static_cast<uint32_t>(lexer.offset());
    }
    arguments.list.push_back({name, index, where, begin, end});
    c = lexer.peek();
    if (c == ',') {
      lexer.advance();
      c = lexer.peek();
    } else if (c != ')') {
      return expected_after_value(lexer, "',' or ')'");
    }
  }
  lexer.advance();
  return true;
}

}  // namespace whittle
