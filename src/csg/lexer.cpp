#include "csg/lexer.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <limits>
#include <utility>

#include "base/printable.h"

namespace whittle {
namespace {

/// The value of a decimal number that a double cannot hold: infinity or 0, by the exponent of its
/// first digit that counts.
double beyond_range(std::string_view digits) {
  const size_t mark = std::min(digits.find_first_of("eE"), digits.size());
  double exponent = 0;
  if (mark < digits.size()) {
    // Only the sign and the size matter; an exponent too long for an int is as good as infinite.
    const std::string_view tail = digits.substr(mark + 1);
    const bool negative = tail.front() == '-';
    for (const char c : tail) {
      if (is_digit(c)) exponent = exponent * 10 + (c - '0');
    }
    if (negative) exponent = -exponent;
  }
  const std::string_view mantissa = digits.substr(0, mark);
  const size_t point = std::min(mantissa.find('.'), mantissa.size());
  const size_t first = mantissa.find_first_of("123456789");
  if (first == std::string_view::npos) return 0;
  exponent +=
      first < point ? static_cast<double>(point - first) : -static_cast<double>(first - point);
  return exponent > 0 ? std::numeric_limits<double>::infinity() : 0;
}

int hexadecimal_digit(char c) {
  if (is_digit(c)) return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// The bytes of the UTF-8 character at the start of the text; 0 if there is none, or if no terminal
/// would show it.
size_t utf8_size(std::string_view text) {
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  const size_t size = first < 0x80 ? 1 : first < 0xc2 ? 0 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
  if (first > 0xf4 || size > text.size()) return 0;
  for (size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
  }
  // Of the second byte not everything is allowed: overlong forms, surrogates, beyond Unicode; and
  // the control characters U+0080 to U+009F.
  const unsigned char least = first == 0xc2 || first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80;
  const unsigned char most = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : 0xbf;
  return size < 2 || (byte(1) >= least && byte(1) <= most) ? size : 0;
}

/// The word that starts at `from`: all that a name or a number may hold.
std::string_view word_at(const char* from, const char* end) {
  const char* to = from;
  while (to != end && (is_name_part(*to) || *to == '.')) ++to;
  return {from, static_cast<size_t>(to - from)};
}

}  // namespace

std::string quote(std::string_view word) {
  constexpr size_t kLongest = 40;
  size_t length = std::min(word.size(), kLongest);
  // Not in the middle of a UTF-8 character.
  while (length < word.size() && length > 0 && (word[length] & 0xc0) == 0x80) --length;
  return fmt::format("'{}{}'", printable(word.substr(0, length)),
                     length < word.size() ? "..." : "");
}

bool CsgLexer::skip_rare_blank() {
  const auto c = static_cast<unsigned char>(*next_);
  if (c == '\r' || c == '\v' || c == '\f') {
    ++next_;
    return true;
  }
  // The no-break space, which arrives with text copied from web pages.
  if (c == 0xc2 && end_ - next_ > 1 && static_cast<unsigned char>(next_[1]) == 0xa0) {
    next_ += 2;
    return true;
  }
  return c == '/' && skip_comment();
}

bool CsgLexer::skip_comment() {
  if (is_followed_by('/')) {
    const void* newline = std::memchr(next_, '\n', static_cast<size_t>(end_ - next_));
    next_ = newline ? static_cast<const char*>(newline) : end_;
    return true;
  }
  if (!is_followed_by('*')) return false;
  const std::string_view rest(next_, static_cast<size_t>(end_ - next_));
  const size_t close = rest.find("*/", 2);
  if (close == std::string_view::npos) {
    fail(location(), "the comment is not closed: expected '*/' before the end of the file");
    next_ = end_;
    return false;
  }
  move_to(next_ + close + 2);
  return true;
}

void CsgLexer::move_to(const char* target) {
  while (next_ != target) {
    if (*next_ == '\n') {
      new_line();
    } else {
      ++next_;
    }
  }
}

std::string_view CsgLexer::identifier() {
  const char* const from = next_;
  if (from == end_ || !is_name_start(*from)) return {};
  const char* to = from + 1;
  while (to != end_ && is_name_part(*to)) ++to;
  next_ = to;
  return {from, static_cast<size_t>(to - from)};
}

bool CsgLexer::malformed_number(const char* from) {
  return fail(location(), fmt::format("malformed number {}", quote(word_at(from, end_))));
}

bool CsgLexer::long_number(double& value) {
  const char* const from = next_;
  const char* to = from;
  if (*from == '0' && (is_followed_by('x') || is_followed_by('X'))) {
    to += 2;
    if (to == end_ || hexadecimal_digit(*to) < 0) return malformed_number(from);
    for (value = 0; to != end_ && hexadecimal_digit(*to) >= 0; ++to) {
      value = value * 16 + hexadecimal_digit(*to);
    }
  } else if (const char* const exact = exact_decimal(from, end_, value)) {
    to = exact;
  } else {
    const auto [stop, error] = std::from_chars(from, end_, value);
    if (error == std::errc::invalid_argument) return malformed_number(from);
    to = stop;
    if (error == std::errc::result_out_of_range) {
      value = beyond_range({from, static_cast<size_t>(to - from)});
    }
  }
  if (to != end_ && continues_number(*to)) return malformed_number(from);
  next_ = to;
  return true;
}

bool CsgLexer::string(std::string_view& raw) {
  const char* close = next_ + 1;
  while (close != end_ && *close != '"') {
    if (*close == '\\' && close + 1 != end_) ++close;
    ++close;
  }
  if (close == end_) {
    return fail(location(), "the string is not closed: expected '\"' before the end of the file");
  }
  raw = {next_ + 1, static_cast<size_t>(close - next_ - 1)};
  move_to(close + 1);
  return true;
}

bool CsgLexer::is_after_string() const {
  CsgLexer ahead = *this;
  char c = ahead.peek();
  if (c != ',') return c == ')';
  ahead.advance();
  c = ahead.peek();
  if (!is_name_start(c)) return true;
  ahead.identifier();
  c = ahead.peek();
  return c == '=' || c == ',' || c == ')';
}

bool CsgLexer::dumped_text(std::string_view& raw) {
  const CsgLexer start = *this;
  if (string(raw) && is_after_string()) return true;
  // Once the search has gone to the end of the file for nothing, it need not again.
  if (no_dumped_text_ahead_) return !mistake_;
  const std::string_view rest(start.next_, static_cast<size_t>(end_ - start.next_));
  const size_t close = rest.find("\", size =", 1);
  if (close == std::string_view::npos) {
    no_dumped_text_ahead_ = true;
    return !mistake_;
  }
  *this = start;
  raw = rest.substr(1, close - 1);
  move_to(next_ + close + 1);
  return true;
}

std::string CsgLexer::describe_next() {
  const char c = peek();
  if (next_ == end_) return "the end of the file";
  if (is_name_part(c)) return quote(word_at(next_, end_));
  if (c > ' ' && c < 0x7f) return fmt::format("'{}'", c);
  const size_t size = utf8_size({next_, static_cast<size_t>(end_ - next_)});
  if (size > 1) return fmt::format("'{}'", std::string_view(next_, size));
  return fmt::format("the byte 0x{:02x}", static_cast<unsigned char>(c));
}

bool CsgLexer::fail(SourceLocation where, std::string message) {
  if (!mistake_) mistake_ = Mistake{where, std::move(message)};
  return false;
}

}  // namespace whittle
