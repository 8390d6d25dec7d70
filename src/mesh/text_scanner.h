// Words and numbers of a text, one after the other.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>

namespace whittle {

class TextScanner {
 public:
  explicit TextScanner(std::string_view text) : at_(text.data()), end_(text.data() + text.size()) {}

  bool is_at_end() const { return at_ == end_; }

  /// The rest of the line; what follows it is next.
  std::string_view line() {
    const char* const from = at_;
    while (at_ != end_ && *at_ != '\n' && *at_ != '\r') ++at_;
    const std::string_view found(from, size_t(at_ - from));
    if (at_ != end_ && *at_ == '\r') ++at_;
    if (at_ != end_ && *at_ == '\n') ++at_;
    return found;
  }

  /// The next word, after any white space; empty at the end.
  std::string_view word() {
    while (at_ != end_ && is_space(*at_)) ++at_;
    const char* const from = at_;
    while (at_ != end_ && !is_space(*at_)) ++at_;
    return {from, size_t(at_ - from)};
  }

  /// The next word as a number; none if it is not one.
  template <class T>
  std::optional<T> number() {
    return as_number<T>(word());
  }

  template <class T>
  static std::optional<T> as_number(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    T value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    return value;
  }

 private:
  static bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v';
  }

  const char* at_;
  const char* end_;
};

}  // namespace whittle
