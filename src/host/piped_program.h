// Another program that is written to while it runs.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace whittle {

/// The program of a name that has a slash, or else the one on PATH; none if there is none.
std::optional<std::string> find_program(const std::string& name);

/// A program whose standard input is what is written here. If the object goes before end(), the
/// program is told that its input has ended, and waited for. SIGPIPE must be ignored. All errors
/// are kMachine, with the program's own last words.
class PipedProgram {
 public:
  /// `words`: its name and arguments.
  static Result<PipedProgram> start(const std::string& program,
                                    const std::vector<std::string>& words);
  PipedProgram(PipedProgram&&) noexcept;
  PipedProgram& operator=(PipedProgram&&) = delete;
  ~PipedProgram();

  /// Waits while the program has not read what was written before.
  Status write(std::string_view bytes);
  /// Ends its input and waits for it; an error if it fails. To be called once.
  Status end();

 private:
  struct State;
  explicit PipedProgram(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace whittle
