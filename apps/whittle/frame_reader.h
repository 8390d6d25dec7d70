// The frames of an animation: openscad evaluates several at a time, ahead of the pictures.
#pragma once

#include <cstddef>
#include <deque>
#include <future>
#include <string>
#include <vector>

#include "host/read_file.h"

namespace whittle {

class FrameReader {
 public:
  /// `times` are the values of $t, a frame each. As many are read at a time as there are
  /// processors, and at most kMostAtATime.
  FrameReader(std::string file, FileOptions options, std::vector<double> times);

  /// The next frame. To be called once for each.
  Result<Read> next();

 private:
  static constexpr size_t kMostAtATime = 8;

  void read_ahead();

  std::string file_;
  FileOptions options_;
  std::vector<double> times_;
  size_t started_ = 0, at_a_time_ = 1;
  std::deque<std::future<Result<Read>>> running_;
};

}  // namespace whittle
