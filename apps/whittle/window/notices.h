// What the window says over the picture: what is wrong for as long as it is, what was done for some
// seconds, and how far long work has come.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/timing.h"

namespace whittle {

class Notices {
 public:
  /// Stays until it is set again; empty: nothing is wrong.
  void set_error(std::string error) { error_ = std::move(error); }
  const std::string& error() const { return error_; }
  /// Stays for some seconds.
  void tell(std::string line);
  /// Seconds until a line goes; none if there is none.
  std::optional<double> next_change();
  bool is_empty();
  /// The lines, oldest first.
  const std::vector<std::string>& lines();

 private:
  void forget();

  std::string error_;
  std::vector<std::string> lines_;
  std::vector<double> until_;  ///< milliseconds of the watch
  Stopwatch watch_;
};

}  // namespace whittle
