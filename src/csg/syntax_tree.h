// The statements of .csg text as they are written, each with the bytes it takes: for who edits a
// text and leaves the rest of it as it is.
//
// The grammar is the reader's own (statement_reader.h), which tells a SyntaxBuilder of what it
// reads. What the statements mean is not looked at, so what the reader refuses for its meaning, as
// a polyhedron whose faces name points that there are not, has a tree all the same.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "csg/statements.h"
#include "whittle/options.h"

namespace whittle {

/// Bytes of a text, from `begin` up to `end`.
struct TextRange {
  size_t begin = 0, end = 0;

  size_t size() const { return end - begin; }
  bool operator==(const TextRange&) const = default;
};

/// A statement, an assignment, braces that stand alone, or the text as a whole.
struct SyntaxNode {
  enum class Form : uint8_t { kFile, kStatement, kAssignment, kBlock };
  /// What holds the children.
  enum class Body : uint8_t {
    kNone,    ///< `;`, or it is an assignment
    kSingle,  ///< nothing: one statement follows
    kBraces,  ///< `{ }`; of the file its first and last byte
  };

  // Places in the text, in bytes.
  uint32_t begin = 0;      ///< of its first modifier, or of the name
  uint32_t name = 0;       ///< of its name; of a block its brace
  uint32_t arguments = 0;  ///< behind `(`; of an assignment its value
  uint32_t body = 0;       ///< of `;`, `{` or the only child; of an assignment where its value ends
  uint32_t end = 0;        ///< behind its last byte

  uint32_t last = 0;    ///< index one past the last node of this subtree
  uint32_t parent = 0;  ///< index; the file's own is 0
  Form form = Form::kStatement;
  Body children = Body::kNone;
  Meaning meaning = Meaning::kUnion;  ///< of a statement
  StatementModifiers modifiers{};

  /// Where children can stand. Precondition: `children` is kBraces.
  TextRange inside() const {
    const uint32_t brace = form == Form::kFile ? 0 : 1;
    return {size_t{body} + brace, size_t{end} - brace};
  }
};

/// Nodes in preorder, as Model's; nodes[0] is the file. In this order places in the text rise.
struct SyntaxTree {
  std::vector<SyntaxNode> nodes;

  /// The last node that begins at `offset` or before it.
  uint32_t last_beginning_by(size_t offset) const;
  /// The innermost node that has the byte at `offset`; 0 if only the file has.
  uint32_t innermost(size_t offset) const;
  /// Children of the node; 0 for a number that is no node's.
  size_t child_count(uint32_t node) const;
};

/// The name of a statement or an assignment, as written.
std::string_view name_of(std::string_view text, const SyntaxNode& node);

/// Reads text that check_text() has passed, from `first` on. Errors are those of reading it as a
/// document, as far as they do not need to know what a statement means, with their place in
/// `file_name`. One pass, linear in the text; nesting costs memory, never stack.
Result<SyntaxTree> read_syntax(std::string_view text, size_t first, const std::string& file_name,
                               const ReadLimits& limits);

/// Reads whole statements that stand in `range` of a text, inside of `depth` others, as a tree of
/// their own; its places are those in the text. False if there are none but whole ones, or if they
/// are not understood.
bool read_statements(std::string_view text, TextRange range, size_t depth, const ReadLimits& limits,
                     SyntaxTree& tree);

/// Told of statements by the reader in the order of the text; makes their tree.
class SyntaxBuilder {
 public:
  explicit SyntaxBuilder(SyntaxTree& tree) : nodes_(tree.nodes) {
    nodes_.assign(
        1, {.last = 1, .form = SyntaxNode::Form::kFile, .children = SyntaxNode::Body::kBraces});
  }

  /// A statement up to its closing parenthesis, or a block's brace.
  void open(SyntaxNode node) {
    node.parent = current_;
    current_ = uint32_t(nodes_.size());
    nodes_.push_back(node);
  }
  /// What follows the parenthesis.
  void set_body(size_t offset, SyntaxNode::Body children) {
    nodes_[current_].body = uint32_t(offset);
    nodes_[current_].children = children;
  }
  /// The innermost open one ends before `offset`.
  void close(size_t offset) {
    SyntaxNode& node = nodes_[current_];
    node.end = uint32_t(offset);
    node.last = uint32_t(nodes_.size());
    current_ = node.parent;
  }
  void finish(size_t size) {
    nodes_[0].end = uint32_t(size);
    nodes_[0].last = uint32_t(nodes_.size());
  }
  size_t count() const { return nodes_.size(); }

 private:
  std::vector<SyntaxNode>& nodes_;
  uint32_t current_ = 0;
};

}  // namespace whittle
