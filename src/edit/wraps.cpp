#include "edit/wraps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "csg/argument_places.h"
#include "edit/mistake.h"
#include "edit/parameters.h"

namespace whittle {
namespace {

using Form = SyntaxNode::Form;

/// What a node's parent is, if it holds nothing but the node; 0 if it is not of that meaning.
uint32_t parent_around_one(const SourceDocument& document, uint32_t node, Meaning meaning) {
  const uint32_t parent = document.node(node).parent;
  const SyntaxNode& p = document.node(parent);
  const bool is_around_one = parent + 1 == node && p.last == document.node(node).last;
  return p.form == Form::kStatement && p.meaning == meaning && is_around_one ? parent : 0;
}

bool can_be_wrapped(const SyntaxNode& node) {
  return node.form == Form::kStatement || node.form == Form::kBlock;
}

/// Puts a statement around a node. Marks stay outside: what is hidden or no operand stays so.
Result<uint32_t> wrap(SourceDocument& document, uint32_t node, std::string_view statement,
                      SourceDocument::Step step) {
  const Splice splice{document.node(node).name, 0, fmt::format("{} ", statement)};
  return applied(document.apply({splice}, step), node);
}

Result<uint32_t> change_color(SourceDocument& document, uint32_t node, const PaintColor& color,
                              const std::string& vector, SourceDocument::Step step) {
  std::vector<Splice> splices{parameter_splice(document, node, "c", vector)};
  // Beside a vector of four numbers `alpha` counts all the same.
  for (const ArgumentPlace& argument : argument_places(document.text(), document.node(node))) {
    if (argument.name != "alpha") continue;
    splices.push_back(parameter_splice(document, node, "alpha", number_text(color.a)));
  }
  std::sort(splices.begin(), splices.end(),
            [](const Splice& a, const Splice& b) { return a.offset < b.offset; });
  return applied(document.apply(splices, step), node);
}

bool only_moves(const Affine& map) {
  return map == translation(map.translation);
}

/// The vector of a `translate` that is three numbers.
bool has_plain_vector(const SourceDocument& document, uint32_t node) {
  const std::vector<NumberValue> numbers = numbers_of(document, node, 4);
  return document.node(node).meaning == Meaning::kTranslate && numbers.size() == 3 &&
         std::all_of(numbers.begin(), numbers.end(), [](const NumberValue& number) {
           return number.place.parameter == "v" && number.place.indices.size() == 1;
         });
}

Result<uint32_t> move_vector(SourceDocument& document, uint32_t node, Vec3 by,
                             SourceDocument::Step step) {
  std::vector<Splice> splices;
  for (const NumberValue& number : numbers_of(document, node, 3)) {
    const double moved = number.value + by[int(number.place.indices[0])];
    if (moved == number.value) continue;
    splices.push_back({number.range.begin, number.range.size(), number_text(moved)});
  }
  return applied(document.apply(splices, step), node);
}

}  // namespace

Result<uint32_t> set_color(SourceDocument& document, uint32_t node, const PaintColor& color,
                           SourceDocument::Step step) {
  for (const double part : {color.r, color.g, color.b, color.a}) {
    if (!(part >= 0 && part <= 1)) return mistake("a part of the colour is not from 0 to 1");
  }
  const SyntaxNode& n = document.node(node);
  if (!can_be_wrapped(n)) return mistake("only statements can be painted");
  const std::string vector =
      fmt::format("[{}, {}, {}, {}]", number_text(color.r), number_text(color.g),
                  number_text(color.b), number_text(color.a));
  if (n.form == Form::kStatement && n.meaning == Meaning::kColor) {
    return change_color(document, node, color, vector, step);
  }
  if (const uint32_t parent = parent_around_one(document, node, Meaning::kColor)) {
    return change_color(document, parent, color, vector, step);
  }
  return wrap(document, node, fmt::format("color({})", vector), step);
}

Result<uint32_t> transform_node(SourceDocument& document, uint32_t node, const Affine& by,
                                SourceDocument::Step step) {
  if (!by.is_finite()) return mistake("the map is not finite");
  const SyntaxNode& n = document.node(node);
  if (!can_be_wrapped(n)) return mistake("only statements can be moved");
  if (by == Affine{}) return node;
  if (n.form == Form::kStatement && only_moves(by) && has_plain_vector(document, node)) {
    return move_vector(document, node, by.translation, step);
  }
  if (n.form == Form::kStatement && n.meaning == Meaning::kMultmatrix) {
    if (const std::optional<Affine> map = written_transform(document.text(), n)) {
      return set_matrix(document, node, by * *map, step);
    }
  }
  if (const uint32_t parent = parent_around_one(document, node, Meaning::kMultmatrix)) {
    if (const std::optional<Affine> map =
            written_transform(document.text(), document.node(parent))) {
      return set_matrix(document, parent, *map * by, step);
    }
  }
  return wrap(document, node, fmt::format("multmatrix({})", matrix_text(by)), step);
}

}  // namespace whittle
