// The frames of an animation or of a turntable: a file each, and films that hold all of them.
#pragma once

#include <future>
#include <memory>
#include <vector>

#include "draw_picture.h"
#include "film/film_writer.h"
#include "render_arguments.h"

namespace whittle {

/// A frame is written by a thread of its own while the next is drawn. No more than these two are
/// held.
class FrameFiles {
 public:
  /// `outputs`: templates. All must outlive this object.
  FrameFiles(const RenderArguments& a, const std::vector<Output>& outputs, int frames)
      : a_(a), outputs_(outputs), frames_(frames) {}

  /// Begins the films.
  Status open();
  /// The next frame, of that number in names. An error may be of the one before.
  Status add(int number, Drawn drawn);
  /// Waits for the last frame and completes the films.
  Status finish();

 private:
  Status write(int number, const Drawn& drawn);
  Status wait();

  const RenderArguments& a_;
  const std::vector<Output>& outputs_;
  int frames_;
  std::vector<std::unique_ptr<FilmWriter>> films_;
  std::future<Status> writing_;  ///< the last member: it must end before the others go
};

/// Where the frame of that number goes, of the outputs that are pictures.
std::vector<Output> outputs_of_frame(const RenderArguments& a, const std::vector<Output>& outputs,
                                     int number);

}  // namespace whittle
