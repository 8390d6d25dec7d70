// Films that ffmpeg makes, another program: whittle hands it frames.
#pragma once

#include <memory>
#include <string>

#include "base/result.h"
#include "film/film_writer.h"

namespace whittle {

enum class VideoContainer { kMp4, kWebm };

/// A film in the container, with the codec that ffmpeg has for it (H.264 and VP9 as a rule).
/// Columns and rows are doubled at the right and lower border where their number is odd, for
/// codecs have pairs of pixels. The file is there whole or not at all. A kMachine error if ffmpeg
/// is not on PATH or refuses. Precondition: no alpha.
Result<std::unique_ptr<FilmWriter>> make_video_writer(const std::string& path,
                                                      VideoContainer container,
                                                      const FilmSettings& settings);

}  // namespace whittle
