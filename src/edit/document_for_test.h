// What the tests of this folder share.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <utility>

#include "edit/source_document.h"

namespace whittle {

inline SourceDocument open_good(std::string_view text) {
  Result<SourceDocument> document = SourceDocument::open(std::string(text), "t.csg");
  if (!document) {
    ADD_FAILURE() << document.error().message << "\nin: " << text;
    return std::move(*SourceDocument::open("", "t.csg"));
  }
  return std::move(*document);
}

inline bool operator==(const SyntaxNode& a, const SyntaxNode& b) {
  return a.begin == b.begin && a.name == b.name && a.arguments == b.arguments && a.body == b.body &&
         a.end == b.end && a.last == b.last && a.parent == b.parent && a.form == b.form &&
         a.children == b.children && a.meaning == b.meaning &&
         a.modifiers.background == b.modifiers.background &&
         a.modifiers.highlight == b.modifiers.highlight && a.modifiers.root == b.modifiers.root &&
         a.modifiers.disabled == b.modifiers.disabled;
}

/// Whether the tree is that of the text.
inline bool has_right_tree(const SourceDocument& document) {
  const Result<SourceDocument> fresh = SourceDocument::open(document.text(), "t.csg");
  return fresh && fresh->tree().nodes == document.tree().nodes;
}

/// The first node of that name.
inline uint32_t node_named(const SourceDocument& document, std::string_view name) {
  for (uint32_t i = 1; i < document.tree().nodes.size(); ++i) {
    if (name_of(document.text(), document.node(i)) == name) return i;
  }
  ADD_FAILURE() << "no " << name << " in: " << document.text();
  return 0;
}

/// The text of a node.
inline std::string text_at(const SourceDocument& document, uint32_t node) {
  const SyntaxNode& n = document.node(node);
  return document.text().substr(n.begin, n.end - n.begin);
}

}  // namespace whittle
