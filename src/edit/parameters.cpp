#include "edit/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/append_number.h"
#include "edit/mistake.h"

namespace whittle {
namespace {

using Form = SyntaxNode::Form;
constexpr size_t kMatrixRows = 4;

std::optional<ValuePlace> find_value(const std::vector<ArgumentPlace>& arguments,
                                     std::string_view parameter) {
  for (const ArgumentPlace& argument : arguments) {
    if (argument.name == parameter) return argument.value;
  }
  return std::nullopt;
}

Splice value_splice(const SourceDocument& document, const SyntaxNode& node,
                    const std::vector<ArgumentPlace>& arguments, std::string_view parameter,
                    std::string_view value) {
  if (const std::optional<ValuePlace> place = find_value(arguments, parameter)) {
    return {place->range.begin, place->range.size(), std::string(value)};
  }
  // Before the others: with its name it takes no place from those that have none.
  const size_t next = document.text().find_first_not_of(" \t\r\n", node.arguments);
  const std::string_view mark = document.text()[next] == ')' ? "" : ", ";
  return {node.arguments, 0, fmt::format("{} = {}{}", parameter, value, mark)};
}

Status check_parameter(const SourceDocument& document, const SyntaxNode& node,
                       const std::string& parameter) {
  const std::string name(name_of(document.text(), node));
  if (node.form == Form::kAssignment && parameter == name) return Done{};
  if (node.form != Form::kStatement) return mistake("only statements have parameters");
  const bool is_name =
      !parameter.empty() && CsgLexer(parameter).identifier().size() == parameter.size();
  const StatementType& type = find_statement(name);
  const bool is_known =
      !type.checks_arguments || parameter.starts_with('$') ||
      std::find(type.parameters.begin(), type.parameters.end(), parameter) != type.parameters.end();
  if (is_name && is_known) return Done{};
  return mistake(fmt::format("{} has no parameter {}", name, quote(parameter)));
}

/// Whether one number can stand for three in this parameter.
bool means_three(const SyntaxNode& node, std::string_view parameter) {
  return (node.meaning == Meaning::kCube && parameter == "size") ||
         (node.meaning == Meaning::kScale && parameter == "v");
}

/// Follows indices from a value inwards, and replaces what is there; none if it is that number.
Result<std::optional<Splice>> element_splice(const SourceDocument& document, const SyntaxNode& node,
                                             const NumberPlace& place, ValuePlace value,
                                             double wanted) {
  if (value.kind == Value::Kind::kNumber && place.indices.size() == 1 && place.indices[0] < 3 &&
      means_three(node, place.parameter)) {
    double three[3];
    std::fill_n(three, 3, value.number);
    three[place.indices[0]] = wanted;
    const std::string text = fmt::format("[{}, {}, {}]", number_text(three[0]),
                                         number_text(three[1]), number_text(three[2]));
    return std::optional(Splice{value.range.begin, value.range.size(), text});
  }
  for (const size_t index : place.indices) {
    const std::vector<ValuePlace> elements =
        index < value.range.size() ? element_places(document.text(), value.range, index + 1)
                                   : std::vector<ValuePlace>();
    if (elements.size() <= index) {
      return mistake(fmt::format("{} has no element {}", quote(place.parameter), index));
    }
    value = elements[index];
  }
  if (value.kind == Value::Kind::kNumber && value.number == wanted) return std::optional<Splice>();
  return std::optional(Splice{value.range.begin, value.range.size(), number_text(wanted)});
}

/// Appends what must be replaced in a matrix of three or four rows of four numbers. False if it is
/// none.
bool plain_matrix_splices(std::string_view text, const std::optional<ValuePlace>& matrix,
                          const Affine& map, std::vector<Splice>& splices) {
  if (!matrix) return false;
  const std::vector<ValuePlace> rows = element_places(text, matrix->range, kMatrixRows + 1);
  if (rows.size() != 3 && rows.size() != kMatrixRows) return false;
  for (int row = 0; row < int(rows.size()); ++row) {
    const std::vector<ValuePlace> elements =
        element_places(text, rows[size_t(row)].range, kMatrixRows + 1);
    if (elements.size() != kMatrixRows) return false;
    for (int column = 0; column < 4; ++column) {
      const ValuePlace& element = elements[size_t(column)];
      if (element.kind != Value::Kind::kNumber) return false;
      const double wanted = row == 3      ? double(column == 3)
                            : column == 3 ? map.translation[row]
                                          : map.row[row][column];
      if (element.number == wanted) continue;
      splices.push_back({element.range.begin, element.range.size(), number_text(wanted)});
    }
  }
  return true;
}

void append_numbers(std::string_view text, const std::string& parameter, const ValuePlace& value,
                    size_t most, std::vector<NumberValue>& numbers) {
  // Vectors in vectors are enough for matrices and points; deeper ones no parameter has.
  constexpr size_t kDeepest = 2;
  struct Pending {
    ValuePlace value;
    std::vector<size_t> indices;
  };
  std::vector<Pending> pending{{value, {}}};
  while (!pending.empty() && numbers.size() < most) {
    const Pending next = std::move(pending.back());
    pending.pop_back();
    if (next.value.kind == Value::Kind::kNumber) {
      numbers.push_back({{parameter, next.indices}, next.value.number, next.value.range});
    }
    if (next.value.kind != Value::Kind::kVector || next.indices.size() == kDeepest) continue;
    std::vector<ValuePlace> elements = element_places(text, next.value.range, most);
    for (size_t i = elements.size(); i-- > 0;) {
      pending.push_back({elements[i], next.indices});
      pending.back().indices.push_back(i);
    }
  }
}

}  // namespace

std::string number_text(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

std::string matrix_text(const Affine& map) {
  std::string text = "[";
  for (int i = 0; i < 3; ++i) {
    text += fmt::format("[{}, {}, {}, {}], ", number_text(map.row[i].x), number_text(map.row[i].y),
                        number_text(map.row[i].z), number_text(map.translation[i]));
  }
  return text + "[0, 0, 0, 1]]";
}

std::vector<NumberValue> numbers_of(const SourceDocument& document, uint32_t node, size_t most) {
  std::vector<NumberValue> numbers;
  for (const ArgumentPlace& argument : argument_places(document.text(), document.node(node))) {
    append_numbers(document.text(), argument.name, argument.value, most, numbers);
  }
  return numbers;
}

Result<uint32_t> set_number(SourceDocument& document, uint32_t node, const NumberPlace& place,
                            double value, SourceDocument::Step step) {
  if (!std::isfinite(value)) return mistake("the number is not finite");
  const SyntaxNode& n = document.node(node);
  if (Status known = check_parameter(document, n, place.parameter); !known) return known.error();
  const std::vector<ArgumentPlace> arguments = argument_places(document.text(), n);
  const std::optional<ValuePlace> given = find_value(arguments, place.parameter);
  if (!given) {
    if (!place.indices.empty()) {
      return mistake(fmt::format("{} is not given", quote(place.parameter)));
    }
    return set_value(document, node, place.parameter, number_text(value), step);
  }
  const Result<std::optional<Splice>> splice = element_splice(document, n, place, *given, value);
  if (!splice) return splice.error();
  if (!*splice) return node;
  return applied(document.apply({**splice}, step), node);
}

Result<uint32_t> set_value(SourceDocument& document, uint32_t node, const std::string& parameter,
                           std::string_view value, SourceDocument::Step step) {
  const SyntaxNode& n = document.node(node);
  if (Status known = check_parameter(document, n, parameter); !known) return known.error();
  if (!is_value(value)) return mistake(fmt::format("{} is not a value", quote(value)));
  const Splice splice = parameter_splice(document, node, parameter, value);
  if (document.text().compare(splice.offset, splice.removed, splice.text) == 0) return node;
  return applied(document.apply({splice}, step), node);
}

Splice parameter_splice(const SourceDocument& document, uint32_t node, std::string_view parameter,
                        std::string_view value) {
  const SyntaxNode& n = document.node(node);
  return value_splice(document, n, argument_places(document.text(), n), parameter, value);
}

Result<uint32_t> set_matrix(SourceDocument& document, uint32_t node, const Affine& map,
                            SourceDocument::Step step) {
  const SyntaxNode& n = document.node(node);
  if (n.form != Form::kStatement || n.meaning != Meaning::kMultmatrix) {
    return mistake("only a multmatrix has a matrix");
  }
  if (!map.is_finite()) return mistake("the matrix is not finite");
  const std::vector<ArgumentPlace> arguments = argument_places(document.text(), n);
  std::vector<Splice> splices;
  if (!plain_matrix_splices(document.text(), find_value(arguments, "m"), map, splices)) {
    splices.assign(1, value_splice(document, n, arguments, "m", matrix_text(map)));
  }
  return applied(document.apply(splices, step), node);
}

}  // namespace whittle
