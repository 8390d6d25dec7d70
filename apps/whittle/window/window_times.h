// What --stats says of a window.
#pragma once

#include <string>
#include <vector>

#include "base/timing.h"
#include "viewer/frame_plan.h"

namespace whittle {

class WindowTimes {
 public:
  /// A picture is on the screen.
  void shown(FrameStep step);
  /// Lines, for people.
  std::string text() const;

 private:
  Stopwatch watch_;
  double first_ = 0, last_ = 0;  ///< when, milliseconds; 0: there was none
  std::vector<double> between_;  ///< pictures in motion, milliseconds
};

}  // namespace whittle
