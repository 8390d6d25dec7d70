#include "edit/insertion.h"

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "edit/layout.h"

namespace whittle {
namespace {

using Body = SyntaxNode::Body;

bool is_single(const SourceDocument& document, const SyntaxNode& node) {
  return document.node(node.parent).children == Body::kSingle;
}

}  // namespace

Insertion insertion_before(const SourceDocument& document, uint32_t node) {
  const SyntaxNode& n = document.node(node);
  if (is_single(document, n)) return {{{n.begin, 0, "{  "}, {n.end, 0, " }"}}, 0, 2};
  const std::string_view text = document.text();
  if (!is_alone(text, n)) return {{{n.begin, 0, " "}}, 0, 0};
  return {{{n.begin, 0, fmt::format("{}{}", line_end(text), indentation(text, n))}}, 0, 0};
}

Insertion insertion_behind(const SourceDocument& document, uint32_t node) {
  const SyntaxNode& n = document.node(node);
  if (is_single(document, n)) return {{{n.begin, 0, "{ "}, {n.end, 0, "  }"}}, 1, 1};
  const std::string_view text = document.text();
  if (!is_alone(text, n)) return {{{n.end, 0, " "}}, 0, 1};
  const std::string start = fmt::format("{}{}", line_end(text), indentation(text, n));
  return {{{n.end, 0, start}}, 0, start.size()};
}

Insertion insertion_into(const SourceDocument& document, uint32_t parent) {
  const SyntaxNode& p = document.node(parent);
  const std::string_view text = document.text();
  if (p.form == SyntaxNode::Form::kFile) {
    // A comment may stand on the last line.
    const std::string_view before = p.end > p.begin && text.back() != '\n' ? line_end(text) : "";
    return {{{p.end, 0, fmt::format("{}{}", before, line_end(text))}}, 0, before.size()};
  }
  if (p.children == Body::kNone) return {{{p.body, 1, "{  }"}}, 0, 2};
  return {{{size_t{p.body} + 1, 0, "  "}}, 0, 1};
}

}  // namespace whittle
