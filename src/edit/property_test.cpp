// What must hold for every text and every row of edits.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "edit/document_for_test.h"
#include "edit/marks.h"
#include "edit/parameters.h"
#include "edit/random_edits_for_test.h"
#include "edit/structure.h"
#include "edit/wraps.h"

namespace whittle {
namespace {

TEST(EditProperties, AfterEveryEditTheTreeIsThatOfTheText) {
  EXPECT_TRUE(rc::check([](uint64_t seed) {
    EditDice dice(seed);
    SourceDocument document = open_good(dice.text());
    for (int i = 0; i < 20; ++i) {
      dice.edit(document);
      RC_ASSERT(has_right_tree(document));
    }
  }));
}

TEST(EditProperties, EveryStepIsUndoneAndDoneAgainToTheByte) {
  EXPECT_TRUE(rc::check([](uint64_t seed) {
    EditDice dice(seed);
    SourceDocument document = open_good(dice.text());
    std::vector<std::string> texts{document.text()};
    for (int i = 0; i < 20; ++i) {
      const uint64_t before = document.version();
      dice.edit(document);
      if (document.version() != before) texts.push_back(document.text());
    }
    size_t at = texts.size() - 1;
    for (int i = 0; i < 60; ++i) {
      const bool goes_back = i < 20 || dice.below(2) == 0;
      RC_ASSERT(document.can_undo() == (at > 0));
      RC_ASSERT(document.can_redo() == (at + 1 < texts.size()));
      if (goes_back) {
        RC_ASSERT(document.undo().has_value() == (at > 0));
        at -= at > 0;
      } else {
        RC_ASSERT(document.redo().has_value() == (at + 1 < texts.size()));
        at += at + 1 < texts.size();
      }
      RC_ASSERT(document.text() == texts[at]);
      RC_ASSERT(document.is_modified() == (at > 0));
      RC_ASSERT(has_right_tree(document));
    }
  }));
}

/// A tree without its places, to be edited beside the text: what the text must say.
struct Plain {
  std::string head;  ///< marks, name and values
  std::vector<Plain> children;
  bool operator==(const Plain&) const = default;
};

std::string head_of(const SourceDocument& document, uint32_t index) {
  const SyntaxNode& node = document.node(index);
  std::string head;
  for (const Mark mark : {Mark::kDisabled, Mark::kRoot, Mark::kHighlight, Mark::kBackground}) {
    if (has_mark(node, mark)) head += char(mark);
  }
  if (node.form != SyntaxNode::Form::kBlock) head += name_of(document.text(), node);
  std::vector<std::string> values;
  for (const ArgumentPlace& place : argument_places(document.text(), node)) {
    const TextRange range = place.value.range;
    values.push_back(place.name + "=" + document.text().substr(range.begin, range.size()));
  }
  std::sort(values.begin(), values.end());
  for (const std::string& value : values) head += " " + value;
  return head;
}

Plain plain_of(const SourceDocument& document) {
  const SyntaxTree& tree = document.tree();
  // From the last node to the first, so that the children of a node are there when it comes.
  std::vector<Plain> all(tree.nodes.size());
  for (uint32_t i = uint32_t(tree.nodes.size()); i-- > 0;) {
    if (i > 0) all[i].head = head_of(document, i);
    for (uint32_t c = i + 1; c < tree.nodes[i].last; c = tree.nodes[c].last) {
      all[i].children.push_back(std::move(all[c]));
    }
  }
  return all[0];
}

/// The children that a node's parent has, and which of them it is.
std::pair<std::vector<Plain>*, size_t> find_plain(Plain& root, const SyntaxTree& tree,
                                                  uint32_t node) {
  std::vector<size_t> way;
  for (uint32_t at = node; at != 0; at = tree.nodes[at].parent) {
    size_t number = 0;
    for (uint32_t c = tree.nodes[at].parent + 1; c < at; c = tree.nodes[c].last) ++number;
    way.push_back(number);
  }
  std::vector<Plain>* among = &root.children;
  for (size_t i = way.size(); i-- > 1;) among = &(*among)[way[i]].children;
  return {among, way[0]};
}

TEST(EditProperties, TheTextSaysWhatTheEditedTreeIs) {
  EXPECT_TRUE(rc::check([](uint64_t seed) {
    EditDice dice(seed);
    SourceDocument document = open_good(dice.text());
    for (int i = 0; i < 10; ++i) {
      const uint32_t node = dice.node(document);
      if (node == 0) return;
      Plain expected = plain_of(document);
      auto [among, number] = find_plain(expected, document.tree(), node);
      const Plain itself = (*among)[number];
      const SyntaxNode::Form form = document.node(node).form;
      const int what = dice.below(4);
      if (what == 0) {
        RC_ASSERT(bool(remove_nodes(document, {node})));
        among->erase(among->begin() + ptrdiff_t(number));
      } else if (what == 1) {
        const Result<uint32_t> copy = duplicate_node(document, node);
        RC_ASSERT(bool(copy));
        RC_ASSERT(head_of(document, *copy) == itself.head);
        among->insert(among->begin() + ptrdiff_t(number), itself);
      } else if (what == 2) {
        const auto to = size_t(dice.below(4));
        const Result<uint32_t> moved = move_node(document, node, document.node(node).parent, to);
        RC_ASSERT(bool(moved));
        RC_ASSERT(head_of(document, *moved) == itself.head);
        among->erase(among->begin() + ptrdiff_t(number));
        among->insert(among->begin() + ptrdiff_t(std::min(to, among->size())), itself);
      } else {
        const Result<uint32_t> grouped = group_nodes(document, {node}, "hull");
        RC_ASSERT(bool(grouped) == (form != SyntaxNode::Form::kAssignment));
        if (grouped) (*among)[number] = {"hull", {itself}};
      }
      RC_ASSERT(plain_of(document) == expected);
    }
  }));
}

TEST(EditProperties, ANumberThatIsSetIsReadAgain) {
  EXPECT_TRUE(rc::check([](uint64_t seed, double value) {
    EditDice dice(seed);
    SourceDocument document = open_good(dice.text());
    const uint32_t node = dice.node(document);
    const std::vector<NumberValue> numbers = numbers_of(document, node, 100);
    if (numbers.empty() || !std::isfinite(value)) return;
    const auto chosen = size_t(dice.below(int(numbers.size())));
    const std::string text = document.text();
    RC_ASSERT(bool(set_number(document, node, numbers[chosen].place, value)));
    const std::vector<NumberValue> after = numbers_of(document, node, 100);
    RC_ASSERT(after.size() == numbers.size());
    for (size_t i = 0; i < after.size(); ++i) {
      RC_ASSERT(after[i].value == (i == chosen ? value : numbers[i].value));
    }
    // Not a byte beside it is another.
    const TextRange old = numbers[chosen].range, now = after[chosen].range;
    RC_ASSERT(document.text().substr(0, now.begin) == text.substr(0, old.begin));
    RC_ASSERT(document.text().substr(now.end) == text.substr(old.end));
  }));
}

}  // namespace
}  // namespace whittle
