// The characters of .csg text as words: blanks, comments, names, numbers, strings.
//
// A scanner by hand, because the reader spends most of its time here (decision record 0002): it
// looks at each character once, copies nothing, and always knows its line and column.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "model/model.h"

namespace whittle {

/// Where reading stopped, and why.
struct Mistake {
  SourceLocation where;
  std::string message;
};

/// A word of the file in quotes for a message: shortened if it is long, and always on one line.
std::string quote(std::string_view word);

/// A cursor over text. The text must outlive it, hold no NUL, and be shorter than 4 GiB.
class CsgLexer {
 public:
  explicit CsgLexer(std::string_view text)
      : next_(text.data()), end_(text.data() + text.size()), line_start_(text.data()) {}

  /// Skips blanks and comments. The next character, left where it is; 0 at the end of the text, and
  /// after a comment that is not closed, which is a mistake.
  char peek() {
    while (next_ != end_) {
      const auto c = static_cast<unsigned char>(*next_);
      if (c == '\t' || c == ' ') {
        ++next_;
      } else if (c == '\n') {
        new_line();
      } else if (c > ' ' && c < 0x80 && c != '/') {
        return static_cast<char>(c);
      } else if (!skip_rare_blank()) {
        return next_ == end_ ? '\0' : static_cast<char>(c);
      }
    }
    return '\0';
  }

  /// Steps over the character that peek() returned. Precondition: it was not 0.
  void advance() { ++next_; }

  /// True if the character after the one that peek() returned is `c`.
  bool is_followed_by(char c) const { return end_ - next_ > 1 && next_[1] == c; }

  /// The place of what comes next; after peek(), of the character it returned.
  SourceLocation location() const {
    return {line_, static_cast<uint32_t>(next_ - line_start_) + 1};
  }

  /// A name, [A-Za-z_$][A-Za-z0-9_$]*, that starts at the cursor; empty if none does.
  std::string_view identifier();

  /// A number without a sign: digits with or without a point and an exponent, or 0x and hexadecimal
  /// digits. What is too large is infinite, what is too small is 0. False: a mistake.
  /// Precondition: a digit or a point is next.
  bool number(double& value);

  /// A string; `raw` is what stands between the quotes, escapes as written. False: a mistake.
  /// Precondition: a quote is next.
  bool string(std::string_view& raw);

  /// The same for the argument of text(), where OpenSCAD's dumper does not escape quotes: if
  /// no argument list goes on behind the first closing quote, the string ends before
  /// `", size =`.
  bool dumped_text(std::string_view& raw);

  /// What comes next, in words for a message: `';'`, `'cube'`, `the end of the file`.
  std::string describe_next();

  /// Records a mistake, unless one is recorded already. Always false.
  bool fail(SourceLocation where, std::string message);

  const std::optional<Mistake>& mistake() const { return mistake_; }

 private:
  void new_line() {
    ++next_;
    ++line_;
    line_start_ = next_;
  }
  bool skip_rare_blank();
  bool skip_comment();
  void move_to(const char* target);
  bool malformed_number(const char* from);
  bool is_after_string() const;

  const char* next_;
  const char* end_;
  const char* line_start_;
  uint32_t line_ = 1;
  bool no_dumped_text_ahead_ = false;
  std::optional<Mistake> mistake_;
};

inline bool is_name_start(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$';
}
inline bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
inline bool is_name_part(char c) {
  return is_name_start(c) || is_digit(c);
}

}  // namespace whittle
