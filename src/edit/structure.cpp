#include "edit/structure.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "csg/argument_places.h"
#include "csg/lexer.h"
#include "edit/insertion.h"
#include "edit/layout.h"
#include "edit/mistake.h"

namespace whittle {
namespace {

using Form = SyntaxNode::Form;
using Body = SyntaxNode::Body;

constexpr std::string_view kOperations[] = {"group",        "union", "difference",
                                            "intersection", "hull",  "minkowski"};

/// Sorted, each once, and none that is in another of them.
void keep_outermost(const SyntaxTree& tree, std::vector<uint32_t>& nodes) {
  std::sort(nodes.begin(), nodes.end());
  uint32_t last = 0;
  size_t kept = 0;
  for (const uint32_t node : nodes) {
    if (node < last) continue;
    nodes[kept++] = node;
    last = tree.nodes[node].last;
  }
  nodes.resize(kept);
}

bool is_node(const SourceDocument& document, uint32_t node) {
  return node > 0 && node < document.tree().nodes.size();
}

/// How a node goes.
Splice removal(const SourceDocument& document, uint32_t node) {
  const SyntaxNode& n = document.node(node);
  if (document.node(n.parent).children == Body::kSingle) return {n.begin, n.end - n.begin, ";"};
  const TextRange lines = own_lines(document.text(), n);
  return {lines.begin, lines.size(), {}};
}

std::string text_of(const SourceDocument& document, const SyntaxNode& node) {
  return document.text().substr(node.begin, node.end - node.begin);
}

/// Applies splices in any order, of which one inserts a statement behind `skip` bytes of its own.
/// Where that is then.
Result<uint32_t> apply_insertion(SourceDocument& document, std::vector<Splice> splices,
                                 size_t inserted, size_t skip) {
  const size_t offset = splices[inserted].offset;
  ptrdiff_t growth = 0;
  for (size_t i = 0; i < splices.size(); ++i) {
    // At one offset what is inserted comes before what goes.
    if (splices[i].offset >= offset) continue;
    growth += ptrdiff_t(splices[i].text.size()) - ptrdiff_t(splices[i].removed);
  }
  std::stable_sort(splices.begin(), splices.end(), [](const Splice& a, const Splice& b) {
    return a.offset != b.offset ? a.offset < b.offset : a.removed < b.removed;
  });
  if (Status done = document.apply(splices); !done) return done.error();
  const size_t at = size_t(ptrdiff_t(offset) + growth) + skip;
  return document.tree().last_beginning_by(at);
}

}  // namespace

Result<uint32_t> remove_nodes(SourceDocument& document, std::vector<uint32_t> nodes) {
  for (const uint32_t node : nodes) {
    if (!is_node(document, node)) return mistake("the file itself cannot be taken away");
  }
  if (nodes.empty()) return uint32_t{0};
  keep_outermost(document.tree(), nodes);
  const uint32_t parent = document.node(nodes[0]).parent;
  std::vector<Splice> splices;
  splices.reserve(nodes.size());
  for (const uint32_t node : nodes) splices.push_back(removal(document, node));
  return applied(document.apply(splices), parent);
}

Result<uint32_t> duplicate_node(SourceDocument& document, uint32_t node) {
  if (!is_node(document, node)) return mistake("the file itself cannot be doubled");
  const SyntaxNode& n = document.node(node);
  const uint32_t copy = n.last;
  Insertion insertion = insertion_behind(document, node);
  insertion.splices[insertion.main].text.insert(insertion.skip, text_of(document, n));
  return applied(document.apply(insertion.splices), copy);
}

Result<uint32_t> move_node(SourceDocument& document, uint32_t node, uint32_t parent,
                           size_t position) {
  if (!is_node(document, node)) return mistake("the file itself cannot be moved");
  if (parent >= document.tree().nodes.size()) return mistake("there is no such place");
  const SyntaxNode& n = document.node(node);
  const SyntaxNode& to = document.node(parent);
  if (parent >= node && parent < n.last) return mistake("a statement cannot be moved into itself");
  if (to.form == Form::kAssignment || (to.form == Form::kStatement && is_childless(to.meaning))) {
    return mistake("nothing can stand in this statement");
  }
  if (n.form == Form::kAssignment && n.parent != parent) {
    return mistake("an assignment counts only where it stands");
  }
  // The child that it comes before; none: behind the last one.
  uint32_t next = to.last, previous = 0;
  size_t count = 0;
  bool is_there = false;
  for (uint32_t child = parent + 1; child < to.last; child = document.node(child).last) {
    if (child == node) {
      is_there = count == position;
      continue;
    }
    if (count++ == position) {
      next = child;
      break;
    }
    previous = child;
  }
  if (n.parent == parent && (is_there || (next == to.last && n.last == to.last))) return node;
  if (to.children == Body::kSingle && n.parent == parent) return node;
  Insertion insertion = next != to.last ? insertion_before(document, next)
                        : previous != 0 ? insertion_behind(document, previous)
                                        : insertion_into(document, parent);
  insertion.splices[insertion.main].text.insert(insertion.skip, text_of(document, n));
  insertion.splices.push_back(removal(document, node));
  return apply_insertion(document, std::move(insertion.splices), insertion.main, insertion.skip);
}

Result<uint32_t> group_nodes(SourceDocument& document, std::vector<uint32_t> nodes,
                             std::string_view operation) {
  if (nodes.empty()) return mistake("nothing is to be grouped");
  if (!is_operation_name(operation)) {
    return mistake(fmt::format("{} is no operation", quote(operation)));
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  for (const uint32_t node : nodes) {
    if (!is_node(document, node)) return mistake("the file itself cannot be grouped");
    if (document.node(node).form == Form::kAssignment) {
      return mistake("an assignment cannot be grouped");
    }
    if (document.node(node).parent != document.node(nodes[0]).parent) {
      return mistake("what is to be grouped must stand in one statement");
    }
  }
  const std::string_view text = document.text();
  const SyntaxNode& first = document.node(nodes[0]);
  size_t together = 1;
  while (together < nodes.size() && document.node(nodes[together - 1]).last == nodes[together]) {
    ++together;
  }
  const SyntaxNode& last = document.node(nodes[together - 1]);
  const bool has_lines = is_alone(text, first);
  const std::string between =
      has_lines ? fmt::format("{}{}", line_end(text), indentation(text, first)) : " ";
  std::string tail;
  for (size_t i = together; i < nodes.size(); ++i) {
    tail += between + text_of(document, document.node(nodes[i]));
  }
  std::vector<Splice> splices{{first.begin, 0, fmt::format("{}() {{{}", operation, between)},
                              {last.end, 0, fmt::format("{}{}}}", tail, between)}};
  for (size_t i = together; i < nodes.size(); ++i) {
    splices.push_back(removal(document, nodes[i]));
  }
  return applied(document.apply(splices), nodes[0]);
}

bool is_operation_name(std::string_view name) {
  return std::find(std::begin(kOperations), std::end(kOperations), name) != std::end(kOperations);
}

Result<uint32_t> change_operation(SourceDocument& document, uint32_t node, std::string_view name) {
  const SyntaxNode& n = document.node(node);
  const bool is_operation = n.form == Form::kStatement &&
                            (n.meaning <= Meaning::kIntersection || n.meaning == Meaning::kHull ||
                             n.meaning == Meaning::kMinkowski);
  if (!is_operation) return mistake("only an operation can become another");
  if (!is_operation_name(name)) return mistake(fmt::format("{} is no operation", quote(name)));
  const std::string_view text = document.text(), written = name_of(text, n);
  if (written == name) return node;
  std::vector<Splice> splices{{n.name, written.size(), std::string(name)}};
  const StatementType& type = find_statement(name);
  const std::vector<ArgumentPlace> arguments = argument_places(text, n);
  const bool takes_all =
      std::all_of(arguments.begin(), arguments.end(), [&](const ArgumentPlace& argument) {
        return argument.name.starts_with('$') ||
               std::find(type.parameters.begin(), type.parameters.end(), argument.name) !=
                   type.parameters.end();
      });
  if (!takes_all) {
    const size_t close = arguments_end(text, n);
    splices.push_back({n.arguments, close - n.arguments, {}});
  }
  return applied(document.apply(splices), node);
}

}  // namespace whittle
