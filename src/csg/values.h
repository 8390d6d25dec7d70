// The values of .csg text: constants, and the argument lists made of them.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "csg/lexer.h"
#include "model/warnings.h"

namespace whittle {

/// A constant. Vectors stand in preorder: the elements of a vector are from begin() on, each at the
/// end() of the one before it, up to its own end(). So a value and all that is in it can be copied
/// as it is. There are millions of them, so they are small.
struct Value {
  enum class Kind : uint8_t { kUndef, kBool, kNumber, kString, kVector };

  union {
    double number = 0;       ///< kNumber; kBool: 0 or 1
    const char* first_char;  ///< kString: what stands between the quotes, escapes as written
  };
  uint32_t size = 0;  ///< kString: its bytes; kVector: all values in it, those in vectors too
  Kind kind = Kind::kUndef;

  std::string_view text() const { return {first_char, size}; }
  /// How many values this one is, itself and those in it.
  uint32_t extent() const { return kind == Kind::kVector ? size + 1 : 1; }

  const Value* begin() const { return this + 1; }
  const Value* end() const { return this + extent(); }
};
static_assert(sizeof(Value) == 16);

/// An argument as written.
struct Argument {
  std::string_view name;  ///< empty if it has none
  uint32_t value = 0;     ///< index into CsgArguments::values
  SourceLocation where;
  uint32_t begin = 0, end = 0;  ///< bytes of the value in the text
};

/// The values of a statement. One object serves all statements, so that nothing is allocated each
/// time.
struct CsgArguments {
  std::vector<Argument> list;
  std::vector<Value> values;
  size_t most_values = SIZE_MAX;  ///< more are a mistake
  std::vector<uint32_t> open;     ///< scratch: vectors that are being read
};

/// Names that stand for values: OpenSCAD's own, and those assigned at the top level.
class Constants {
 public:
  /// The value of `name`, with all that is in it; undef, and a warning, if there is none.
  /// Names of numbers that are not finite, as dumps have them (inf, nan), are numbers.
  /// Precondition here and below: the name was admitted.
  const Value* look_up(std::string_view name, SourceLocation where, Warnings& warnings);

  /// False, and a mistake, if `name` would be one too many.
  bool admit(CsgLexer& lexer, std::string_view name, SourceLocation where) const;

  /// `name` stands for `value` from here on. False if OpenSCAD would use it elsewhere too (there
  /// the last assignment of a name rules wherever the name is used) and that use has passed.
  bool assign(std::string_view name, const Value& value);

  /// Whether the names that a piece of the text has used, which knew nothing of what came before
  /// it, mean the same here.
  bool agrees_with(const Constants& piece) const {
    return piece.table_.empty() || (!has_own_ && !piece.has_own_);
  }
  /// Takes them over.
  void append(const Constants& piece) { table_.insert(piece.table_.begin(), piece.table_.end()); }

  void clear() {
    table_.clear();
    has_own_ = false;
  }

 private:
  struct Constant {
    std::vector<Value> value;
    bool used = false;
  };
  std::map<std::string, Constant, std::less<>> table_;
  bool has_own_ = false;  ///< names that are not OpenSCAD's
};

/// Records as a mistake that `what` was expected instead of what comes next, where a value may have
/// ended; what goes on as an expression is said to. Always false.
bool expected_after_value(CsgLexer& lexer, std::string_view what);

/// Reads one value and appends it to `arguments.values`. False: a mistake, recorded in the lexer.
bool read_value(CsgLexer& lexer, Constants& constants, Warnings& warnings, CsgArguments& arguments);

/// Reads arguments up to and with the closing parenthesis into `arguments`, which is cleared first.
/// The opening one has been read. `is_text` says that the arguments are those of text(), whose
/// string may need to be recovered.
bool read_arguments(CsgLexer& lexer, Constants& constants, Warnings& warnings, bool is_text,
                    CsgArguments& arguments);

}  // namespace whittle
