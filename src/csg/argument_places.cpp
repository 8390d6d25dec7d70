#include "csg/argument_places.h"

#include <algorithm>

#include "csg/lexer.h"
#include "csg/maps.h"
#include "csg/statements.h"
#include "model/warnings.h"

namespace whittle {
namespace {

ValuePlace place_of(const Value& value, TextRange range) {
  const bool has_number = value.kind == Value::Kind::kNumber || value.kind == Value::Kind::kBool;
  return {range, value.kind, has_number ? value.number : 0};
}

/// A statement's arguments, read once more.
struct Reread {
  Reread(std::string_view text, const SyntaxNode& node)
      : type(find_statement(name_of(text, node))), lexer(text.substr(0, node.body)) {
    lexer.skip_to(node.arguments);
    is_good = read_arguments(lexer, constants, warnings, type.meaning == Meaning::kText, arguments);
  }

  const StatementType& type;
  CsgLexer lexer;
  Constants constants;
  Warnings warnings{std::string()};
  CsgArguments arguments;
  bool is_good = false;
};

}  // namespace

std::vector<ArgumentPlace> argument_places(std::string_view text, const SyntaxNode& node) {
  std::vector<ArgumentPlace> places;
  if (node.form == SyntaxNode::Form::kAssignment) {
    CsgLexer lexer(text.substr(0, node.end));
    lexer.skip_to(node.arguments);
    Constants constants;
    Warnings warnings{std::string()};
    CsgArguments arguments;
    if (read_value(lexer, constants, warnings, arguments)) {
      places.push_back({std::string(name_of(text, node)),
                        place_of(arguments.values.front(), {node.arguments, node.body})});
    }
    return places;
  }
  if (node.form != SyntaxNode::Form::kStatement) return places;
  Reread read(text, node);
  if (!read.is_good) return places;
  const Statement bound = bind_arguments(read.type, {}, read.arguments, read.warnings);
  const std::vector<Argument>& list = read.arguments.list;
  for (size_t i = 0; i < list.size(); ++i) {
    const Value& value = read.arguments.values[list[i].value];
    std::string name(list[i].name);
    if (read.type.checks_arguments && !name.starts_with('$')) {
      const auto taken = std::find(bound.arguments.begin(), bound.arguments.end(), &value);
      if (taken == bound.arguments.end()) continue;
      name = read.type.parameters[size_t(taken - bound.arguments.begin())];
    } else {
      const auto is_same = [&](const Argument& other) { return other.name == list[i].name; };
      if (name.empty() || std::any_of(list.begin() + ptrdiff_t(i) + 1, list.end(), is_same)) {
        continue;
      }
    }
    places.push_back({std::move(name), place_of(value, {list[i].begin, list[i].end})});
  }
  return places;
}

size_t arguments_end(std::string_view text, const SyntaxNode& node) {
  const Reread read(text, node);
  return read.lexer.offset() - 1;
}

std::vector<ValuePlace> element_places(std::string_view text, TextRange range, size_t most) {
  std::vector<ValuePlace> places;
  CsgLexer lexer(text.substr(0, range.end));
  lexer.skip_to(range.begin);
  if (lexer.peek() != '[') return places;
  lexer.advance();
  Constants constants;
  Warnings warnings{std::string()};
  CsgArguments arguments;
  while (places.size() < most) {
    const char c = lexer.peek();
    if (c == ']' || c == '\0') break;
    const size_t begin = lexer.offset();
    arguments.values.clear();
    if (!read_value(lexer, constants, warnings, arguments)) break;
    places.push_back(place_of(arguments.values.front(), {begin, lexer.offset()}));
    if (lexer.peek() != ',') break;
    lexer.advance();
  }
  return places;
}

bool is_value(std::string_view text) {
  if (text.find(char{0}) != std::string_view::npos) return false;
  CsgLexer lexer(text);
  Constants constants;
  Warnings warnings{std::string()};
  CsgArguments arguments;
  lexer.peek();
  return lexer.offset() == 0 && read_value(lexer, constants, warnings, arguments) &&
         lexer.offset() == text.size();
}

std::optional<Affine> written_transform(std::string_view text, const SyntaxNode& node) {
  if (node.form != SyntaxNode::Form::kStatement || node.meaning < Meaning::kMultmatrix ||
      node.meaning > Meaning::kMirror) {
    return std::nullopt;
  }
  Reread read(text, node);
  if (!read.is_good) return std::nullopt;
  const Affine map =
      make_transform(bind_arguments(read.type, {}, read.arguments, read.warnings), read.warnings);
  // Among them that a name is not known here, which may be assigned elsewhere.
  if (!read.warnings.take().empty()) return std::nullopt;
  return map;
}

}  // namespace whittle
