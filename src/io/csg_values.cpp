#include "io/csg_values.h"

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

// For the same reason vectors that names stand for may not fill a statement with more than this.
constexpr size_t kMostValuesByName = 10'000'000;

// Characters after which a value goes on, in OpenSCAD's language, as an expression.
constexpr std::string_view kOperators = "+-*/%<>=!&|?:([.^";

constexpr Value kUndefined{};
constexpr Value kTrue{.number = 1, .text = {}, .kind = Value::Kind::kBool};
constexpr Value kFalse{.number = 0, .text = {}, .kind = Value::Kind::kBool};

Value number_value(double x) {
  return {.number = x, .text = {}, .kind = Value::Kind::kNumber};
}

std::optional<Value> built_in(std::string_view name) {
  if (name == "inf") return number_value(std::numeric_limits<double>::infinity());
  if (name == "nan") return number_value(std::numeric_limits<double>::quiet_NaN());
  if (name == "PI") return number_value(std::numbers::pi);
  return std::nullopt;
}

bool expected(CsgLexer& lexer, std::string_view what) {
  const char c = lexer.peek();
  const SourceLocation where = lexer.location();
  const bool expression = c != '\0' && kOperators.find(c) != std::string_view::npos;
  return lexer.fail(where, fmt::format("expected {} before {}{}", what, lexer.describe_next(),
                                       expression ? " (values must be constants here; only a .scad "
                                                    "file may have expressions)"
                                                  : ""));
}

bool append_named(CsgLexer& lexer, std::string_view name, SourceLocation where,
                  Constants& constants, Warnings& warnings, std::vector<Value>& values) {
  const Value* const value = constants.look_up(name, where, warnings);
  if (value->extent > 1 && values.size() > kMostValuesByName) {
    return lexer.fail(
        where, fmt::format("the statement has more than {} values by name", kMostValuesByName));
  }
  values.insert(values.end(), value, value->end());
  return true;
}

/// Reads what is not a vector.
bool read_scalar(CsgLexer& lexer, Constants& constants, Warnings& warnings,
                 std::vector<Value>& values) {
  char c = lexer.peek();
  if (c == '"') {
    values.emplace_back().kind = Value::Kind::kString;
    return lexer.string(values.back().text);
  }
  bool negative = false;
  while (c == '-' || c == '+') {
    negative ^= c == '-';
    lexer.advance();
    c = lexer.peek();
  }
  if (is_digit(c) || c == '.') {
    values.emplace_back().kind = Value::Kind::kNumber;
    if (!lexer.number(values.back().number)) return false;
  } else if (is_name_start(c)) {
    const SourceLocation where = lexer.location();
    const size_t first = values.size();
    if (!append_named(lexer, lexer.identifier(), where, constants, warnings, values)) return false;
    for (size_t i = first; negative && i < values.size(); ++i) {
      values[i].number = -values[i].number;
    }
    return true;
  } else {
    return expected(lexer, "a value");
  }
  if (negative) values.back().number = -values.back().number;
  return true;
}

}  // namespace

const Value* Constants::look_up(std::string_view name, SourceLocation where, Warnings& warnings) {
  if (name == "false") return &kFalse;
  if (name == "true") return &kTrue;
  if (name == "undef") return &kUndefined;
  auto found = table_.find(name);
  if (found == table_.end()) {
    const std::optional<Value> known = built_in(name);
    found = table_.try_emplace(std::string(name)).first;
    found->second.value.push_back(known.value_or(kUndefined));
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
  if (value.extent <= kLargestConstant) {
    constant.value.assign(&value, value.end());
  } else {
    constant.value.assign(1, kUndefined);
  }
  return !constant.used;
}

bool read_value(CsgLexer& lexer, Constants& constants, Warnings& warnings,
                std::vector<Value>& values, std::vector<uint32_t>& scratch) {
  std::vector<uint32_t>& open = scratch;
  open.clear();
  for (;;) {
    bool complete = true;
    if (lexer.peek() == '[') {
      lexer.advance();
      open.push_back(static_cast<uint32_t>(values.size()));
      values.emplace_back().kind = Value::Kind::kVector;
      complete = lexer.peek() == ']';
    } else if (!read_scalar(lexer, constants, warnings, values)) {
      return false;
    }
    while (complete) {
      if (open.empty()) return true;
      char c = lexer.peek();
      if (c == ',') {
        lexer.advance();
        c = lexer.peek();
        complete = c == ']';  // OpenSCAD allows a comma after the last element
      }
      if (c == ']') {
        lexer.advance();
        values[open.back()].extent = static_cast<uint32_t>(values.size()) - open.back();
        open.pop_back();
      } else if (complete) {
        return expected(lexer, "',' or ']'");
      }
    }
  }
}

bool read_arguments(CsgLexer& lexer, Constants& constants, Warnings& warnings, bool is_text,
                    CsgArguments& arguments, std::vector<uint32_t>& scratch) {
  std::vector<Value>& values = arguments.values;
  arguments.list.clear();
  values.clear();
  char c = lexer.peek();
  while (c != ')') {
    const SourceLocation where = lexer.location();
    const auto index = static_cast<uint32_t>(values.size());
    std::string_view name;
    bool has_value = false;
    if (is_name_start(c)) {
      name = lexer.identifier();
      if (lexer.peek() == '=' && !lexer.is_followed_by('=')) {
        lexer.advance();
      } else {
        if (!append_named(lexer, name, where, constants, warnings, values)) return false;
        name = {};
        has_value = true;
      }
    }
    if (!has_value) {
      if (is_text && name == "text" && lexer.peek() == '"') {
        values.emplace_back().kind = Value::Kind::kString;
        if (!lexer.dumped_text(values.back().text)) return false;
      } else if (!read_value(lexer, constants, warnings, values, scratch)) {
        return false;
      }
    }
    arguments.list.push_back({name, index, where});
    c = lexer.peek();
    if (c == ',') {
      lexer.advance();
      c = lexer.peek();
    } else if (c != ')') {
      return expected(lexer, "',' or ')'");
    }
  }
  lexer.advance();
  return true;
}

}  // namespace whittle
