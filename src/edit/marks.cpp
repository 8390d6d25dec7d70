#include "edit/marks.h"

#include <string>
#include <string_view>
#include <vector>

#include "csg/lexer.h"
#include "edit/mistake.h"

namespace whittle {
namespace {

/// Takes away all of a mark that stand before the name.
void remove_mark(std::string_view text, const SyntaxNode& node, Mark mark,
                 std::vector<Splice>& splices) {
  CsgLexer lexer(text.substr(0, node.name));
  lexer.skip_to(node.begin);
  for (char c = lexer.peek(); c != '\0'; c = lexer.peek()) {
    if (c == char(mark)) splices.push_back({lexer.offset(), 1, {}});
    lexer.advance();
  }
}

}  // namespace

bool has_mark(const SyntaxNode& node, Mark mark) {
  switch (mark) {
    case Mark::kDisabled:
      return node.modifiers.disabled;
    case Mark::kRoot:
      return node.modifiers.root;
    case Mark::kHighlight:
      return node.modifiers.highlight;
    case Mark::kBackground:
      return node.modifiers.background;
  }
  return false;
}

Result<uint32_t> set_mark(SourceDocument& document, uint32_t node, Mark mark, bool is_set) {
  if (document.node(node).form != SyntaxNode::Form::kStatement) {
    return mistake("only statements can be marked");
  }
  const std::vector<SyntaxNode>& nodes = document.tree().nodes;
  const bool clears_others = mark == Mark::kRoot && is_set;
  std::vector<Splice> splices;
  for (uint32_t i = clears_others ? 1 : node; i < (clears_others ? nodes.size() : node + 1); ++i) {
    const bool is_marked = has_mark(nodes[i], mark);
    if (i == node && is_set) {
      if (!is_marked) splices.push_back({nodes[i].begin, 0, std::string(1, char(mark))});
    } else if (is_marked) {
      remove_mark(document.text(), nodes[i], mark, splices);
    }
  }
  return applied(document.apply(splices), node);
}

}  // namespace whittle
