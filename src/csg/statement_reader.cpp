#include "csg/statement_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/limit_hint.h"
#include "csg/views.h"

namespace whittle {
namespace {

/// True if the arguments of text() are such as OpenSCAD prints them.
bool are_dumped(const CsgArguments& arguments) {
  return arguments.list.size() > 1 && arguments.list[0].name == "text" &&
         arguments.list[1].name == "size";
}

}  // namespace

StatementReader::StatementReader(const std::string& file, const ReadOptions& options,
                                 Warnings& warnings)
    : options_(options), warnings_(warnings), builder_(file, options, warnings) {
  arguments_.most_values = options.limits.values;
  stack_.push_back(builder_.root());
}

void StatementReader::begin_syntax(std::string_view text, SyntaxBuilder& syntax) {
  begin(text);
  syntax_ = &syntax;
  // As under `*`: nothing of it is in the document.
  stack_.back().drops_children = true;
}

bool StatementReader::read_until(size_t stop) {
  while (is_before(stop)) {
    const CsgLexer::Mark after_last = lexer_.mark();
    const char c = lexer_.peek();
    if (c == '\0') {
      if (is_piece_ && !is_last_) lexer_.go_back(after_last);
      return !lexer_.mistake();
    }
    if (c == '}' && !stack_.back().single) {
      if (stack_.size() > 1) {
        lexer_.advance();
        close_braces();
      } else if (is_piece_) {
        lexer_.advance();
        close_outer();
      } else {
        return lexer_.fail(lexer_.location(), "no '{' is open for this '}'");
      }
    } else if (c == '{' && !stack_.back().single) {
      if (!open_block()) return false;
    } else if (c == ';' && !stack_.back().single) {
      lexer_.advance();
    } else if (!read_statement()) {
      return false;
    }
  }
  return true;
}

bool StatementReader::read_rest() {
  return read_until(SIZE_MAX) && read_end_of_file();
}

Document StatementReader::finish() {
  Document document = builder_.finish();
  document.counts = counter_.counts();
  return document;
}

/// Warns of what is not understood, and of what is done instead.
void StatementReader::warn_unsupported(SourceLocation where, const std::string& what,
                                       std::string_view instead) {
  const std::string message = fmt::format("{}, {}", what, instead);
  if (stack_.back().is_background) {
    warnings_.add(message, where, message);
  } else {
    warnings_.add_unsupported(message, where, message, what);
  }
}

bool StatementReader::expected(std::string_view what) {
  lexer_.peek();
  const SourceLocation where = lexer_.location();
  return lexer_.fail(where, fmt::format("expected {} before {}", what, lexer_.describe_next()));
}

bool StatementReader::read_end_of_file() {
  if (lexer_.mistake()) return false;
  const OpenStatement& open = stack_.back();
  if (open.single) return expected("a statement");
  if (stack_.size() > 1) {
    return expected(fmt::format("the '}}' for the '{{' of line {}, column {}", open.where.line,
                                open.where.column));
  }
  return true;
}

bool StatementReader::open_block() {
  needs_its_place_ |= is_piece_ && stack_.size() == 1;
  OpenStatement block = stack_.back();
  block.where = lexer_.location();
  block.is_block = true;
  if (!admit_depth(block.where)) return false;
  if (syntax_) {
    const auto at = uint32_t(lexer_.offset());
    if (!report_statement({.begin = at,
                           .name = at,
                           .arguments = at,
                           .body = at,
                           .form = SyntaxNode::Form::kBlock,
                           .children = SyntaxNode::Body::kBraces},
                          find_statement("union"), {})) {
      return false;
    }
  }
  lexer_.advance();
  stack_.push_back(block);
  return true;
}

void StatementReader::close_braces() {
  const OpenStatement closed = stack_.back();
  stack_.pop_back();
  if (syntax_) syntax_->close(lexer_.offset());
  if (closed.is_block) {
    stack_.back().operands = closed.operands;
  } else {
    builder_.close(closed, stack_.back());
    close_singles();
  }
}

/// Closes what the piece stands in; from here on it stands in what is around that.
void StatementReader::close_outer() {
  closes_.push_back({static_cast<uint32_t>(builder_.document().model.nodes.size()), outer_is_used_,
                     stack_.back()});
  stack_.back() = builder_.root();
  outer_is_used_ = false;
}

bool StatementReader::admit_depth(SourceLocation where) {
  most_open_ = std::max(most_open_, stack_.size());
  if (stack_.size() <= options_.limits.depth) return true;
  return lexer_.fail(where, fmt::format("statements are nested deeper than the limit of {}{}",
                                        options_.limits.depth, limit_hint("depth")));
}

StatementModifiers StatementReader::read_modifiers() {
  StatementModifiers modifiers;
  for (;; lexer_.advance()) {
    switch (lexer_.peek()) {
      case '%':
        modifiers.background = true;
        break;
      case '#':
        modifiers.highlight = true;
        break;
      case '!':
        modifiers.root = true;
        break;
      case '*':
        modifiers.disabled = true;
        break;
      default:
        return modifiers;
    }
  }
}

/// False, and a mistake, if there are too many.
bool StatementReader::report_statement(SyntaxNode node, const StatementType& type,
                                       StatementModifiers modifiers) {
  if (syntax_->count() > std::min<size_t>(options_.limits.nodes, OpenStatement::kNone - 2)) {
    return lexer_.fail(lexer_.location(),
                       fmt::format("there are more statements than the limit of {}{}",
                                   options_.limits.nodes, limit_hint("nodes")));
  }
  node.meaning = type.meaning;
  node.modifiers = modifiers;
  syntax_->open(node);
  return true;
}

bool StatementReader::read_statement() {
  lexer_.peek();
  SyntaxNode syntax{.begin = uint32_t(lexer_.offset())};
  const StatementModifiers modifiers = read_modifiers();
  const SourceLocation where = lexer_.location();
  syntax.name = uint32_t(lexer_.offset());
  const std::string_view name = lexer_.identifier();
  if (name.empty()) return expected("a statement");
  const StatementType& type = find_statement(name);
  if (type.meaning == Meaning::kLanguage) {
    return lexer_.fail(where, fmt::format("'{}' is for OpenSCAD to evaluate; give the file a name "
                                          "that ends in .scad",
                                          name));
  }
  const char c = lexer_.peek();
  if (c == '=') return read_assignment(name, where, syntax);
  if (c != '(') return expected(fmt::format("'(' after {}", quote(name)));
  lexer_.advance();
  syntax.arguments = uint32_t(lexer_.offset());
  if (!read_arguments(lexer_, constants_, warnings_, type.meaning == Meaning::kText, arguments_)) {
    return false;
  }

  if (syntax_ && !report_statement(syntax, type, modifiers)) return false;
  outer_is_used_ |= stack_.size() == 1;
  builder_.count(type.meaning);
  counter_.count(type, name, modifiers);
  const OpenStatement& parent = stack_.back();
  OpenStatement open{.scope = parent.scope};
  open.drops_children = parent.drops_children || modifiers.disabled;
  if (!open.drops_children) {
    const Statement statement = bind_arguments(type, where, arguments_, warnings_);
    std::optional<Mistake> mistake =
        builder_.add(statement, name, modifiers, are_dumped(arguments_), parent, open);
    if (mistake) return lexer_.fail(mistake->where, std::move(mistake->message));
  }
  return open_children(type, open);
}

/// Reads what follows the arguments of a statement.
bool StatementReader::open_children(const StatementType& type, OpenStatement open) {
  const char c = lexer_.peek();
  using Body = SyntaxNode::Body;
  if (c == ';') {
    if (syntax_) syntax_->set_body(lexer_.offset(), Body::kNone);
    lexer_.advance();
    if (syntax_) syntax_->close(lexer_.offset());
    builder_.close(open, stack_.back());
    close_singles();
    return true;
  }
  open.where = lexer_.location();
  open.single = c != '{';
  if (open.single && c != '%' && c != '#' && c != '!' && c != '*' && !is_name_start(c)) {
    return expected("';', '{' or a statement");
  }
  if (!admit_depth(open.where)) return false;
  if (syntax_) syntax_->set_body(lexer_.offset(), open.single ? Body::kSingle : Body::kBraces);
  if (!open.single) lexer_.advance();
  if (is_childless(type.meaning) && !open.drops_children) {
    open.drops_children = true;
    if (lexer_.peek() != '}') {
      const std::string message = fmt::format("{} takes no children; they are ignored{}", type.name,
                                              open.single ? " (is a ';' missing?)" : "");
      warnings_.add(message, open.where, message);
    }
  }
  stack_.push_back(open);
  return true;
}

/// Closes the statements whose only child, without braces, has just been closed.
void StatementReader::close_singles() {
  while (stack_.back().single) {
    const OpenStatement closed = stack_.back();
    stack_.pop_back();
    if (syntax_) syntax_->close(lexer_.offset());
    builder_.close(closed, stack_.back());
  }
}

bool StatementReader::read_assignment(std::string_view name, SourceLocation where,
                                      SyntaxNode syntax) {
  lexer_.advance();
  arguments_.values.clear();
  lexer_.peek();
  syntax.arguments = uint32_t(lexer_.offset());
  if (!read_value(lexer_, constants_, warnings_, arguments_)) return false;
  syntax.body = uint32_t(lexer_.offset());
  if (lexer_.peek() != ';') return expected_after_value(lexer_, "';'");
  lexer_.advance();
  if (syntax_) {
    syntax.form = SyntaxNode::Form::kAssignment;
    if (!report_statement(syntax, find_statement("group"), {})) return false;
    syntax_->close(lexer_.offset());
  }
  if (stack_.back().node != 0) {
    if (stack_.back().single) return lexer_.fail(where, "expected a statement, not an assignment");
    if (!stack_.back().drops_children) {
      warn_unsupported(where, "an assignment inside of a statement is not supported yet",
                       "it is ignored");
    }
    return true;
  }
  if (is_piece_) {
    needs_its_place_ = true;
    return false;
  }
  if (!constants_.admit(lexer_, name, where)) return false;
  const Value& value = arguments_.values.front();
  if (!constants_.assign(name, value)) {
    warn_unsupported(where, "a name is assigned after it was used",
                     "where OpenSCAD would use this value too");
  }
  if (!builder_.assign(name, value)) {
    assign_view(name, value, where, builder_.view(), warnings_);
  } else if (value.kind != Value::Kind::kNumber) {
    const std::string message = fmt::format("{} is not a number; it is ignored", name);
    warnings_.add(message, where, message);
  }
  return true;
}

void StatementReader::read_piece(std::string_view text, bool is_last) {
  lexer_ = CsgLexer(text);
  warnings_.clear();
  builder_.clear();
  counter_ = {};
  constants_.clear();
  stack_.assign(1, builder_.root());
  is_piece_ = true;
  is_last_ = is_last;
  needs_its_place_ = outer_is_used_ = false;
  most_open_ = 0;
  closes_.clear();
  needs_its_place_ |= !read_until(SIZE_MAX) || stack_.back().single;
}

bool StatementReader::can_append(const StatementReader& piece) const {
  const std::vector<Node>& nodes = builder_.document().model.nodes;
  const size_t added = piece.builder_.document().model.nodes.size() + piece.most_open_;
  if (piece.needs_its_place_ || piece.builder_.has_root() ||
      stack_.size() + piece.most_open_ > options_.limits.depth ||
      nodes.size() + added > std::min<size_t>(options_.limits.nodes, OpenStatement::kNone - 2) ||
      !constants_.agrees_with(piece.constants_) || !piece.warnings_.has_all_kinds()) {
    return false;
  }
  size_t level = stack_.size() - 1;
  // Whether what stands in this statement is what the piece took it for.
  const auto suits = [&](const OpenStatement& in_piece, bool is_used) {
    const OpenStatement& open = stack_[level];
    return !is_used ||
           (!open.drops_children && !open.is_background && !open.needs_corners &&
            (open.scope == 0 || !piece.builder_.inherits_fragments()) &&
            (!in_piece.drops_empty || !builder_.keeps_empty_operands(nodes[open.node])));
  };
  for (const OuterClose& close : piece.closes_) {
    if (level == 0 || !suits(close.statement, close.is_used)) return false;
    const bool is_block = stack_[level].is_block;
    --level;
    while (!is_block && stack_[level].single) --level;
  }
  return suits(piece.stack_.front(), piece.outer_is_used_);
}

void StatementReader::add_to_outer(const OpenStatement& in_piece) {
  stack_.back().operands += in_piece.operands;
}

bool StatementReader::append(StatementReader& piece) {
  if (!can_append(piece)) return false;
  const SourceLocation start = lexer_.location();
  const uint32_t shift =
      builder_.append(piece.builder_, start, piece.closes_, [&](const OuterClose& close) {
        add_to_outer(close.statement);
        close_braces();
      });
  add_to_outer(piece.stack_.front());
  const uint32_t outer_scope = stack_.back().scope;
  for (size_t i = 1; i < piece.stack_.size(); ++i) {
    OpenStatement open = piece.stack_[i];
    if (open.node != OpenStatement::kNone) open.node += shift;
    open.scope = open.scope == 0 ? outer_scope : builder_.append_scope(piece.builder_, open.scope);
    open.where = place_in_whole(open.where, start);
    stack_.push_back(open);
  }
  counter_.add(piece.counter_);
  constants_.append(piece.constants_);
  warnings_.append(piece.warnings_, start);
  lexer_.advance_as(piece.lexer_);
  return true;
}

}  // namespace whittle
