// The characters of .csg text as words: blanks, comments, names, numbers, strings.
//
// A scanner by hand, because the reader spends most of its time here (decision record 0002): it
// looks at each character once, copies nothing, and always knows its line and column.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "csg/decimal.h"
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
      : begin_(text.data()), end_(begin_ + text.size()), next_(begin_), line_start_(begin_) {}

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

  /// How many bytes of the text are before the cursor.
  size_t offset() const { return static_cast<size_t>(next_ - begin_); }

  /// Goes on at a byte of the text. Lines and columns count from there.
  void skip_to(size_t offset) { next_ = line_start_ = begin_ + offset; }

  /// A place to come back to.
  struct Mark {
    const char* next;
    const char* line_start;
    uint32_t line;
  };
  Mark mark() const { return {next_, line_start_, line_}; }
  void go_back(const Mark& mark) {
    next_ = mark.next;
    line_start_ = mark.line_start;
    line_ = mark.line;
  }

  /// Steps over what comes next as far as another cursor has come that began here.
  void advance_as(const CsgLexer& piece) {
    if (piece.line_ > 1) line_start_ = next_ + (piece.line_start_ - piece.begin_);
    line_ += piece.line_ - 1;
    next_ += piece.next_ - piece.begin_;
  }

  /// A name, [A-Za-z_$][A-Za-z0-9_$]*, that starts at the cursor; empty if none does.
  std::string_view identifier();

  /// A number without a sign: digits with or without a point and an exponent, or 0x and hexadecimal
  /// digits. What is too large is infinite, what is too small is 0. False: a mistake.
  /// Precondition: a digit or a point is next.
  bool number(double& value) {
    if (end_ - next_ > 8) {
      const char* const to = short_decimal(next_, value);
      if (to != nullptr && !continues_number(*to)) {
        next_ = to;
        return true;
      }
    }
    return long_number(value);
  }

  /// A number of a vector in its plainest form, at most a blank before it and a comma or a closing
  /// bracket right behind it: that mark, which is taken too. 0, and nothing is taken, if what comes
  /// is anything else.
  char plain_element(double& value) {
    constexpr ptrdiff_t kEnough = 20;
    if (end_ - next_ < kEnough) return '\0';
    const char* const from = next_ + (*next_ == ' ');
    const bool negative = *from == '-';
    const char* to = short_decimal(from + negative, value);
    if (to == nullptr) to = longer_decimal(from + negative, value);
    if (to == nullptr || (*to != ',' && *to != ']')) {
      to = exact_decimal(from + negative, end_, value);
      if (to == nullptr || to == end_ || (*to != ',' && *to != ']')) return '\0';
    }
    if (negative) value = -value;
    next_ = to + 1;
    return *to;
  }

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
  bool long_number(double& value);
  bool malformed_number(const char* from);
  /// Whether a character right behind a number makes it malformed, or a longer one.
  static bool continues_number(char c);
  bool is_after_string() const;

  const char* begin_;
  const char* end_;
  const char* next_;
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
inline bool CsgLexer::continues_number(char c) {
  return c != ',' && c != ']' && c != ')' && (is_name_part(c) || c == '.');
}

}  // namespace whittle
