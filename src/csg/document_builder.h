// The tree of a document, built while statements open and close.
//
// Nodes are written in preorder as statements open, and simplified as they close; what that leaves
// to be removed goes in one pass at the end.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "csg/lexer.h"
#include "csg/read_csg.h"
#include "csg/statements.h"
#include "model/document.h"
#include "model/warnings.h"

namespace whittle {

/// A statement whose children are being read.
struct OpenStatement {
  static constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

  uint32_t node = kNone;   ///< kNone: it has none, because `*` drops it
  uint32_t operands = 0;   ///< children that are not background
  uint32_t scope = 0;      ///< index of the $fn, $fa, $fs for its children
  SourceLocation where{};  ///< of its `{`
  bool is_block = false;   ///< braces without a statement: what is in them is around them
  bool single = false;     ///< one statement without braces is its only child
  bool drops_children = false;
  bool is_root = false;        ///< marked with `!`
  bool is_background = false;  ///< it or what it stands in is marked with `%`
  bool needs_corners = false;  ///< curves in it are OpenSCAD's facets, whatever was chosen
  bool drops_empty = false;    ///< an empty operand was left out
};

/// Where a piece of a text closes a statement that was opened before it.
struct OuterClose {
  uint32_t nodes = 0;       ///< of the piece when it does
  bool is_used = false;     ///< the piece has statements that stand directly in that one
  OpenStatement statement;  ///< what of it the piece knows
};

class DocumentBuilder {
 public:
  DocumentBuilder(const std::string& file, const ReadOptions& options, Warnings& warnings);

  /// The implicit union of all statements.
  OpenStatement root() const { return {.node = 0}; }

  /// Every statement that may have an id is to be counted, dropped or not, before it is added.
  void count(Meaning meaning) { document_.model.statement_count += has_id(meaning); }

  /// Adds a node and sets what `open` says about it and about what it will hold.
  std::optional<Mistake> add(const Statement& statement, std::string_view name,
                             StatementModifiers modifiers, bool is_dumped_text,
                             const OpenStatement& parent, OpenStatement& open);

  /// Ends a node, all of whose children are read, and simplifies it where neither the solid nor an
  /// owner of its surface can change.
  void close(const OpenStatement& closed, OpenStatement& parent);

  /// Takes $fn, $fa or $fs of the top level, where assignments count for the whole file wherever
  /// they stand. False if `name` is none of them.
  bool assign(std::string_view name, const Value& value) { return scopes_[0].set(name, value); }

  FileView& view() { return document_.model.view; }

  /// Whether an empty operand of such a node counts.
  static bool keeps_empty_operands(const Node& node) {
    return node.kind == NodeKind::kDifference || node.kind == NodeKind::kIntersection;
  }

  const Document& document() const { return document_; }

  /// Whether curves inherit $fn, $fa or $fs from what node 0 stands for.
  bool inherits_fragments() const { return inherits_fragments_; }
  /// Whether a statement is marked with `!`.
  bool has_root() const { return root_ != OpenStatement::kNone; }

  /// Adds what was built of a piece of the text that begins at `start`, all but its node 0, which
  /// stands for what is open here; the piece is of no use then. `close` ends what is open where
  /// `closes` say so. Returns what is to be added to a node's number in the piece.
  uint32_t append(DocumentBuilder& piece, SourceLocation start, std::span<const OuterClose> closes,
                  const std::function<void(const OuterClose&)>& close);
  /// The scope of that number in a piece that is appended, in this builder.
  uint32_t append_scope(const DocumentBuilder& piece, uint32_t scope);

  /// Gets memory for what is still to come, where so much of the text has been read.
  void make_room(double share_read);

  /// Forgets all that was read.
  void clear();

  /// Once all is read.
  Document finish();

 private:
  /// A curve that inherits $fn, $fa or $fs from the top level. So its facets can be chosen only at
  /// the end.
  struct Pending {
    NodeKind kind;
    bool needs_corners;
    uint32_t payload;
    GivenFragments given;
  };

  Affine polish(const Affine& map);
  std::optional<Mistake> set_meaning(const Statement& statement, std::string_view name,
                                     bool is_dumped_text, OpenStatement& open, Node& node);
  void set_primitive(Shape shape, Node& node);
  void set_leaf(Leaf leaf, Node& node);
  void set_operation(const Statement& statement, Node& node);
  void add_extruded_file(const Statement& statement, OpenStatement& open);
  void take_fragments(const Statement& statement, const OpenStatement& parent,
                      const OpenStatement& open, const Node& node);
  void set_fragments(const Pending& curve, const FragmentSettings& settings);

  const ReadOptions& options_;
  Warnings& warnings_;
  Document document_;
  uint32_t root_ = OpenStatement::kNone;  ///< the node marked with `!`
  bool has_removed_ = false;              ///< there are nodes to be removed
  bool inherits_fragments_ = false;
  Affine last_written_, last_polished_;  ///< many matrices in a row have one rotation
  std::vector<GivenFragments> scopes_;   ///< [0] is the top level, where assignments go
  std::vector<Pending> pending_;
};

}  // namespace whittle
