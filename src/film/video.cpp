#include "film/video.h"

#include <fmt/format.h>

#include <optional>
#include <utility>
#include <vector>

#include "host/output_file.h"
#include "host/piped_program.h"

namespace whittle {
namespace {

class VideoWriter : public FilmWriter {
 public:
  VideoWriter(std::string name, OutputFile file, PipedProgram program, const FilmSettings& settings)
      : name_(std::move(name)),
        file_(std::move(file)),
        program_(std::move(program)),
        settings_(settings) {}

  Status add(const Picture& picture) override {
    WHITTLE_CHECK(picture.width == settings_.width && picture.height == settings_.height);
    const int width = even(picture.width), height = even(picture.height);
    rows_.resize(3 * size_t(width) * size_t(height));
    char* to = rows_.data();
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const uint8_t* from =
            picture.at(std::min(x, picture.width - 1), std::min(y, picture.height - 1));
        for (int c = 0; c < 3; ++c) *to++ = char(from[c]);
      }
    }
    return named(program_.write({rows_.data(), rows_.size()}));
  }

  Status finish() override {
    if (Status ended = named(program_.end()); !ended) return ended;
    return file_.commit();
  }

  static int even(int pixels) { return pixels + pixels % 2; }

 private:
  Status named(const Status& status) const {
    if (status) return status;
    return Error{ErrorKind::kMachine,
                 fmt::format("cannot make '{}': {}", name_, status.error().message)};
  }

  std::string name_;
  OutputFile file_;
  PipedProgram program_;
  FilmSettings settings_;
  std::vector<char> rows_;
};

}  // namespace

Result<std::unique_ptr<FilmWriter>> make_video_writer(const std::string& path,
                                                      VideoContainer container,
                                                      const FilmSettings& settings) {
  WHITTLE_CHECK(!settings.with_alpha);
  const std::optional<std::string> ffmpeg = find_program("ffmpeg");
  if (!ffmpeg) {
    return Error{ErrorKind::kMachine,
                 fmt::format("cannot make '{}': .mp4 and .webm are made by ffmpeg, which is not on "
                             "PATH; install it (apt-get install ffmpeg), or make an .apng or .gif",
                             path)};
  }
  Result<OutputFile> file = OutputFile::create(path);
  if (!file) return file.error();
  const std::string size =
      fmt::format("{}x{}", VideoWriter::even(settings.width), VideoWriter::even(settings.height));
  std::vector<std::string> words = {"ffmpeg",       "-nostdin",
                                    "-hide_banner", "-loglevel",
                                    "error",        "-y",
                                    "-f",           "rawvideo",
                                    "-pix_fmt",     "rgb24",
                                    "-s",           size,
                                    "-r",           fmt::format("{}", settings.fps),
                                    "-i",           "pipe:0",
                                    "-pix_fmt",     "yuv420p"};
  if (container == VideoContainer::kMp4)
    words.insert(words.end(), {"-movflags", "+faststart", "-f", "mp4"});
  else
    words.insert(words.end(), {"-f", "webm"});
  words.push_back("file:" + file->path());
  Result<PipedProgram> program = PipedProgram::start(*ffmpeg, words);
  if (!program) {
    return Error{program.error().kind,
                 fmt::format("cannot make '{}': {}", path, program.error().message)};
  }
  return std::unique_ptr<FilmWriter>(
      std::make_unique<VideoWriter>(path, *std::move(file), *std::move(program), settings));
}

}  // namespace whittle
