// Any bytes as a .csg text and as edits of it: after each edit the tree is that of the text, a
// refused edit changes nothing, and all of them are undone and done again to the byte.
//
// The first line is the edits, a byte for each choice; the rest is the text.
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "edit/random_edits_for_test.h"
#include "edit/source_document.h"
#include "fuzz/require.h"
#include "fuzz/target.h"

namespace whittle {
namespace {

/// Small enough for thousands of inputs a second.
constexpr ReadLimits kLimits{.bytes = 1 << 14, .depth = 200, .nodes = 500, .values = 5000};
constexpr int kMostEdits = 16;

bool is_same(const SyntaxNode& a, const SyntaxNode& b) {
  const auto parts = [](const SyntaxNode& n) {
    return std::vector<size_t>{n.begin,
                               n.name,
                               n.arguments,
                               n.body,
                               n.end,
                               n.last,
                               n.parent,
                               size_t(n.form),
                               size_t(n.children),
                               size_t(n.meaning),
                               n.modifiers.background,
                               n.modifiers.highlight,
                               n.modifiers.root,
                               n.modifiers.disabled};
  };
  return parts(a) == parts(b);
}

void check_tree(const SourceDocument& document) {
  const Result<SourceDocument> fresh = SourceDocument::open(document.text(), "fuzz.csg", kLimits);
  require(bool(fresh), "an edit has made a text that is not understood: " + document.text());
  const std::vector<SyntaxNode>&a = document.tree().nodes, &b = fresh->tree().nodes;
  require(std::equal(a.begin(), a.end(), b.begin(), b.end(), is_same),
          "the tree is not that of the text: " + document.text());
  size_t end = 0;
  for (const SyntaxNode& node : a) {
    require(node.begin <= node.name && node.name <= node.arguments && node.arguments <= node.body &&
                node.body <= node.end,
            "the parts of a statement are not in order");
    require(node.end <= a[node.parent].end && node.begin >= a[node.parent].begin,
            "a statement reaches out of its parent");
    require(node.begin >= end, "nodes are out of order");
    end = node.begin;
  }
}

void check(std::string_view script, std::string_view text) {
  Result<SourceDocument> document = SourceDocument::open(std::string(text), "fuzz.csg", kLimits);
  if (!document) return;
  check_tree(*document);
  std::vector<std::string> texts{document->text()};
  EditDice dice([&script] {
    if (script.empty()) return uint32_t{0};
    const auto roll = static_cast<unsigned char>(script.front());
    script.remove_prefix(1);
    return uint32_t{roll};
  });
  for (int i = 0; i < kMostEdits && !script.empty(); ++i) {
    const uint64_t before = document->version();
    dice.edit(*document);
    if (document->version() == before) {
      require(document->text() == texts.back(), "a refused edit has changed the text");
    } else {
      texts.push_back(document->text());
    }
    check_tree(*document);
  }
  for (size_t i = texts.size(); i-- > 0;) {
    require(document->text() == texts[i], "undone it is another text");
    require(document->undo().has_value() == (i > 0), "steps are missing");
  }
  check_tree(*document);
  for (size_t i = 1; i < texts.size(); ++i) {
    require(document->redo().has_value(), "a step is not done again");
    require(document->text() == texts[i], "done again it is another text");
  }
  check_tree(*document);
}

}  // namespace
}  // namespace whittle

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const size_t line = std::min(input.find('\n'), input.size());
  const std::string_view rest = input.substr(line);
  whittle::check(input.substr(0, line), rest.substr(std::min<size_t>(1, rest.size())));
  return 0;
}
