#include "film_options.h"

#include <fmt/format.h>

#include "film/film_writer.h"

namespace whittle {
namespace {

constexpr int kMostFrames = 99'999;

}  // namespace

void add_film_options(CLI::App& app, FilmArguments& film) {
  OptionGroup group(app, "Output");
  group.add_count("--turntable", "N", film.turntable, 1, kMostFrames,
                  "N pictures once round the z axis, {n} in OUT their\n"
                  "number; or a film, OUT .gif, .apng, .mp4 or .webm");
  group.add_text("--fps", "F", "of films: pictures a second (25)", [&](const std::string& text) {
    film.fps = parse_number("--fps", text);
    film.has_fps = true;
    if (!(film.fps >= kLeastFps && film.fps <= kMostFps))
      refuse("--fps", fmt::format("'{}' is not between {} and {}", text, kLeastFps, kMostFps));
  });
}

Status check_film(const FilmArguments& film, FilmFormat format, const std::string& path,
                  bool with_alpha) {
  const auto refused = [](std::string why) { return Error{ErrorKind::kUsage, std::move(why)}; };
  const bool is_gif = format == FilmFormat::kGif;
  const bool is_video = format == FilmFormat::kMp4 || format == FilmFormat::kWebm;
  if (is_gif && film.fps > kMostFpsOfGif)
    return refused(fmt::format("--fps {}: a .gif shows at most {} pictures a second", film.fps,
                               kMostFpsOfGif));
  if (is_video && with_alpha)
    return refused("--no-background: .mp4 and .webm show no transparency; .gif and .apng do");
  if (is_video && path == "-")
    return refused("-o -: .mp4 and .webm go to files; .gif and .apng also to standard output");
  return Done{};
}

}  // namespace whittle
