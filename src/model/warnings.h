// Warnings about a file, many of one kind summed up in one line.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/model.h"

namespace whittle {

/// Something in a file that whittle does not understand (yet).
struct Unsupported {
  SourceLocation where;
  std::string message;  ///< as in "'roof' is not supported yet"
};

/// Collects warnings. Of each kind the first kShown are kept word by word, the others are counted.
class Warnings {
 public:
  static constexpr size_t kShown = 20;

  explicit Warnings(std::string file) : file_(std::move(file)) {}

  /// Adds `file:line:column: warning: message`. `kind` tells what counts as the same; it is a
  /// sentence that can stand for all of them, and there should be few kinds.
  void add(std::string_view kind, SourceLocation where, std::string_view message);

  /// Adds a message that is complete already.
  void add_full(std::string_view kind, std::string message);

  /// Adds a warning of what is left out or replaced: then the model may not be what was meant.
  void add_unsupported(std::string_view kind, SourceLocation where, std::string_view message,
                       std::string what);

  /// Adds a warning of a file that is not there.
  void add_missing_file(SourceLocation where, std::string_view name);

  /// Adds what a piece of the file gave that begins at `start`, and comes after all that gave what
  /// is here, as if it had been added here at once. Precondition: has_all_kinds() of the piece.
  void append(const Warnings& piece, SourceLocation start);
  /// False if there were so many kinds that some have become one.
  bool has_all_kinds() const;

  void clear();

  /// The first in the file of what add_unsupported() was told, if any.
  const std::optional<Unsupported>& unsupported() const { return unsupported_; }

  /// The first of what add_missing_file() was told, as a full message that calls it an error; empty
  /// if there is none.
  const std::string& missing_file() const { return missing_file_; }

  /// All messages, then a line for each kind of which some were only counted.
  std::vector<std::string> take();

 private:
  using Counts = std::map<std::string, size_t, std::less<>>;
  struct Shown {
    const std::string* kind;  ///< in counts_
    SourceLocation where;     ///< nowhere: the message is complete
    std::string message;
  };

  /// How many of this kind there are; kinds beyond so many are counted as one.
  Counts::value_type& count_of(std::string_view kind);

  std::string file_;
  std::vector<Shown> shown_;
  Counts counts_;
  std::optional<Unsupported> unsupported_;
  std::string missing_file_;
};

}  // namespace whittle
