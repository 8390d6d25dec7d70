// Errors from outside (files, text, machines) travel as values; our own mistakes are checks.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <variant>

namespace whittle {

/// What went wrong, as the program's exit code tells it.
enum class ErrorKind {
  kInput = 1,    ///< the file or its content
  kUsage = 2,    ///< the command line
  kMachine = 3,  ///< device, memory, disk
};

struct Error {
  ErrorKind kind = ErrorKind::kInput;
  std::string message;  ///< one line for the user, `file:line:column: ...` where there is a place
};

/// A value, or the error that stands in its place.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

  explicit operator bool() const { return state_.index() == 0; }
  T& operator*() & { return *std::get_if<0>(&state_); }
  const T& operator*() const& { return *std::get_if<0>(&state_); }
  T&& operator*() && { return std::move(*std::get_if<0>(&state_)); }
  T* operator->() { return std::get_if<0>(&state_); }
  const T* operator->() const { return std::get_if<0>(&state_); }
  /// Precondition: there is no value.
  const Error& error() const { return *std::get_if<1>(&state_); }

 private:
  std::variant<T, Error> state_;
};

/// The result of something that is done for its effect.
struct Done {};
using Status = Result<Done>;

}  // namespace whittle

/// Always on: a broken invariant of ours stops the program and says where.
#define WHITTLE_CHECK(condition)                                                           \
  do {                                                                                     \
    if (!(condition)) {                                                                    \
      std::fprintf(stderr, "%s:%d: internal error: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                        \
    }                                                                                      \
  } while (false)
