// A line that tells a person at a terminal that work goes on.
#pragma once

#include <functional>
#include <memory>

#include "trace/tracer.h"

namespace whittle {

/// Shows the stage, and the share of it that is done, on standard error. Nothing is shown if that
/// is no terminal, if `wanted` is false, in the first second, or if what this thread says is kept
/// (console.h). The line goes when the object does.
class ProgressLine {
 public:
  /// Names of stages must live forever.
  ProgressLine(bool wanted, const char* stage);
  ~ProgressLine();

  /// Names what is done from now on.
  void stage(const char* name);
  /// To be told the share of the present stage; must not outlive this object.
  Progress share();
  /// Calls `say`, which says something, while the line is away.
  void without_line(const std::function<void()>& say);

 private:
  struct State;
  std::unique_ptr<State> state_;  ///< null: shows nothing
};

}  // namespace whittle
