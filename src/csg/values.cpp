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
  if (values.size() + value->extent > arguments.most_values) {
    return too_many_values(lexer, where, arguments.most_values);
  }
  values.insert(values.end(), value, value->end());
  return true;
}

/// Reads what is not a vector.
bool read_scalar(CsgLexer& lexer, Constants& constants, Warnings& warnings,
                 CsgArguments& arguments) {
  char c = lexer.peek();
  if (c == '"') {
    Value* const value = add_value(lexer, arguments, Value::Kind::kString);
    return value && lexer.string(value->text);
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
      values[i].number = -values[i].number;
    }
    return true;
  }
  return expected_after_value(lexer, "a value");
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
                CsgArguments& arguments) {
  std::vector<Value>& values = arguments.values;
  std::vector<uint32_t>& open = arguments.open;
  open.clear();
  for (;;) {
    bool complete = true;
    if (lexer.peek() == '[') {
      open.push_back(static_cast<uint32_t>(values.size()));
      if (!add_value(lexer, arguments, Value::Kind::kVector)) return false;
      lexer.advance();
      complete = lexer.peek() == ']';
    } else if (!read_scalar(lexer, constants, warnings, arguments)) {
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
        return expected_after_value(lexer, "',' or ']'");
      }
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
    std::string_view name;
    bool has_value = false;
    if (is_name_start(c)) {
      name = lexer.identifier();
      if (lexer.peek() == '=' && !lexer.is_followed_by('=')) {
        lexer.advance();
      } else {
        if (!append_named(lexer, name, where, constants, warnings, arguments)) return false;
        name = {};
        has_value = true;
      }
    }
    if (!has_value) {
      if (is_text && name == "text" && lexer.peek() == '"') {
        Value* const value = add_value(lexer, arguments, Value::Kind::kString);
        if (!value || !lexer.dumped_text(value->text)) return false;
      } else if (!read_value(lexer, constants, warnings, arguments)) {
        return false;
      }
    }
    arguments.list.push_back({name, index, where});
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
