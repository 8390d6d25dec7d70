// Where the values of a statement stand in the text.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/affine.h"
#include "csg/syntax_tree.h"
#include "csg/values.h"

namespace whittle {

/// A value as it is written.
struct ValuePlace {
  TextRange range;                         ///< of the text
  Value::Kind kind = Value::Kind::kUndef;  ///< kUndef also for a name that is assigned elsewhere
  double number = 0;                       ///< kNumber; kBool: 0 or 1
};

/// The value of a parameter.
struct ArgumentPlace {
  std::string name;  ///< the parameter's, whether it is written or not
  ValuePlace value;
};

/// The values of a statement that count, in the order of the text: of several for one parameter the
/// last, none that no parameter takes. Of a statement that is not known all that have names. Of an
/// assignment the one value, under its name; of other nodes none.
std::vector<ArgumentPlace> argument_places(std::string_view text, const SyntaxNode& node);

/// Where the closing parenthesis of a statement is.
size_t arguments_end(std::string_view text, const SyntaxNode& node);

/// The elements of a vector, at most `most` of them; none if what stands in `range` is none.
std::vector<ValuePlace> element_places(std::string_view text, TextRange range, size_t most);

/// Whether `text` is one value and nothing else, not even a blank.
bool is_value(std::string_view text);

/// The map of a `multmatrix`, `translate`, `rotate`, `scale` or `mirror`, as it is written, not
/// polished; none if it is no such statement, or if a name stands in it.
std::optional<Affine> written_transform(std::string_view text, const SyntaxNode& node);

}  // namespace whittle
