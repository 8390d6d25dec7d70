// Which pictures are made of what is to be seen, one after the other: while it moves, one in the
// time between two frames of a display; when it is still, the one that the command line makes.
#pragma once

#include <cstdint>
#include <optional>

namespace whittle {

struct FrameStep {
  int scale = 1;          ///< one ray for so many pixels, each way
  bool is_final = false;  ///< else lights alone, without antialiasing

  bool operator==(const FrameStep&) const = default;
};

class FramePlan {
 public:
  /// What is to be seen is something else. While it moves the first picture has to be there soon;
  /// if it does not, the last one may stay until the final one is made, if that is soon.
  void restart(int64_t pixels, bool is_moving);
  /// The next picture; none: there is nothing left to do.
  std::optional<FrameStep> next() const { return next_; }
  /// That one was made. Of what is final no rays are counted.
  void took(double milliseconds);

 private:
  /// The finest that is likely to be made in time.
  int scale_in_time() const;

  std::optional<FrameStep> next_;
  int64_t pixels_ = 0;
  int last_scale_ = 2;
  double draft_ = 0;  ///< milliseconds a ray of a draft; 0: not known yet
  double final_ = 0;  ///< milliseconds a pixel of a final picture; 0: not known yet
};

}  // namespace whittle
