// From .csg text to the model: the grammar, the modifiers, and the tree.
//
// file      = { statement | name "=" value ";" | ";" | "{" file "}" }
// statement = { "%" | "#" | "!" | "*" } name "(" arguments ")" ( ";" | statement | "{" file "}" )
//
// The stack of open statements is a vector, so depth costs memory and nothing else. Nodes are
// written in preorder as statements open, and simplified as they close; what that leaves to be
// removed goes in one pass at the end.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/csg_lexer.h"
#include "io/csg_statements.h"
#include "io/csg_text.h"
#include "io/csg_values.h"
#include "io/flat_shapes.h"
#include "io/polish.h"
#include "io/read.h"
#include "io/tree_edit.h"
#include "io/warnings.h"
#include "model/instances.h"

namespace whittle {
namespace {

constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

/// What stands before a statement.
struct Modifiers {
  bool background = false, highlight = false, root = false, disabled = false;
};

/// A statement whose children are being read.
struct OpenStatement {
  uint32_t node = kNone;   ///< kNone: it has none, because `*` drops it
  uint32_t operands = 0;   ///< children that are not background
  uint32_t scope = 0;      ///< index of the $fn, $fa, $fs for its children
  SourceLocation where{};  ///< of its `{`
  bool is_block = false;   ///< braces without a statement: what is in them is around them
  bool single = false;     ///< one statement without braces is its only child
  bool drops_children = false;
  bool is_root = false;  ///< marked with `!`
};

/// A primitive that inherits $fn, $fa or $fs from the top level, where assignments count for the
/// whole file wherever they stand. So its facets can be chosen only at the end.
struct PendingCurve {
  uint32_t primitive;
  GivenFragments given;
};

class CsgReader {
 public:
  CsgReader(std::string_view text, const std::string& file_name, const ReadOptions& options)
      : options_(options), lexer_(text), warnings_(file_name) {
    model_.file = file_name;
    arguments_.most_values = options.limits.values;
    model_.nodes.push_back({.kind = NodeKind::kUnion, .where = {1, 1}});
    stack_.push_back({.node = 0});
    scopes_.emplace_back();
  }

  Result<Read> read() {
    if (!read_statements() || lexer_.mistake() || !finish()) {
      return Error{ErrorKind::kInput, message_at(model_.file, lexer_.mistake()->where,
                                                 "error: " + lexer_.mistake()->message)};
    }
    return Read{std::move(model_), warnings_.take(), std::move(unsupported_)};
  }

 private:
  bool read_statements();
  bool read_statement();
  bool read_assignment(std::string_view name, SourceLocation where);
  void assign_view(std::string_view name, const Value& value, SourceLocation where);
  bool read_end_of_file();
  bool open_block();
  void close_braces();
  bool admit_depth(SourceLocation where);
  bool open_children(const StatementType& type, OpenStatement open);
  void close(const OpenStatement& closed);
  void close_singles();

  bool add_node(const Statement& statement, Modifiers modifiers, std::string_view name,
                uint32_t scope);
  bool set_meaning(const Statement& statement, std::string_view name, uint32_t scope, Node& node);
  bool add_primitive(const Statement& statement, uint32_t scope, Node& node);
  void choose_facets_of(uint32_t primitive, const GivenFragments& given);

  void read_polyhedra();
  bool finish();

  /// Warns of what is not understood, and of what is done instead.
  void warn_unsupported(SourceLocation where, const std::string& what, std::string_view instead) {
    const std::string message = fmt::format("{}, {}", what, instead);
    warnings_.add(message, where, message);
    if (!unsupported_) unsupported_ = Unsupported{where, what};
  }

  bool expected(std::string_view what) {
    lexer_.peek();
    const SourceLocation where = lexer_.location();
    return lexer_.fail(where, fmt::format("expected {} before {}", what, lexer_.describe_next()));
  }

  const ReadOptions options_;
  CsgLexer lexer_;
  Warnings warnings_;
  Model model_;
  std::optional<Unsupported> unsupported_;
  uint32_t root_ = kNone;  ///< the node marked with `!`
  Constants constants_;
  std::vector<OpenStatement> stack_;
  std::vector<GivenFragments> scopes_;  ///< [0] is the top level, where assignments go
  std::vector<PendingCurve> pending_;
  CsgArguments arguments_;
};

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
    close(closed);
    close_singles();
  }
}

bool CsgReader::admit_depth(SourceLocation where) {
  if (stack_.size() <= options_.limits.depth) return true;
  return lexer_.fail(where, fmt::format("statements are nested deeper than the limit of {}; "
                                        "--limit depth=N raises it",
                                        options_.limits.depth));
}

bool CsgReader::read_statement() {
  Modifiers modifiers;
  char c = lexer_.peek();
  for (;; lexer_.advance(), c = lexer_.peek()) {
    if (c == '%') {
      modifiers.background = true;
    } else if (c == '#') {
      modifiers.highlight = true;
    } else if (c == '!') {
      modifiers.root = true;
    } else if (c == '*') {
      modifiers.disabled = true;
    } else {
      break;
    }
  }
  const SourceLocation where = lexer_.location();
  const std::string_view name = lexer_.identifier();
  if (name.empty()) return expected("a statement");
  const StatementType& type = find_statement(name);
  if (type.meaning == Meaning::kLanguage) {
    return lexer_.fail(where, fmt::format("'{}' is for OpenSCAD to evaluate; give the file a name "
                                          "that ends in .scad",
                                          name));
  }
  c = lexer_.peek();
  if (c == '=') return read_assignment(name, where);
  if (c != '(') return expected(fmt::format("'(' after {}", quote(name)));
  lexer_.advance();
  if (!read_arguments(lexer_, constants_, warnings_, name == "text", arguments_)) {
    return false;
  }

  model_.statement_count += is_primitive(type.meaning);
  const OpenStatement& parent = stack_.back();
  OpenStatement open{.scope = parent.scope};
  open.drops_children = parent.drops_children || modifiers.disabled;
  if (!open.drops_children) {
    const Statement statement = bind_arguments(type, where, arguments_, warnings_);
    if (type.passes_fragments &&
        (statement.fragments.fn || statement.fragments.fa || statement.fragments.fs)) {
      if (!is_leaf(type.meaning)) {
        open.scope = static_cast<uint32_t>(scopes_.size());
        // Not the top level's, which may still change.
        scopes_.push_back(parent.scope == 0 ? statement.fragments
                                            : statement.fragments.within(scopes_[parent.scope]));
      }
    }
    open.node = static_cast<uint32_t>(model_.nodes.size());
    open.is_root = modifiers.root;
    if (!add_node(statement, modifiers, name, parent.scope)) return false;
  }
  return open_children(type, open);
}

/// Reads what follows the arguments of a statement.
bool CsgReader::open_children(const StatementType& type, OpenStatement open) {
  const char c = lexer_.peek();
  if (c == ';') {
    lexer_.advance();
    close(open);
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
  if (is_leaf(type.meaning) && !open.drops_children) {
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
    close(closed);
  }
}

/// Ends a node, all of whose children are read, and simplifies it where neither the solid nor an
/// owner of its surface can change.
void CsgReader::close(const OpenStatement& closed) {
  if (closed.node == kNone) return;
  std::vector<Node>& nodes = model_.nodes;
  Node& node = nodes[closed.node];
  node.end = static_cast<uint32_t>(nodes.size());
  OpenStatement& parent = stack_.back();
  parent.operands += !node.background;
  if (node.kind == NodeKind::kPrimitive) return;

  const bool childless = node.end == closed.node + 1;
  if (childless) {
    if (node.kind == NodeKind::kTransform) model_.transforms.pop_back();
    if (node.kind == NodeKind::kColor) model_.colors.pop_back();
    node.kind = NodeKind::kUnion;
    node.payload = 0;
  }
  if (node.background || node.highlight || closed.is_root) return;
  const NodeKind parent_kind = nodes[parent.node].kind;
  if (childless && parent_kind != NodeKind::kDifference && parent_kind != NodeKind::kIntersection) {
    // An empty operand of a union; elsewhere it counts.
    --parent.operands;
    nodes.pop_back();
  } else if (closed.operands == 1 && node.kind != NodeKind::kTransform &&
             node.kind != NodeKind::kColor) {
    node.end = kRemoved;
  }
}

bool CsgReader::add_node(const Statement& statement, Modifiers modifiers, std::string_view name,
                         uint32_t scope) {
  // The first node is no statement but the file.
  if (model_.nodes.size() > std::min<size_t>(options_.limits.nodes, kNone - 2)) {
    return lexer_.fail(
        statement.where,
        fmt::format("there are more statements than the limit of {}; --limit nodes=N raises it",
                    options_.limits.nodes));
  }
  if (modifiers.root) {
    if (root_ == kNone) {
      root_ = static_cast<uint32_t>(model_.nodes.size());
    } else {
      warnings_.add("'!' is given more than once; the first one counts", statement.where,
                    "'!' is given more than once; the first one counts");
    }
  }
  Node node{.background = modifiers.background,
            .highlight = modifiers.highlight,
            .where = statement.where};
  if (!set_meaning(statement, name, scope, node)) return false;
  model_.nodes.push_back(node);
  return true;
}

bool CsgReader::set_meaning(const Statement& statement, std::string_view name, uint32_t scope,
                            Node& node) {
  switch (statement.type->meaning) {
    case Meaning::kUnion:
      return true;
    case Meaning::kDifference:
      node.kind = NodeKind::kDifference;
      return true;
    case Meaning::kIntersection:
      node.kind = NodeKind::kIntersection;
      return true;
    case Meaning::kMultmatrix:
    case Meaning::kTranslate:
    case Meaning::kRotate:
    case Meaning::kScale:
    case Meaning::kMirror: {
      Affine map = make_transform(statement, warnings_);
      if (options_.polish && statement.type->meaning == Meaning::kMultmatrix) map = polished(map);
      if (map == Affine{}) return true;
      node.kind = NodeKind::kTransform;
      node.payload = static_cast<uint32_t>(model_.transforms.size());
      model_.transforms.push_back(map);
      return true;
    }
    case Meaning::kColor: {
      const Rgba color = make_color(statement, warnings_);
      if (color == Rgba{}) return true;
      node.kind = NodeKind::kColor;
      node.payload = static_cast<uint32_t>(model_.colors.size());
      model_.colors.push_back(color);
      return true;
    }
    case Meaning::kUnsupportedGroup:
    case Meaning::kUnsupportedLeaf: {
      // What OpenSCAD does not have either is rather a slip of the pen.
      warn_unsupported(statement.where,
                       fmt::format("{} is not {}", quote(name),
                                   statement.type->name.empty() ? "known" : "supported yet"),
                       is_leaf(statement.type->meaning) ? "nothing is shown for it"
                                                        : "shown as the union of its children");
      return true;
    }
    default:
      return add_primitive(statement, scope, node);
  }
}

bool CsgReader::add_primitive(const Statement& statement, uint32_t scope, Node& node) {
  node.kind = NodeKind::kPrimitive;
  node.payload = static_cast<uint32_t>(model_.primitives.size());
  Primitive& primitive = model_.primitives.emplace_back();
  primitive.id = model_.statement_count;
  bool is_curve = false;
  switch (statement.type->meaning) {
    case Meaning::kCube:
      primitive.shape = make_cube(statement, warnings_);
      break;
    case Meaning::kSphere:
      primitive.shape = make_sphere(statement, warnings_);
      is_curve = true;
      break;
    case Meaning::kCylinder:
      primitive.shape = make_cylinder(statement, warnings_);
      is_curve = true;
      break;
    case Meaning::kHalfspace:
      primitive.shape = make_halfspace(statement, warnings_);
      break;
    default: {
      std::string mistake;
      primitive.shape = make_polyhedron(statement, mistake);
      if (!mistake.empty()) return lexer_.fail(statement.where, "polyhedron: " + mistake);
      break;
    }
  }
  if (!is_curve) return true;
  GivenFragments given = statement.fragments;
  if (scope != 0) given = given.within(scopes_[scope]);
  if (given.is_complete()) {
    choose_facets_of(node.payload, given);
  } else {
    pending_.push_back({node.payload, given});
  }
  return true;
}

void CsgReader::choose_facets_of(uint32_t primitive, const GivenFragments& given) {
  Shape& shape = model_.primitives[primitive].shape;
  if (is_empty(shape)) return;
  if (auto* const sphere = std::get_if<Sphere>(&shape)) {
    sphere->facets = choose_facets(sphere->r, given.settings(), options_.curves);
  } else if (auto* const cylinder = std::get_if<Cylinder>(&shape)) {
    cylinder->facets =
        choose_facets(std::fmax(cylinder->r1, cylinder->r2), given.settings(), options_.curves);
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
  if (!scopes_[0].set(name, value)) {
    assign_view(name, value, where);
  } else if (value.kind != Value::Kind::kNumber) {
    const std::string message = fmt::format("{} is not a number; it is ignored", name);
    warnings_.add(message, where, message);
  }
  return true;
}

void CsgReader::assign_view(std::string_view name, const Value& value, SourceLocation where) {
  FileView& view = model_.view;
  const std::optional<Vec3> vector = as_vec3(value);
  const bool is_vector = vector && is_finite(*vector);
  const bool is_number = value.kind == Value::Kind::kNumber && std::isfinite(value.number);
  const bool is_angle = is_number && value.number > 0 && value.number < 180;
  if (name == "$vpt" && is_vector) {
    view.target = *vector;
  } else if (name == "$vpr" && is_vector) {
    view.rotation_degrees = *vector;
  } else if (name == "$vpd" && is_number) {
    view.distance = value.number;
  } else if (name == "$vpf" && is_angle) {
    view.fov_degrees = value.number;
  } else if (name == "$vpt" || name == "$vpr" || name == "$vpd" || name == "$vpf") {
    const std::string message = fmt::format("{} is not {}; it is ignored", name,
                                            name == "$vpd"   ? "a number"
                                            : name == "$vpf" ? "a number between 0 and 180"
                                                             : "three numbers");
    warnings_.add(message, where, message);
  }
}

void CsgReader::read_polyhedra() {
  for (const PolyhedronNote& note : build_polyhedra(model_)) {
    if (!note.left_out) {
      warnings_.add("a polyhedron is not quite what its faces say", note.where,
                    "polyhedron: " + note.what);
      continue;
    }
    constexpr std::string_view kInstead = "is not supported yet, nothing is shown for it";
    warnings_.add(fmt::format("a polyhedron {}", kInstead), note.where,
                  fmt::format("this polyhedron {}: {}", kInstead, note.what));
    if (!unsupported_ || note.where < unsupported_->where) {
      unsupported_ = Unsupported{
          note.where, fmt::format("this polyhedron is not supported yet: {}", note.what)};
    }
  }
}

bool CsgReader::finish() {
  model_.nodes[0].end = static_cast<uint32_t>(model_.nodes.size());
  for (const PendingCurve& curve : pending_) {
    choose_facets_of(curve.primitive, curve.given.within(scopes_[0]));
  }
  if (root_ != kNone) keep_subtree(model_, root_);
  remove_marked(model_);
  std::optional<Mistake> mistake = check_facets(model_, options_.limits.facets);
  if (!mistake) {
    read_polyhedra();
    // Faces that are not flat have become more.
    mistake = check_facets(model_, options_.limits.facets);
  }
  if (mistake) return lexer_.fail(mistake->where, std::move(mistake->message));
  for (std::string& warning : transform_warnings(model_)) {
    warnings_.add_full("a transform leaves nothing of what it moves", std::move(warning));
  }
  return true;
}

}  // namespace

Result<Read> read_csg(std::string_view text, const std::string& file_name,
                      const ReadOptions& options) {
  const Result<std::string_view> checked = check_text(text, file_name, options.limits);
  if (!checked) return checked.error();
  return CsgReader(*checked, file_name, options).read();
}

}  // namespace whittle
