#include "edit/customizer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/append_number.h"
#include "csg/arguments.h"
#include "csg/lexer.h"
#include "csg/values.h"
#include "edit/customizer_comment.h"
#include "model/warnings.h"

namespace whittle {
namespace {

constexpr size_t kMostInVector = 4;
constexpr std::string_view kHidden = "Hidden";

/// Behind a string, a comment, or the one byte that is at `at`.
size_t step_over(std::string_view text, size_t at) {
  if (text[at] == '"') {
    for (++at; at < text.size() && text[at] != '"'; ++at) at += text[at] == '\\';
  } else if (text.substr(at, 2) == "//") {
    at = text.find('\n', at);
  } else if (text.substr(at, 2) == "/*") {
    at = text.find("*/", at + 2);
    at += at != std::string_view::npos;
  }
  return std::min(at, text.size() - 1) + 1;
}

/// The lines before that of the first brace.
std::string_view top_of(std::string_view scad) {
  for (size_t at = 0; at < scad.size(); at = step_over(scad, at)) {
    if (scad[at] != '{') continue;
    const size_t newline = scad.substr(0, at).rfind('\n');
    return scad.substr(0, newline == std::string_view::npos ? 0 : newline + 1);
  }
  return scad;
}

/// Behind the statement that begins at `at`.
size_t skip_statement(std::string_view text, size_t at) {
  CsgLexer lexer(text);
  lexer.skip_to(at);
  lexer.peek();
  at = lexer.offset();
  const std::string_view word = lexer.identifier();
  if ((word == "use" || word == "include") && lexer.peek() == '<') {
    // A file's name, which no semicolon follows.
    return std::min(text.find('>', lexer.offset()), text.size() - 1) + 1;
  }
  while (at < text.size() && text[at] != ';') at = step_over(text, at);
  return std::min(at, text.size() - 1) + 1;
}

/// The value that is written there, if it is a literal that a variable can have.
std::optional<CustomizerValue> literal(const Value& value, std::string_view written) {
  switch (value.kind) {
    case Value::Kind::kBool:
      return CustomizerValue(value.number != 0);
    case Value::Kind::kNumber:
      // Not the name of one.
      if (written.find_first_of("0123456789") == std::string_view::npos) return std::nullopt;
      if (!std::isfinite(value.number)) return std::nullopt;
      return CustomizerValue(value.number);
    case Value::Kind::kString:
      return CustomizerValue(unescaped(value.text()));
    case Value::Kind::kVector: {
      double numbers[kMostInVector];
      const int count = whittle::numbers(&value, numbers, int(kMostInVector));
      const bool are_finite = std::all_of(numbers, numbers + std::max(count, 0),
                                          [](double x) { return std::isfinite(x); });
      if (count < 1 || !are_finite) return std::nullopt;
      return CustomizerValue(std::vector<double>(numbers, numbers + count));
    }
    default:
      return std::nullopt;
  }
}

/// The comment at the end of a line; none if more than one statement ends on it.
std::string_view comment_of_line(std::string_view line) {
  size_t ends = 0;
  for (size_t at = 0; at < line.size(); at = step_over(line, at)) {
    ends += line[at] == ';';
    if (ends > 1) return {};
    if (line.substr(at, 2) == "//") return line.substr(at + 2);
  }
  return {};
}

/// The heading that a comment is, `/* [name] */` on one line; of several in it one name is made.
std::optional<std::string> heading(std::string_view comment) {
  comment = trimmed(comment);
  if (comment.size() < 2 || comment.front() != '[' || comment.back() != ']' ||
      comment.find('\n') != std::string_view::npos) {
    return std::nullopt;
  }
  std::string name;
  for (size_t open = 0; open < comment.size();) {
    const size_t close = std::min(comment.find(']', open), comment.size());
    const std::string_view part = trimmed(comment.substr(open + 1, close - open - 1));
    if (!name.empty()) name += '-';
    name += part;
    open = std::min(comment.find('[', close), comment.size());
  }
  return name;
}

class CustomizerReader {
 public:
  explicit CustomizerReader(std::string_view scad) : text_(top_of(scad)) {}

  std::vector<CustomizerVariable> read() {
    for (size_t at = 0; at < text_.size();) {
      const size_t behind = read_assignment(at);
      at = behind > at ? behind : skip_statement(text_, at);
    }
    variables_.erase(std::remove_if(variables_.begin(), variables_.end(),
                                    [](const CustomizerVariable& v) { return v.group == kHidden; }),
                     variables_.end());
    return std::move(variables_);
  }

 private:
  /// Behind an assignment; `at` if none begins there, or if no value of a variable is assigned.
  size_t read_assignment(size_t at) {
    CsgLexer lexer(text_);
    lexer.skip_to(at);
    lexer.peek();
    const size_t begin = lexer.offset();
    const std::string_view name = lexer.identifier();
    if (name.empty() || lexer.peek() != '=' || lexer.is_followed_by('=')) return at;
    lexer.advance();
    const std::optional<CustomizerValue> value = read_literal(lexer);
    pass_lines_up_to(begin);
    const auto known = numbers_.find(name);
    if (value && known == numbers_.end()) {
      numbers_.emplace(name, variables_.size());
      variables_.push_back(describe(std::string(name), *value));
    } else if (value) {
      variables_[known->second] = describe(std::string(name), *value);
    } else if (known != numbers_.end()) {
      // The last assignment counts, and it is none that can be offered.
      variables_[known->second].group = kHidden;
    }
    return value ? lexer.offset() : at;
  }

  /// Reads a literal and the semicolon behind it.
  std::optional<CustomizerValue> read_literal(CsgLexer& lexer) {
    lexer.peek();
    const size_t from = lexer.offset();
    arguments_.values.clear();
    if (!read_value(lexer, constants_, warnings_, arguments_)) return std::nullopt;
    const std::string_view written = text_.substr(from, lexer.offset() - from);
    if (lexer.peek() != ';') return std::nullopt;
    lexer.advance();
    return literal(arguments_.values.front(), written);
  }

  /// Reads headings and counts lines.
  void pass_lines_up_to(size_t offset) {
    while (passed_ < offset) {
      const size_t next = std::min(step_over(text_, passed_), offset);
      const std::string_view step = text_.substr(passed_, next - passed_);
      if (step.size() >= 4 && step.starts_with("/*") && step.ends_with("*/")) {
        if (auto name = heading(step.substr(2, step.size() - 4))) group_ = std::move(*name);
      }
      for (size_t i = 0; i < step.size(); ++i) {
        if (step[i] != '\n') continue;
        ++line_;
        line_before_ = line_start_;
        line_start_ = passed_ + i + 1;
      }
      passed_ = next;
    }
  }

  CustomizerVariable describe(std::string name, CustomizerValue value) const {
    CustomizerVariable variable;
    variable.name = std::move(name);
    variable.value = std::move(value);
    variable.group = group_;
    variable.line = line_;
    std::string_view above = text_.substr(line_before_, line_start_ - line_before_);
    if (above.starts_with("//")) variable.description = trimmed(above.substr(2));
    const size_t end = std::min(text_.find('\n', line_start_), text_.size());
    read_customizer_comment(comment_of_line(text_.substr(line_start_, end - line_start_)),
                            variable);
    return variable;
  }

  std::string_view text_;
  Constants constants_;
  Warnings warnings_{std::string()};
  CsgArguments arguments_;
  std::vector<CustomizerVariable> variables_;
  std::map<std::string, size_t, std::less<>> numbers_;  ///< of the variables by name
  size_t passed_ = 0;
  size_t line_start_ = 0, line_before_ = 0;
  uint32_t line_ = 1;
  std::string group_ = "Parameters";
};

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    constexpr std::string_view kSpecial = "\"\\\n\t\r", kLetters = "\"\\ntr";
    const size_t special = kSpecial.find(c);
    if (special == std::string_view::npos) {
      out += c;
    } else {
      out += '\\';
      out += kLetters[special];
    }
  }
  return out + '"';
}

struct TextOf {
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(double value) const {
    std::string text;
    append_number(text, value);
    return text;
  }
  std::string operator()(const std::string& value) const { return quoted(value); }
  std::string operator()(const std::vector<double>& value) const {
    std::string text;
    for (const double number : value) text += (text.empty() ? "" : ", ") + (*this)(number);
    return "[" + text + "]";
  }
};

}  // namespace

std::vector<CustomizerVariable> read_customizer(std::string_view scad) {
  // To the reader of words a zero byte is the end.
  return CustomizerReader(scad.substr(0, scad.find(char{0}))).read();
}

std::string customizer_text(const CustomizerValue& value) {
  return std::visit(TextOf{}, value);
}

std::string definition(const CustomizerVariable& variable, const CustomizerValue& value) {
  return fmt::format("{}={}", variable.name, customizer_text(value));
}

std::vector<std::string> definitions(const std::vector<CustomizerVariable>& variables,
                                     const std::vector<CustomizerValue>& values) {
  std::vector<std::string> all;
  for (size_t i = 0; i < variables.size(); ++i) {
    if (values[i] != variables[i].value) all.push_back(definition(variables[i], values[i]));
  }
  return all;
}

}  // namespace whittle
