// From .csg text to a document, statement by statement: the grammar and the modifiers.
//
// file      = { statement | name "=" value ";" | ";" | "{" file "}" }
// statement = { "%" | "#" | "!" | "*" } name "(" arguments ")" ( ";" | statement | "{" file "}" )
//
// The stack of open statements is a vector, so depth costs memory and nothing else.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "csg/document_builder.h"
#include "csg/lexer.h"
#include "csg/read_csg.h"
#include "csg/statement_counter.h"
#include "csg/statements.h"
#include "csg/syntax_tree.h"
#include "csg/values.h"
#include "model/document.h"
#include "model/warnings.h"

namespace whittle {

/// Reads a text from its beginning on, or a piece of one, of which it assumes that it stands in
/// nothing that matters. A piece can be read while what comes before it is not read yet, and
/// appended to that later, if the assumption was right.
class StatementReader {
 public:
  StatementReader(const std::string& file, const ReadOptions& options, Warnings& warnings);

  /// Takes the text, all of it. It must outlive this object; what is in it is only looked at where
  /// it is read, not where pieces are appended.
  void begin(std::string_view text) { lexer_ = CsgLexer(text); }
  /// The same, but nothing is made of the statements; `syntax` is told where they stand.
  void begin_syntax(std::string_view text, SyntaxBuilder& syntax);

  /// Reads on to the first place that is not before `stop` and where a statement may begin. False:
  /// a mistake.
  bool read_until(size_t stop);
  /// Reads what is left. False: a mistake.
  bool read_rest();

  /// Where it is in the text.
  size_t offset() const { return lexer_.offset(); }
  /// Whether read_until(stop) would read anything.
  bool is_before(size_t stop) const { return offset() < stop || stack_.back().single; }

  /// Reads a piece of a text, up to the end of its last statement, or all if it is the last piece;
  /// what was read before is forgotten. The text must be there until it is appended.
  void read_piece(std::string_view text, bool is_last);
  /// Appends a piece that begins here, as if it were read. False: it must be read, and nothing has
  /// changed.
  bool append(StatementReader& piece);

  const Mistake& mistake() const { return *lexer_.mistake(); }
  void make_room(double share_read) { builder_.make_room(share_read); }
  /// Once all is read.
  Document finish();

 private:
  bool read_statement();
  StatementModifiers read_modifiers();
  bool read_assignment(std::string_view name, SourceLocation where, SyntaxNode syntax);
  bool read_end_of_file();
  bool open_block();
  void close_braces();
  void close_outer();
  void add_to_outer(const OpenStatement& in_piece);
  bool admit_depth(SourceLocation where);
  bool report_statement(SyntaxNode node, const StatementType& type, StatementModifiers modifiers);
  bool open_children(const StatementType& type, OpenStatement open);
  void close_singles();
  bool can_append(const StatementReader& piece) const;

  void warn_unsupported(SourceLocation where, const std::string& what, std::string_view instead);
  bool expected(std::string_view what);

  const ReadOptions& options_;
  CsgLexer lexer_{{}};
  Warnings& warnings_;
  DocumentBuilder builder_;
  StatementCounter counter_;
  Constants constants_;
  std::vector<OpenStatement> stack_;
  CsgArguments arguments_;
  SyntaxBuilder* syntax_ = nullptr;  ///< null: a document is made

  // Of a piece: stack_[0] is what it stands in, whatever that is.
  bool is_piece_ = false;
  bool is_last_ = false;          ///< nothing comes behind it
  bool needs_its_place_ = false;  ///< what it says depends on what it stands in
  bool outer_is_used_ = false;    ///< statements stand directly in that
  size_t most_open_ = 0;          ///< statements at a time
  std::vector<OuterClose> closes_;
};

}  // namespace whittle
