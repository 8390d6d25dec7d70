// From .csg text to a document: the grammar and the modifiers.
//
// file      = { statement | name "=" value ";" | ";" | "{" file "}" }
// statement = { "%" | "#" | "!" | "*" } name "(" arguments ")" ( ";" | statement | "{" file "}" )
//
// The stack of open statements is a vector, so depth costs memory and nothing else.
#include "csg/reader.h"
#include "base/limit_hint.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "csg/document_builder.h"
#include "csg/lexer.h"
#include "csg/statement_counter.h"
#include "csg/statements.h"
#include "csg/values.h"
#include "csg/views.h"

namespace whittle {
namespace {

class CsgReader {
 public:
  CsgReader(std::string_view text, const std::string& file_name, const ReadOptions& options,
            Warnings& warnings)
      : options_(options),
        file_(file_name),
        lexer_(text),
        warnings_(warnings),
        builder_(file_name, options, warnings) {
    arguments_.most_values = options.limits.values;
    stack_.push_back(builder_.root());
  }

  Result<Document> read() {
    if (!read_statements() || lexer_.mistake()) {
      return Error{ErrorKind::kInput, message_at(file_, lexer_.mistake()->where,
                                                 "error: " + lexer_.mistake()->message)};
    }
    Document document = builder_.finish();
    document.counts = counter_.counts();
    return document;
  }

 private:
  bool read_statements();
  bool read_statement();
  Modifiers read_modifiers();
  bool read_assignment(std::string_view name, SourceLocation where);
  bool read_end_of_file();
  bool open_block();
  void close_braces();
  bool admit_depth(SourceLocation where);
  bool open_children(const StatementType& type, OpenStatement open);
  void close_singles();

  /// Warns of what is not understood, and of what is done instead.
  void warn_unsupported(SourceLocation where, const std::string& what, std::string_view instead) {
    const std::string message = fmt::format("{}, {}", what, instead);
    if (stack_.back().is_background) {
      warnings_.add(message, where, message);
    } else {
      warnings_.add_unsupported(message, where, message, what);
    }
  }

  bool expected(std::string_view what) {
    lexer_.peek();
    const SourceLocation where = lexer_.location();
    return lexer_.fail(where, fmt::format("expected {} before {}", what, lexer_.describe_next()));
  }

  const ReadOptions& options_;
  const std::string& file_;
  CsgLexer lexer_;
  Warnings& warnings_;
  DocumentBuilder builder_;
  StatementCounter counter_;
  Constants constants_;
  std::vector<OpenStatement> stack_;
  CsgArguments arguments_;
};

/// True if the arguments of text() are such as OpenSCAD prints them.
bool are_dumped(const CsgArguments& arguments) {
  return arguments.list.size() > 1 && arguments.list[0].name == "text" &&
         arguments.list[1].name == "size";
}

bool CsgReader::read_statements() {
  for (;;) {
    const char c = lexer_.peek();
    if (c == '\0') return read_end_of_file();
    if (c == '}' && !stack_.back().single) {
      if (stack_.size() == 1) return lexer_.fail(lexer_.location(), "no '{' is open for this '}'");
      close_braces();
    } else if (c == '{' && !stack_.back().single) {
      if (!open_block()) return false;
    } else if (c == ';' && !stack_.back().single) {
      lexer_.advance();
    } else if (!read_statement()) {
      return false;
    }
  }
}

bool CsgReader::read_end_of_file() {
  if (lexer_.mistake()) return false;
  const OpenStatement& open = stack_.back();
  if (open.single) return expected("a statement");
  if (stack_.size() > 1) {
    return expected(fmt::format("the '}}' for the '{{' of line {}, column {}", open.where.line,
                                open.where.column));
  }
  return true;
}

bool CsgReader::open_block() {
  OpenStatement block = stack_.back();
  block.where = lexer_.location();
  block.is_block = true;
  if (!admit_depth(block.where)) return false;
  lexer_.advance();
  stack_.push_back(block);
  return true;
}

void CsgReader::close_braces() {
  lexer_.advance();
  const OpenStatement closed = stack_.back();
  stack_.pop_back();
  if (closed.is_block) {
    stack_.back().operands = closed.operands;
  } else {
    builder_.close(closed, stack_.back());
    close_singles();
  }
}

bool CsgReader::admit_depth(SourceLocation where) {
  if (stack_.size() <= options_.limits.depth) return true;
  return lexer_.fail(where, fmt::format("statements are nested deeper than the limit of {}{}",
                                        options_.limits.depth, limit_hint("depth")));
}

Modifiers CsgReader::read_modifiers() {
  Modifiers modifiers;
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

bool CsgReader::read_statement() {
  const Modifiers modifiers = read_modifiers();
  const SourceLocation where = lexer_.location();
  const std::string_view name = lexer_.identifier();
  if (name.empty()) return expected("a statement");
  const StatementType& type = find_statement(name);
  if (type.meaning == Meaning::kLanguage) {
    return lexer_.fail(where, fmt::format("'{}' is for OpenSCAD to evaluate; give the file a name "
                                          "that ends in .scad",
                                          name));
  }
  const char c = lexer_.peek();
  if (c == '=') return read_assignment(name, where);
  if (c != '(') return expected(fmt::format("'(' after {}", quote(name)));
  lexer_.advance();
  if (!read_arguments(lexer_, constants_, warnings_, type.meaning == Meaning::kText, arguments_)) {
    return false;
  }

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
bool CsgReader::open_children(const StatementType& type, OpenStatement open) {
  const char c = lexer_.peek();
  if (c == ';') {
    lexer_.advance();
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
void CsgReader::close_singles() {
  while (stack_.back().single) {
    const OpenStatement closed = stack_.back();
    stack_.pop_back();
    builder_.close(closed, stack_.back());
  }
}

bool CsgReader::read_assignment(std::string_view name, SourceLocation where) {
  lexer_.advance();
  arguments_.values.clear();
  if (!read_value(lexer_, constants_, warnings_, arguments_)) return false;
  if (lexer_.peek() != ';') return expected_after_value(lexer_, "';'");
  lexer_.advance();
  if (stack_.back().node != 0) {
    if (stack_.back().single) return lexer_.fail(where, "expected a statement, not an assignment");
    if (!stack_.back().drops_children) {
      warn_unsupported(where, "an assignment inside of a statement is not supported yet",
                       "it is ignored");
    }
    return true;
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

}  // namespace

Result<Document> read_document(std::string_view text, const std::string& file_name,
                               const ReadOptions& options, Warnings& warnings) {
  return CsgReader(text, file_name, options, warnings).read();
}

}  // namespace whittle
