// Reading and setting the parameters of statements.
//
// The functions of this folder that edit return where the statement then is in the tree. Errors are
// kInput, a sentence without a place; the document has not changed then.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/affine.h"
#include "base/result.h"
#include "csg/argument_places.h"
#include "edit/source_document.h"

namespace whittle {

/// A number of a statement: a parameter, or an element of one that is a vector, or of a vector in
/// that.
struct NumberPlace {
  std::string parameter;          ///< of an assignment the name it assigns
  std::vector<size_t> indices{};  ///< from 0; of a matrix row and column
};

/// A number that can be set.
struct NumberValue {
  NumberPlace place;
  double value = 0;
  TextRange range;
};

/// All numbers of a statement in the order of the text, at most `most` of them. What is a name is
/// none.
std::vector<NumberValue> numbers_of(const SourceDocument& document, uint32_t node, size_t most);

/// Makes the number `value`, in the fewest digits that are read as the same. A parameter that is
/// not given is added; whatever else its value was is replaced. One number for a cube's size or a
/// scale becomes three when an element is set. Errors too: the vector has no such element, or
/// `value` is not finite.
Result<uint32_t> set_number(SourceDocument& document, uint32_t node, const NumberPlace& place,
                            double value, SourceDocument::Step step = SourceDocument::Step::kOwn);

/// Makes a parameter `value`, which must be a value of the format: `5`, `[1, 2]`, `true`, `"a"`.
Result<uint32_t> set_value(SourceDocument& document, uint32_t node, const std::string& parameter,
                           std::string_view value,
                           SourceDocument::Step step = SourceDocument::Step::kOwn);

/// Makes the map of a `multmatrix` this one; of a matrix of numbers only those are written that
/// change.
Result<uint32_t> set_matrix(SourceDocument& document, uint32_t node, const Affine& map,
                            SourceDocument::Step step = SourceDocument::Step::kOwn);

/// How a parameter of a statement, given or not, gets a value.
Splice parameter_splice(const SourceDocument& document, uint32_t node, std::string_view parameter,
                        std::string_view value);

/// `[[a, b, c, d], ...]`, four rows.
std::string matrix_text(const Affine& map);

/// The fewest digits that are read as the same number.
std::string number_text(double value);

}  // namespace whittle
