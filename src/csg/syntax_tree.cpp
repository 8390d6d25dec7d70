#include "csg/syntax_tree.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/limit_hint.h"
#include "csg/check_text.h"
#include "csg/lexer.h"
#include "csg/read_csg.h"
#include "csg/statement_reader.h"
#include "model/warnings.h"

namespace whittle {
namespace {

/// Moves what was read of a text that begins at `first` of the whole one.
void move_places(SyntaxTree& tree, size_t first) {
  const auto shift = uint32_t(first);
  for (SyntaxNode& node : tree.nodes) {
    for (uint32_t* place : {&node.begin, &node.name, &node.arguments, &node.body, &node.end}) {
      *place += shift;
    }
  }
}

}  // namespace

uint32_t SyntaxTree::last_beginning_by(size_t offset) const {
  const auto behind =
      std::upper_bound(nodes.begin() + 1, nodes.end(), offset,
                       [](size_t at, const SyntaxNode& node) { return at < node.begin; });
  return uint32_t(behind - nodes.begin()) - 1;
}

uint32_t SyntaxTree::innermost(size_t offset) const {
  uint32_t node = last_beginning_by(offset);
  while (node != 0 && nodes[node].end <= offset) node = nodes[node].parent;
  return node;
}

size_t SyntaxTree::child_count(uint32_t node) const {
  size_t count = 0;
  if (node >= nodes.size()) return count;
  for (uint32_t child = node + 1; child < nodes[node].last; child = nodes[child].last) ++count;
  return count;
}

std::string_view name_of(std::string_view text, const SyntaxNode& node) {
  return CsgLexer(text.substr(node.name)).identifier();
}

Result<SyntaxTree> read_syntax(std::string_view text, size_t first, const std::string& file_name,
                               const ReadLimits& limits) {
  const std::string_view rest = text.substr(first);
  if (Status passed = check_nul(rest, file_name); !passed) return passed.error();
  SyntaxTree tree;
  SyntaxBuilder builder(tree);
  const ReadOptions options{.threads = 1, .limits = limits};
  Warnings unheard(file_name);
  StatementReader reader(file_name, options, unheard);
  reader.begin_syntax(rest, builder);
  if (!reader.read_rest()) {
    return Error{ErrorKind::kInput, message_at(file_name, reader.mistake().where,
                                               "error: " + reader.mistake().message)};
  }
  builder.finish(rest.size());
  move_places(tree, first);
  return tree;
}

bool read_statements(std::string_view text, TextRange range, size_t depth, const ReadLimits& limits,
                     SyntaxTree& tree) {
  if (depth >= limits.depth) return false;
  ReadLimits inner = limits;
  inner.depth -= depth;
  Result<SyntaxTree> read =
      read_syntax(text.substr(0, range.end), range.begin, std::string(), inner);
  if (!read) return false;
  tree = std::move(*read);
  return true;
}

}  // namespace whittle
