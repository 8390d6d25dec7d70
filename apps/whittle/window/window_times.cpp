#include "window_times.h"

#include <fmt/format.h>

#include <algorithm>

namespace whittle {
namespace {

/// After so many milliseconds it was no motion.
constexpr double kPause = 500;

}  // namespace

void WindowTimes::shown(FrameStep step) {
  const double now = watch_.milliseconds();
  if (first_ == 0)
    first_ = now;
  else if (!step.is_final && now - last_ < kPause)
    between_.push_back(now - last_);
  last_ = now;
}

std::string WindowTimes::text() const {
  std::string text = fmt::format(
      "first picture      {:8.1f} ms after the window was asked for\n"
      "pictures in motion {:8}",
      first_, between_.size());
  if (!between_.empty())
    text += fmt::format("    one in {:.1f} ms (median), {:.1f} ms (worst)", median(between_),
                        *std::ranges::max_element(between_));
  return text + "\n";
}

}  // namespace whittle
