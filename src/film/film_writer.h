// Pictures one after another into one file. No writer holds more than the picture it is given.
#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "base/result.h"
#include "image/picture.h"

namespace whittle {

struct FilmSettings {
  int width = 0, height = 0;  ///< pixels of every frame, positive
  int frames = 0;             ///< how many there will be, positive
  double fps = 25;            ///< frames a second, kLeastFps to kMostFps
  bool with_alpha = false;    ///< pixels may be transparent
  int threads = 0;            ///< 0: all
};

inline constexpr double kLeastFps = 0.1, kMostFps = 240;
/// What is shown for less than two hundredths of a second in a GIF, browsers show for ten.
inline constexpr double kMostFpsOfGif = 50;

/// Takes the next bytes of a file.
using ByteSink = std::function<Status(std::string_view bytes)>;

class FilmWriter {
 public:
  virtual ~FilmWriter() = default;
  /// The next frame. Precondition: it has the size that was said, and there are not more of them.
  virtual Status add(const Picture& picture) = 0;
  /// Completes the film. Precondition: all frames are there. To be called once.
  virtual Status finish() = 0;
};

/// An animated PNG, which is endless, and which who knows no animation shows as its first frame.
/// Based on: APNG, as PNG's third edition (W3C 2025) has it.
std::unique_ptr<FilmWriter> make_apng_writer(const FilmSettings& settings, ByteSink sink);

/// An animated GIF, which is endless. Each frame has 255 or 256 colours of its own (palette.h);
/// with alpha, what is less than half covered is transparent. Precondition: fps is at most
/// kMostFpsOfGif. Based on: GIF89a, by giflib.
std::unique_ptr<FilmWriter> make_gif_writer(const FilmSettings& settings, ByteSink sink);

}  // namespace whittle
