#include "edit/layout.h"

namespace whittle {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

/// Where the blanks begin that stand right before an offset.
size_t before_blanks(std::string_view text, size_t offset) {
  while (offset > 0 && is_blank(text[offset - 1])) --offset;
  return offset;
}

bool begins_line(std::string_view text, size_t offset) {
  return offset == 0 || text[offset - 1] == '\n';
}

}  // namespace

std::string_view indentation(std::string_view text, const SyntaxNode& node) {
  const size_t from = before_blanks(text, node.begin);
  return begins_line(text, from) ? text.substr(from, node.begin - from) : std::string_view();
}

TextRange own_lines(std::string_view text, const SyntaxNode& node) {
  const TextRange statement{node.begin, node.end};
  const size_t from = before_blanks(text, node.begin);
  size_t to = node.end;
  while (to < text.size() && (is_blank(text[to]) || text[to] == '\r')) ++to;
  if (!begins_line(text, from) || (to < text.size() && text[to] != '\n')) return statement;
  return {from, to < text.size() ? to + 1 : to};
}

bool is_alone(std::string_view text, const SyntaxNode& node) {
  return begins_line(text, before_blanks(text, node.begin)) &&
         (own_lines(text, node) != TextRange{node.begin, node.end} || node.end == text.size());
}

std::string_view line_end(std::string_view text) {
  const size_t newline = text.find('\n');
  const bool has_return =
      newline != std::string_view::npos && newline > 0 && text[newline - 1] == '\r';
  return has_return ? "\r\n" : "\n";
}

}  // namespace whittle
