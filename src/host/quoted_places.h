// Messages about a text that its author never sees: they quote the statement instead of giving its
// line and column.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace whittle {

/// The statement of .csg text that begins at `offset`, in about 60 characters: what is too long for
/// that ends in `...`.
std::string quote_statement(std::string_view text, size_t offset);

class QuotedPlaces {
 public:
  /// The text, which must outlive this object, and what messages about it call it.
  QuotedPlaces(std::string_view text, std::string file);

  /// `file:line:column: warning: what` as `file: warning: in "statement": what`; other messages as
  /// they are.
  std::string operator()(const std::string& message);

 private:
  size_t offset_of(size_t line, size_t column);

  std::string_view text_;
  std::string file_;
  std::vector<size_t> lines_;  ///< where each begins; empty until it is asked for
};

/// `file:line:column: warning: what` as `file: warning: what`; other messages as they are.
std::string without_place(const std::string& message, const std::string& file);

}  // namespace whittle
