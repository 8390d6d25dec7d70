#include "frame_reader.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "base/result.h"
#include "limits.h"

namespace whittle {

FrameReader::FrameReader(std::string file, FileOptions options, std::vector<double> times)
    : file_(std::move(file)),
      options_(std::move(options)),
      times_(std::move(times)),
      at_a_time_(std::clamp<size_t>(std::thread::hardware_concurrency(), 1, kMostAtATime)) {
  read_ahead();
}

void FrameReader::read_ahead() {
  for (; started_ < times_.size() && running_.size() < at_a_time_; ++started_) {
    FileOptions options = options_;
    options.flatten.time = times_[started_];
    running_.push_back(std::async(std::launch::async, [file = file_, options = std::move(options)] {
      return with_limit_option(read_file(file, options));
    }));
  }
}

Result<Read> FrameReader::next() {
  WHITTLE_CHECK(!running_.empty());
  Result<Read> read = running_.front().get();
  running_.pop_front();
  read_ahead();
  return read;
}

}  // namespace whittle
